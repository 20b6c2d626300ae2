"""Files: formats by name, recent and interrupted jobs, panel, how to drill, and placing by measured holes."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from drillctl.language import words
from drillctl.ui.pcb_drill import examples
from drillctl.ui.pcb_drill.alignment import AlignmentScreen
from drillctl.ui.pcb_drill.drilling import Drilling
from drillctl.ui.pcb_drill.files import Files
from drillctl.ui.pcb_drill.measuring import far_apart
from drillctl.ui.pcb_drill.typed import FORMATS
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf
from drillctl.viewmodel.jobs import RecentJob, Site, UnfinishedJob
from tests.support.labels import counted
from tests.support.messages import screen_templates
from tests.ui.fake_console import BOARD, VIEW, FakeConsole, Program

SIZES = [(80, 24), (160, 50)]
HERE = Site("simulated", "real", "ideal")
CUT = UnfinishedJob("/state/four.journal", "/home/four.drl", "pcb-drill", 3, 26, (4,), True, True, None, HERE, HERE)


pytestmark = pytest.mark.usefixtures("idle", "folder")  # the list of files is drawn behind each box


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "four.drl").write_text("M48\nT1C0.8\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def opened(console: FakeConsole | None = None, size: tuple[int, int] = (80, 24)) -> Program:
    """With the board loaded."""
    program = Program(console or FakeConsole(), size)
    program.press("f", "down", "enter")
    return program


def asked(program: Program) -> JobOptions:
    """As the board was asked for last."""
    wanted = next(request[2] for request in reversed(program.console.asked) if request[0] == "load")
    assert isinstance(wanted, JobOptions)
    return wanted


def typed(program: Program, *texts: str, wiped: int = 10) -> None:
    """Into the fields of a form, in place of what stands there."""
    for text in texts:
        program.press("end", *["backspace"] * wiped, *["delete"] * wiped, *text, "down")


@pytest.mark.parametrize("index", range(len(FORMATS)))
def test_a_format_is_chosen_by_its_name(folder: Path, index: int) -> None:
    program = opened()
    program.press("n", str(index + 1))
    assert asked(program).format == (FORMATS[index].option or None)


def test_the_papers_four_formats_are_named_and_any_other_can_be_typed(folder: Path) -> None:
    program = opened()
    program.press("n")
    for name in ("ASCII drill format", "EXCELLON decimal", "EXCELLON adding zero", "EXCELLON metric"):
        assert name in program.text()
    program.press(*["down"] * len(FORMATS), "enter")
    assert "Units, digits and zeros left out" in program.text()
    program.press(*"mm,4:4,none", "enter")
    assert asked(program).format == "mm,4:4,none"


def test_the_reason_and_the_runner_up_are_shown(folder: Path) -> None:
    text = opened(size=(160, 50)).text()
    assert "Excellon decimal, mm decimal (90%): the numbers carry points" in text and "else: inch decimal" in text


def test_a_panel_is_asked_checked_and_shown(folder: Path) -> None:
    program = opened()
    program.press("p")
    typed(program, "2", "three", "40", "30,5")
    program.press("enter")
    assert "'three' is not a number of boards" in program.text()
    program.press("up", "up", "up")
    typed(program, "3")
    program.console.answer = ("a panel of 2 x 3 boards; 1000 are the most",)
    program.press("enter")
    assert "1000 are the most" in program.text()
    program.console.answer = ()
    program.press("enter")
    assert asked(program).panel == PanelOf(2, 3, 40.0, 30.5)
    assert "Panel: 2 x 3, 40 by 30.5 mm" in program.text()
    program.press("p")
    typed(program, "1", "1")
    program.press("enter")
    assert asked(program).panel is None


def test_how_to_drill_is_asked_and_shown(folder: Path) -> None:
    program = opened(size=(100, 40))
    program.press("w")
    typed(program, "0.5", "0,2", "T3 2", "drills.toml")
    program.press("enter")
    wanted = JobOptions(peck_mm=0.5, spot_mm=0.2, skip_tools=(2, 3), drills=str(folder / "drills.toml"))
    assert asked(program) == wanted
    for told in ("In pecks of 0.5 mm", "A spot of 0.2 mm first", "Without tools T2 T3", "Drills at hand: "):
        assert told in program.text()
    program.press("w")
    typed(program, "", "", "", "", wiped=120)
    program.press("enter")
    assert asked(program) == JobOptions()


@pytest.mark.parametrize(("field", "text"), [(0, "deep"), (1, "inf"), (2, "T1 x")])
def test_what_cannot_be_read_is_said_in_the_form(folder: Path, field: int, text: str) -> None:
    program = opened()
    before = len(program.console.asked)
    program.press("w", *["down"] * field)
    typed(program, text)
    program.press("enter")
    assert f"{text!r} is not a l" in program.text() and len(program.console.asked) == before
    program.press("esc")
    assert "is not a l" not in program.text()


def test_recent_jobs_are_opened_with_their_settings_by_one_key(folder: Path) -> None:
    settings = JobOptions(mirror="x", panel=PanelOf(2, 1, 40.0, 0.0))
    jobs = [RecentJob(str(folder / "four.drl"), settings), RecentJob("/gone/two.drl", JobOptions())]
    program = Program(FakeConsole(recent_jobs=jobs))
    program.press("f", "l")
    assert "1 four.drl  in X  Panel: 2 x 1" in program.text() and "2 two.drl" in program.text()
    program.press("1")
    assert program.console.asked == [("load", str(folder / "four.drl"), settings)]
    assert "4 holes, 40.00 x 20.00 mm" in program.text()
    program.console.answer = ("/gone/two.drl: can't be read: No such file or directory",)
    program.press("l", "down", "enter")
    assert "Refused" in program.text() and asked(program) == JobOptions()


def test_holes_behind_the_end_can_be_asked_for(folder: Path) -> None:
    program = opened(size=(130, 40))
    assert "Behind M30: refuse holes" in program.text()
    for choice, word in (("ignore", "leave out"), ("drill", "drill too"), ("refuse", "refuse holes")):
        program.press("k")
        assert asked(program).after_end == choice and f"Behind M30: {word}" in program.text()


def test_a_list_of_recent_jobs_with_a_value_that_is_not_known_is_shown(folder: Path) -> None:
    settings = JobOptions(rotate_deg=33.0)
    program = Program(FakeConsole(recent_jobs=[RecentJob(str(folder / "four.drl"), settings)]), (130, 40))
    program.press("f", "l")
    assert "four.drl  33.0" in program.text()
    program.press("1", "t")
    assert asked(program).rotate_deg == 0.0


def test_another_board_is_not_placed_by_what_was_measured_on_the_last(folder: Path) -> None:
    (folder / "more.drl").write_text("M48\n")
    settings = JobOptions(mirror="x", align=(MeasuredHole(0, 0, 1, 1),), skip_tools=(2,))
    jobs = [RecentJob(str(folder / "four.drl"), settings)]
    program = Program(FakeConsole(recent_jobs=jobs))
    program.press("f", "l", "1", "down", "enter")
    assert asked(program) == JobOptions(mirror="x")


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize("size", SIZES)
def test_an_interrupted_job_is_offered_with_all_that_it_means(language: str, size: tuple[int, int]) -> None:
    words.use(language)
    program = Program(FakeConsole(unfinished_jobs=[CUT]), size)
    program.press("f", "u")
    text = " ".join(" ".join(row.split("│")[row.count("│") // 2] for row in program.text().splitlines()).split())
    for told in ("Hole {numbers} was cut off", "The last line of its journal", "Holes of the tool in hand"):
        source = next(message for message in screen_templates() if message.startswith(told))
        assert words._(source).format(numbers="4") in text
    assert counted("{done} of {count} holes are drilled", 26, done=3) in text
    program.press("enter")
    assert not program.console.asked


def test_a_hole_that_may_have_been_begun_is_named() -> None:
    program = Program(FakeConsole(unfinished_jobs=[replace(CUT, again=(), doubtful=4)]))
    program.press("f", "u")
    assert "Hole 4 may have been begun; it will be drilled again." in program.text()


def test_an_interrupted_job_goes_on_or_is_given_up() -> None:
    program = Program(FakeConsole(unfinished_jobs=[CUT]))
    program.press("f", "u", "right", "enter")
    assert program.console.asked == [("take_up", CUT.journal, False), ("go_on",)]
    assert " Drilling " in program.text().splitlines()[1]
    program.press("f", "u", "right", "right", "enter")
    assert program.console.asked[-1] == ("give_up", CUT.journal)
    program.press("u")
    assert "No job was cut off." in program.text()


BOARD_SITE = Site("firmata:/dev/ttyACM0", "real", "none")


@pytest.mark.parametrize(
    ("ran", "here", "told"),
    [
        (BOARD_SITE, HERE, "machine drills counts as drilled. Go on all the same?"),
        (replace(HERE, pace="free"), HERE, "ran with port simulated, pace free, plant ideal. It would go on with port"),
        (HERE, BOARD_SITE, "go on with port firmata:/dev/ttyACM0, pace real. Go on all the same?"),
        (replace(HERE, plant="dynamic blunt=20", seed=3), HERE, "pace real, plant dynamic blunt=20, seed 3."),
    ],
)
def test_a_job_that_ran_elsewhere_is_asked_about(ran: Site, here: Site, told: str) -> None:
    """What is in use is none of the journal's sites: No, and Enter alone, leave everything as it is."""
    program = Program(FakeConsole(unfinished_jobs=[replace(CUT, ran=ran, here=here)]))
    program.press("f", "u", "right", "enter")
    assert told in " ".join(program.text().replace("│", " ").split()) and not program.console.asked
    program.press("enter")
    assert not program.console.asked
    program.press("u", "right", "enter", "right", "enter")
    assert program.console.asked == [("take_up", CUT.journal, True), ("go_on",)]


