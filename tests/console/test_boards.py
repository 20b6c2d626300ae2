"""Boards on the operator's desk: placed by measured holes, repeated, drilled from a base, cut off and gone on with."""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from msgspec.structs import asdict

from drillctl.cli import main
from drillctl.console.machine_console import MachineConsole
from drillctl.console.queues import QueueFiles
from drillctl.jobs.journal import read_journal
from drillctl.jobs.session import default_journal
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf
from drillctl.viewmodel.jobs import Site
from tests.support.journalled import BOARD, forged, lines_of
from tests.support.operator import settle, until

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"


def made(machine: str = "pcb-drill") -> MachineConsole:
    library = Library.standard()
    return MachineConsole(library, library.machine(machine).at_rate(5000), RunSettings(pace="free"), tools="assume")


@pytest.fixture
def console() -> Iterator[MachineConsole]:
    console = made()
    yield console
    console.close()


@pytest.fixture
def board(tmp_path: Path) -> Path:
    (tmp_path / "job.drl").write_text(BOARD)
    return tmp_path / "job.drl"


def gone_on(console: MachineConsole, journal: str, elsewhere: bool = False) -> Problems:
    """As the screen does it."""
    return console.take_up(journal, elsewhere) or console.go_on()


def cut_off(console: MachineConsole, board: Path, holes: int, options: JobOptions | None = None) -> None:
    """The board is drilled as far as so many holes, and stopped."""
    assert console.load(str(board), options or JobOptions()) == ()
    assert console.start(dry=False) == ()
    until(console, lambda: (told := console.progress()) is not None and told.holes_done >= holes)
    console.stop()
    settle(console)


def test_a_board_is_drilled_with_its_journal(console: MachineConsole, board: Path) -> None:
    assert console.load(str(board), JobOptions()) == () and console.start(dry=False) == ()
    assert console.unfinished() == []  # what runs is not offered
    settle(console)
    account = read_journal(default_journal(board))
    assert account.done == {1, 2, 3, 4} and account.ended == "done" and console.unfinished() == []
    assert console.start(dry=False) == ()  # and once more
    settle(console)
    assert console.view().fault is None


def test_a_dry_run_leaves_no_journal(console: MachineConsole, board: Path) -> None:
    console.load(str(board), JobOptions())
    assert console.start(dry=True) == ()
    settle(console)
    assert not default_journal(board).exists()


def test_an_interrupted_job_is_offered_and_exactly_its_rest_is_drilled(console: MachineConsole, board: Path) -> None:
    cut_off(console, board, 2)
    (job,) = console.unfinished()
    assert 1 <= job.holes_done < 4 and (job.file, job.machine, job.holes_total) == (str(board), "pcb-drill", 4)
    assert console.start(dry=False)[0].endswith("or delete the file to begin anew")
    assert gone_on(console, job.journal) == ()
    settle(console)
    told = console.progress()
    assert told is not None and (told.holes_done, told.holes_total) == (4, 4)
    assert read_journal(default_journal(board)).done == {1, 2, 3, 4} and console.unfinished() == []
    assert console.start(dry=False) == ()  # the whole board is on the desk again
    settle(console)
    told = console.progress()
    assert told is not None and told.holes_done == 4


def test_another_program_goes_on_where_one_was_killed(console: MachineConsole, board: Path) -> None:
    console.load(str(board), JobOptions(rotate_deg=90.0, peck_mm=1.0, skip_tools=(2,)))
    console.start(dry=False)
    until(console, lambda: (told := console.progress()) is not None and told.holes_done >= 1)
    console.close()
    other = made()
    try:
        (job,) = other.unfinished()
        assert job.holes_total == 3 and len(job.again) <= 1
        assert gone_on(other, job.journal) == ()
        settle(other)
        assert other.view().fault is None and other.unfinished() == []
    finally:
        other.close()


def test_the_command_line_goes_on_with_what_the_screen_began(
    console: MachineConsole, board: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cut_off(console, board, 1, JobOptions(mirror="x", panel=PanelOf(2, 1, 6.0, 0.0)))
    assert main(["resume", console.unfinished()[0].journal, "--json"]) == 0
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["holes_done"] == outcome["holes_total"] == 8 and console.unfinished() == []


def test_the_screen_goes_on_with_what_the_command_line_began(console: MachineConsole, board: Path) -> None:
    journal = default_journal(board)
    assert main(["run", str(board), "--journal", str(journal), "--tick-hz", "5000", "--rotate", "90"]) == 0
    journal.write_text("".join(journal.read_text().splitlines(keepends=True)[:4]))
    (job,) = console.unfinished()
    assert (job.holes_done, job.again) == (1, (2,))
    assert gone_on(console, job.journal) == ()
    settle(console)
    assert read_journal(journal).done == {1, 2, 3, 4}


def test_a_job_is_not_gone_on_with_where_something_is_another(console: MachineConsole, board: Path) -> None:
    cut_off(console, board, 1)
    (job,) = console.unfinished()
    board.write_text(BOARD.replace("X3.0Y4.0", "X3.0Y4.1"))
    assert "has changed since the job was begun" in gone_on(console, job.journal)[0]
    board.write_text(BOARD)
    head, *lines = lines_of(Path(job.journal))
    for name, value, reason in (
        ("machine", "boiler-drum", "begun on machine boiler-drum; choose that one first"),
        ("machine_digest", "0" * 16, "machine pcb-drill is not the one that the job was begun on"),
        ("options", {**head["options"], "offset": [1.0, 0.0]}, "the placing, the order or a table"),
        ("options", {**head["options"], "peck": "deep"}, "written by another version"),
    ):
        Path(job.journal).write_bytes(forged([{**head, name: value}, *lines]))
        assert reason in gone_on(console, job.journal)[0] and not console.at_work


def test_a_job_that_ran_elsewhere_goes_on_only_where_that_was_agreed_to(console: MachineConsole, board: Path) -> None:
    """Begun on a real board, it would be simulated to its end."""
    cut_off(console, board, 2)
    (job,) = console.unfinished()
    assert job.ran == job.here == Site("simulated", "free", "ideal")
    real = Site("firmata:/dev/ttyACM0", "real", "none")
    head, *lines = lines_of(Path(job.journal))
    Path(job.journal).write_bytes(forged([{**head, "site": asdict(real)}, *lines]))
    before = Path(job.journal).read_bytes()
    (job,) = console.unfinished()
    assert (job.ran, job.here) == (real, Site("simulated", "free", "ideal"))
    assert "the job ran with port firmata:/dev/ttyACM0, pace real; what port" in gone_on(console, job.journal)[0]
    assert not console.at_work and Path(job.journal).read_bytes() == before
    assert gone_on(console, job.journal, elsewhere=True) == ()
    settle(console)
    assert console.unfinished() == [] and read_journal(Path(job.journal)).site == job.here


def test_options_that_no_verb_takes_are_refused(console: MachineConsole, board: Path) -> None:
    beyond = (MeasuredHole(0, 0, 1e9, 0),) * 2
    settings: tuple[dict[str, Any], ...] = ({"order": "shortest"}, {"mirror": "z"}, {"align": beyond})
    for bad in settings:
        assert "it can't be opened with these settings" in console.load(str(board), JobOptions(**bad))[0]
    assert console.board() is None


def test_a_job_that_is_given_up_leaves_room_for_a_new_one(console: MachineConsole, board: Path) -> None:
    cut_off(console, board, 1)
    (job,) = console.unfinished()
    assert console.give_up(job.journal) == () and console.unfinished() == []
    assert "can't be taken away" in console.give_up(job.journal)[0]
    assert console.start(dry=False) == ()
    assert "still going on" in console.give_up(job.journal)[0]
    settle(console)


def test_a_damaged_journal_is_not_offered_and_stops_nothing(console: MachineConsole, board: Path) -> None:
    cut_off(console, board, 1)
    journal = Path(console.unfinished()[0].journal)
    journal.with_name("other.journal").write_text("nonsense\n")
    journal.with_name("folder.journal").mkdir()
    assert [job.journal for job in console.unfinished()] == [str(journal)]


def test_a_board_is_drilled_from_the_base_that_was_set(console: MachineConsole, board: Path) -> None:
    """Its program initialises, which leaves the base at machine zero, and takes the operator's base again."""
    console.load(str(board), JobOptions())
    console.initialise()
    settle(console)
    console.jog("x", 600)
    settle(console)
    console.set_base()
    settle(console)
    assert console.start(dry=False) == ()
    settle(console)
    x, y = console.view().axes[:2]
    assert (x.position_steps, x.position_mm, y.position_steps) == (600, 0.0, 0)
    assert read_journal(default_journal(board)).head.options["base"] == [600, 0]


def test_what_was_cut_off_goes_on_from_its_own_base(console: MachineConsole, board: Path) -> None:
    console.initialise()
    settle(console)
    console.jog("y", 240)
    settle(console)
    console.set_base()
    settle(console)
    cut_off(console, board, 1)
    console.initialise()
    settle(console)
    assert gone_on(console, console.unfinished()[0].journal) == ()
    settle(console)
    assert console.view().axes[1].position_steps == 240 and console.view().axes[1].position_mm == 0


def test_a_base_from_which_the_board_is_out_of_reach_refuses_the_start(console: MachineConsole, board: Path) -> None:
    console.load(str(board), JobOptions())
    console.initialise()
    settle(console)
    high = console.machine.reach(0)[1]
    console.jog("x", high - 20)
    settle(console)
    console.set_base()
    settle(console)
    assert "out of reach" in console.start(dry=False)[0] and not console.at_work


SHIFT = np.array([5.0, 3.0])


def measured(*places: tuple[float, float], off: float = 0.0) -> tuple[MeasuredHole, ...]:
    rows = [(*place, *(np.array(place) + SHIFT).tolist()) for place in places]
    x, y, found_x, found_y = rows[-1]
    return tuple(MeasuredHole(*row) for row in [*rows[:-1], (x, y, found_x + off, found_y)])


CORNERS = ((1.0, 1.0), (3.0, 1.0), (1.0, 3.0), (3.0, 4.0))


def test_measured_holes_place_the_board_whatever_the_base(console: MachineConsole, board: Path) -> None:
    assert console.load(str(board), JobOptions(align=measured(*CORNERS))) == ()
    placed = console.board()
    assert placed is not None
    np.testing.assert_allclose(placed.xy_mm, placed.file_xy_mm + SHIFT, atol=0.03)
    console.initialise()
    settle(console)
    console.jog("x", 120)
    settle(console)
    console.set_base()
    settle(console)
    moved = console.board()
    assert moved is not None
    np.testing.assert_allclose(moved.xy_mm - placed.xy_mm, np.tile([-2.54, 0.0], (4, 1)), atol=0.03)


def test_measured_holes_are_judged(console: MachineConsole) -> None:
    found, problems = console.align(measured(*CORNERS), False)
    assert found is not None and not problems and not found.rejected and max(found.residual_mm) < 1e-9
    assert found.place_mm((10.0, 10.0)) == pytest.approx((15.0, 13.0))
    off, _ = console.align(measured(*CORNERS, off=3.0), False)
    assert off is not None and off.rejected
    none, problems = console.align(measured((1.0, 1.0), (1.0, 1.0)), False)
    assert none is None and "the same place" in problems[0]


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (JobOptions(align=measured(*CORNERS), rotate_deg=90.0), "given together with an alignment"),
        (JobOptions(panel=PanelOf(2, 1, 0.0, 0.0)), "pitch 0"),
        (JobOptions(panel=PanelOf(0, 1, 1.0, 1.0)), "has no board"),
        (JobOptions(peck_mm=0.001), "is not a depth"),
        (JobOptions(skip_tools=(9,)), "has no tool T9"),
        (JobOptions(drills="/nowhere/drills.toml"), "can't be read"),
        (JobOptions(format="furlongs"), "bad-format"),
    ],
)
def test_what_cannot_be_done_changes_nothing(
    console: MachineConsole, board: Path, options: JobOptions, reason: str
) -> None:
    assert console.load(str(board), JobOptions()) == ()
    before = console.board()
    assert reason in console.load(str(board), options)[0]
    assert console.board() is before and len(console.recent()) == 1