def test_several_interrupted_jobs_are_listed_and_a_refusal_is_told() -> None:
    other = replace(CUT, journal="/j2", file="/home/two.drl", again=(), torn=False)
    console = FakeConsole(unfinished_jobs=[CUT, other])
    program = Program(console)
    program.press("f", "u")
    assert "1 four.drl  3 of 26 holes are drilled" in program.text()
    console.answer = ("two.drl has changed since the job was begun",)
    program.press("2", "right", "enter")
    assert console.asked == [("take_up", "/j2", False)] and "has changed since" in program.text()


def test_start_offers_what_was_cut_off_of_the_same_board_and_begins_anew_on_request() -> None:
    program = Program(FakeConsole(loaded=BOARD, unfinished_jobs=[CUT]))
    program.press("s", "right", "right", "enter")
    assert program.console.asked == [("give_up", CUT.journal), ("start", False)]
    program.press("s")
    assert "Drill 4 holes of four.drl?" in program.text()


def test_jobs_cut_off_are_offered_when_the_program_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    program = Program(FakeConsole(unfinished_jobs=[CUT]))
    alarms = []
    monkeypatch.setattr(program.app.loop, "run", lambda: None)
    monkeypatch.setattr(program.app.loop, "set_alarm_in", lambda after_s, call: alarms.append(call))
    program.app.run()
    alarms[-1](program.app.loop, None)
    assert "Interrupted job" in program.text()