def test_a_panel_repeats_the_board(console: MachineConsole, board: Path) -> None:
    assert console.load(str(board), JobOptions(panel=PanelOf(2, 2, 6.0, 7.0))) == ()
    placed = console.board()
    assert placed is not None and len(placed.xy_mm) == 16
    np.testing.assert_allclose(np.ptp(placed.xy_mm, axis=0), [8.0, 10.0], atol=0.03)


def test_opened_boards_are_remembered(console: MachineConsole, board: Path) -> None:
    console.load(str(board), JobOptions(mirror="x"))
    console.load(str(BLINKER), JobOptions())
    assert [(Path(job.file).name, job.options.mirror) for job in console.recent()] == [
        ("blinker.drl", None), ("job.drl", "x"),
    ]  # fmt: skip


def test_a_queue_is_no_board(console: MachineConsole) -> None:
    assert "run from the queue editor" in console.load(str(BLINKER.with_name("square.kmd")), JobOptions())[0]


def test_a_pipe_is_refused_at_once(console: MachineConsole, tmp_path: Path) -> None:
    """Opening one waits for whoever writes into it, and the screen with it."""
    os.mkfifo(tmp_path / "pipe.drl")
    refused = (f"{tmp_path / 'pipe.drl'}: can't be read: a pipe or a device, not a file",)
    assert console.load(str(tmp_path / "pipe.drl"), JobOptions()) == refused
    assert QueueFiles(lambda: console.machine).open_queue(str(tmp_path / "pipe.drl")) == ("", refused)
    assert console.load(str(BLINKER), JobOptions(drills=str(tmp_path / "pipe.drl"))) == refused