STANDING = replace(VIEW, axes=tuple(replace(axis, position_steps=480, position_mm=0.0) for axis in VIEW.axes))


def aligning(folder: Path, size: tuple[int, int] = (80, 24)) -> Program:
    program = opened(FakeConsole(now=STANDING), size)
    program.press("j")
    return program


def test_holes_far_apart_are_proposed() -> None:
    assert sorted(far_apart(BOARD.file_xy_mm))[0] == 0 and len(far_apart(BOARD.file_xy_mm)) == 3
    assert [far_apart(np.zeros((count, 2))) for count in (0, 1, 5)] == [[], [0], [0]]
    line = np.array([[0.0, 0.0], [1.0, 0.0], [9.0, 0.0]])
    assert len(far_apart(line)) == 2


@pytest.mark.parametrize("size", SIZES)
def test_measured_holes_place_the_board(folder: Path, size: tuple[int, int]) -> None:
    """The base lies at 480 steps (10.16 mm): shown from there, kept from machine zero."""
    program = aligning(folder, size)
    assert "X10.000 Y10.000" in program.text() and "2 holes at least" in program.text()
    program.press("enter", "tab", "t", *"40 20", "enter")
    assert all(told in program.text() for told in ("X0.000 Y0.000", "X40.000 Y20.000", "accepted: F2"))
    program.press("f2")
    holes = asked(program).measured
    assert [(hole.file_x_mm, hole.machine_x_mm) for hole in holes] == [
        pytest.approx((10.0, 10.16)), pytest.approx((50.0, 50.16)),
    ]  # fmt: skip
    assert "Placed by 2 measured holes" in program.text()


def test_holes_that_contradict_each_other_place_nothing(folder: Path) -> None:
    program = aligning(folder)
    before = len(program.console.asked)
    program.press("enter", "tab", "t", *"47 20", "enter", "f2")
    assert "REJECTED" in program.text() and "can't place the board" in program.text()
    assert "7.000 mm" in program.text() and len(program.console.asked) == before
    program.press("esc")
    assert isinstance(program.app.screens[-1], Files) and len(program.console.asked) == before


def test_a_long_reason_against_measured_holes_is_read_to_its_end(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reason = "the measured places press the board flat onto a line: were they confused with each other?"
    monkeypatch.setattr(FakeConsole, "align", lambda console, measured, face_down: (None, (reason,)))
    program = aligning(folder, (80, 24))
    program.press("enter", "tab", "t", *"47 20", "enter")
    assert f"problem: {reason}" in " ".join(program.text().split())


def test_the_drill_is_sent_where_a_hole_should_be(folder: Path) -> None:
    program = aligning(folder)
    program.press("tab", "g")
    x_mm, y_mm = BOARD.xy_mm[program_spot(program) - 1].tolist()
    assert program.console.asked[-1] == ("go_to", pytest.approx(x_mm), pytest.approx(y_mm))
    program.press("right", "-", "down")
    assert program.console.asked[-2:] == [("jog", "x", 12), ("jog", "y", -3)]


def program_spot(program: Program) -> int:
    screen = program.app.screens[-1]
    assert isinstance(screen, AlignmentScreen)
    return screen.measuring.spots[1].number


def test_holes_are_added_and_taken_off(folder: Path) -> None:
    program = aligning(folder)
    program.press("a", "9", "enter")
    assert "hole '9' can't be added" in program.text()
    program.press("delete", "delete", "delete", "delete", "g", "enter", "t", "tab")
    assert "X10.000 Y10.000" not in program.text()
    program.press("a", "1", "enter")
    assert "X10.000 Y10.000" in program.text()
    program.press("f2")
    assert asked(program).measured == () and isinstance(program.app.screens[-1], Files)


@pytest.mark.parametrize(
    ("change", "told"), [({"position_known": False}, "position is not known"), ({"moving": True}, "machine is moving")]
)
def test_a_machine_that_moves_or_is_lost_finds_no_hole(folder: Path, change: dict[str, Any], told: str) -> None:
    program = aligning(folder)
    program.console.now = replace(STANDING, **change)
    program.press("enter")
    assert told in program.text() and "X0.000 Y0.000" not in program.text()


def test_a_panel_or_no_board_is_not_measured(folder: Path) -> None:
    program = Program(FakeConsole())
    program.press("f", "j")
    assert "no board is loaded" in program.text()
    program.press("enter", "p")
    typed(program, "2", "1", "40")
    program.press("enter", "down", "enter", "j")
    assert "Measure a single board first" in program.text()


@pytest.mark.parametrize("key", [name for key in AlignmentScreen.keys for name in key.names])
def test_every_key_of_the_alignment_does_something(folder: Path, key: str) -> None:
    program = aligning(folder)
    if key in ("ctrl u", "ctrl r"):
        program.press("enter", *(["ctrl u"] if key == "ctrl r" else []))  # something to undo, or to redo
    before, requests, top = program.text(), len(program.console.asked), program.app.layers.top
    program.press(key)
    changed = program.text() != before or len(program.console.asked) > requests
    assert changed or program.app.layers.top is not top


def test_an_exclamation_mark_is_typed_at_rest_and_stops_otherwise(folder: Path) -> None:
    program = opened()
    program.press("/")
    program.press("!", "enter")
    assert ("emergency_stop",) not in program.console.asked
    program.press("!")
    assert program.console.asked.pop() == ("emergency_stop",)
    states: tuple[dict[str, Any], ...] = ({"moving": True}, {"command": "KMD_CZEKAJ 100"}, {"queued": 3})
    for busy in states:
        program = opened()
        program.press("/")
        program.console.now = replace(VIEW, **busy)
        program.press("!")
        assert program.console.asked[-1] == ("emergency_stop",)


def test_f10_stops_in_a_field_at_rest_too(folder: Path) -> None:
    program = opened()
    program.press("w", "f10")
    assert program.console.asked[-1] == ("emergency_stop",)


@pytest.mark.parametrize("first", [(), ("f",)], ids=["from Drilling", "from Files"])
def test_an_example_board_is_loaded_by_its_number(first: tuple[str, ...]) -> None:
    program = Program(FakeConsole())
    program.press(*first, "e")
    board = examples.boards()[0]
    assert f"1 board {board.name}" in program.text()
    program.press("1")
    assert program.console.asked == [("load", str(board), JobOptions())]
    assert isinstance(program.app.screens[-1], Drilling)


def test_a_lab_sheet_is_opened_to_be_read() -> None:
    program = Program(FakeConsole())
    program.press("e", *["down"] * len(examples.boards()), "enter")
    assert "# 1. Phase sequences" in program.text()
    program.press("page down", "q")
    assert isinstance(program.app.screens[-1], Drilling) and not program.console.asked


def test_an_installation_without_examples_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    empty = tmp_path / "empty"
    empty.mkdir()
    monkeypatch.setattr(examples, "shipped", lambda name, in_checkout: empty)
    program = Program(FakeConsole())
    program.press("e")
    assert "not part of this installation" in program.text()