def test_a_hole_is_done_when_the_head_is_up_again(console: MachineConsole, board: Path) -> None:
    def on_its_way_up() -> bool:
        view = console.view()
        return view.command.startswith("KMD_WIERTLO_GORA") and view.axes[2].position_steps > 20

    assert console.load(str(board), JobOptions()) == () and console.start(dry=False) == ()
    until(console, on_its_way_up)
    told = console.progress()
    assert told is not None and told.holes_done == 0


def test_a_turn_takes_a_machine_that_runs_free_far(console: MachineConsole, board: Path) -> None:
    """The screen turns it a few hundred times a second at most."""
    assert console.turn() is False, "at rest there is nothing to hurry for"
    assert console.load(str(board), JobOptions()) == () and console.start(dry=False) == ()
    turns = 1
    while console.turn():
        turns += 1
    told = console.progress()
    assert told is not None and told.holes_done == told.holes_total and told.ticks > 40 * turns
    assert told.seconds_left is None


def test_what_waits_for_the_operator_is_not_hurried(console: MachineConsole, board: Path) -> None:
    """Held, with the clock stopped and at rest; what still brakes is, and so is a job that goes on."""
    assert console.load(str(board), JobOptions()) == () and console.start(dry=False) == ()
    until(console, lambda: console.view().moving)
    assert console.hold() == ()
    while console.turn():
        assert console.at_work
    assert console.view().condition == "held" and console.resume() == ()
    until(console, lambda: console.view().moving)
    console.link.gate.grant(0)
    assert console.turn() is False, "no tick passes the gate"
    console.link.gate.open()
    assert console.turn() is True
