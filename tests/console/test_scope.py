"""Runs as the scope sees them: a recording while the machine is at work, and a trace file run again behind it."""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.console import scope
from drillctl.console import scope_runs as tracefile
from drillctl.console.machine_console import MachineConsole
from drillctl.console.readiness import BUSY
from drillctl.console.scope import RunScope
from drillctl.console.scope_layout import lanes_of
from drillctl.console.scope_runs import ScopeRuns, TraceFile
from drillctl.generation.job import names_of
from drillctl.generation.waits import Advance, ignored
from drillctl.kmd import parse_program
from drillctl.kmd.queue import CAPACITY
from drillctl.machine import Library
from drillctl.plant import PlantChoice
from drillctl.replay.player import Player, playback
from drillctl.ticker.launch import RunSettings
from drillctl.ticker.sampler import signals
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Trace, TraceError, dense, read_text, write_text
from drillctl.trace.files import read_trace
from drillctl.viewmodel.scope import BACKWARDS, FORWARDS, Find, Notice, ScopeSignal
from tests.support.operator import settle

QUEUE = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 60 40\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\nKMD_LINIAd x=30 y=-7\n"
LIBRARY = Library.standard()
PATIENCE_S = 40.0


@pytest.fixture(scope="module")
def truth() -> Trace:
    """A run with every signal, as the sampler saw it."""
    machine = LIBRARY.machine("pcb-drill")
    program = parse_program(QUEUE, names_of(machine))
    ticker = Ticker.simulated(machine, traced=True, derived=True)
    ticker.queue.put(program)
    ticker.run(10**6, ticker.over)
    trace = ticker.finished_trace(())
    assert trace is not None
    return trace


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """The same run as a file, in which columns, positions and states are left out."""
    (tmp_path / "job.kmd").write_text(QUEUE)
    assert main(["run", str(tmp_path / "job.kmd"), "--trace", str(tmp_path / "job.trace")]) == 0
    return tmp_path / "job.trace"


def run_through(source: TraceFile) -> TraceFile:
    until_s = time.monotonic() + PATIENCE_S
    while any(notice.lack == "running" for notice in source.notices()):
        assert time.monotonic() < until_s
        source.turn()
    return source


def index(source: RunScope, group: str, name: str) -> int:
    return next(i for i, signal in enumerate(source.signals()) if (signal.group, signal.name) == (group, name))


def drawn(source: RunScope, signal: int) -> list[int]:
    """A lane as a value a tick, from its strip."""
    return source.strip(signal, np.arange(source.last_tick + 2)).values.tolist()


def test_a_file_is_known_at_once_and_its_columns_follow(file: Path, truth: Trace) -> None:
    source = TraceFile(file, LIBRARY)
    x_column, x_1a = index(source, "x", "column"), index(source, "x", "1a")
    assert (source.first_tick, source.last_tick, source.tick_hz) == (0, truth.end - 1, 500)
    assert source.known_to(x_1a) == truth.end and source.known_to(x_column) == 0
    assert source.notices() == (Notice("running", 0),)
    run_through(source)
    assert source.notices() == () and source.known_to(x_column) == truth.end
    for axis in "xyz":
        for field in ("column", "position", "state"):
            found = drawn(source, index(source, axis, field))
            assert found == dense(truth, f"{axis}.{field}").tolist(), (axis, field)


def test_every_wire_and_sensor_is_the_bit_of_the_machines_file(file: Path, truth: Trace) -> None:
    source = TraceFile(file, LIBRARY)
    machine = source.machine
    for axis in machine.axes:
        for name, bit in zip(axis.phase.wire_names(), axis.wire_bits, strict=True):
            assert drawn(source, index(source, axis.name, name)) == (dense(truth, "out.0") >> bit & 1).tolist()
    for sensor in machine.sensors:
        reached = dense(truth, "in.0") >> sensor.bit & 1 == sensor.active_level
        assert drawn(source, index(source, "sensors", sensor.name)) == reached.astype(int).tolist()


def test_a_sensor_that_is_low_when_reached_is_shown_reached() -> None:
    machine = LIBRARY.machine("pcb-drill")
    turned = replace(machine, sensors=tuple(replace(sensor, active_level=0) for sensor in machine.sensors))
    values = np.array([0, 1 << machine.sensors[0].bit])
    for active_level, of in ((1, machine), (0, turned)):
        lanes = [lane for signal, lane in lanes_of(of, signals(of, False, False)) if signal.name == "x_min"]
        assert [lane.of(values).tolist() for lane in lanes] == [[1 - active_level, active_level]]


def test_the_moment_under_the_cursor_is_the_machine_then(file: Path, truth: Trace) -> None:
    source = run_through(TraceFile(file, LIBRARY))
    for tick in (0, 7, truth.end // 3, truth.end // 2, truth.end - 1):
        moment = source.at(tick)
        for axis, table in zip(moment.axes, source.machine.axes, strict=True):
            seen = [truth.value_at(f"{axis.name}.{field}", tick) for field in ("position", "column", "state")]
            assert [axis.position_steps, axis.column, axis.state] == seen
            lit = [truth.value_at("out.0", tick) >> bit & 1 for bit in table.wire_bits]
            assert [on for _name, _row, on in axis.wires] == [bool(bit) for bit in lit]
    assert source.at(5).command == "1 KMD_INICJALIZACJA"
    assert source.at(truth.end).values == (None,) * len(source.signals())
    number, _colon, _name = truth.shown_at("kmd", truth.end // 2).partition(":")
    assert source.at(truth.end // 2).command.startswith(f"{number} KMD_")


EVENTS = [("step", "x.position", False), ("command", "kmd", True), ("fault", "fault", True)]


@pytest.mark.parametrize(("what", "name", "onset"), EVENTS)
def test_find_meets_every_event_once_on_the_way_there_and_back(
    file: Path, truth: Trace, what: Find, name: str, onset: bool
) -> None:
    source = run_through(TraceFile(file, LIBRARY))
    ticks, values = truth.changes_of(name)
    events = ticks[values != 0].tolist() if onset else ticks[1:].tolist()
    row = index(source, "x", "1a")
    assert walk(source, what, -1, FORWARDS, row) == events
    assert walk(source, what, truth.end, BACKWARDS, row) == events[::-1]
    source.last_tick = 1000  # a run that was published so far alone
    assert walk(source, what, -1, FORWARDS, row) == [tick for tick in events if tick <= 1000]


def walk(source: RunScope, what: Find, tick: int | None, direction: int, row: int) -> list[int]:
    found = []
    while tick is not None and (tick := source.find(what, tick, direction, row)) is not None:
        found.append(tick)
    return found


def test_a_search_from_a_row_of_no_axis_meets_the_steps_of_all(file: Path, truth: Trace) -> None:
    source = run_through(TraceFile(file, LIBRARY))
    everywhere = sorted({tick for axis in "xyz" for tick in truth.changes_of(f"{axis}.position")[0][1:].tolist()})
    assert walk(source, "step", -1, FORWARDS, index(source, "kmd", "command")) == everywhere


def test_a_window_has_every_change_of_its_ticks(file: Path, truth: Trace) -> None:
    source = TraceFile(file, LIBRARY)
    found = source.window(index(source, "x", "position"), 10, truth.end)
    assert found.ticks.tolist() == []  # not known yet
    run_through(source)
    found = source.window(index(source, "x", "position"), 10, truth.end)
    ticks, values = truth.changes_of("x.position")
    assert found.ticks.tolist() == [10, *ticks[ticks > 10].tolist()]
    assert found.values.tolist()[1:] == values[ticks > 10].tolist()


def test_a_request_in_the_first_tick_is_one_whatever_number_the_file_gives_it(file: Path) -> None:
    text = file.read_text()
    file.write_text(text.replace("\n0 request -\n", "\n0 request HOLD\n", 1).replace("\n7 ", "\n5 request -\n7 ", 1))
    source = TraceFile(file, LIBRARY)
    row = index(source, "run", "request")
    assert walk(source, "request", -1, FORWARDS, row) == [0]
    assert [source.shown(row, source.at(tick).values[row] or 0, tick) for tick in (0, 4, 5)] == ["HOLD", "HOLD", "-"]


def test_signals_that_a_file_has_itself_are_not_run_again(truth: Trace, file: Path) -> None:
    write_text(replace(truth, header=read_text(file).header), file, derived=True)
    source = TraceFile(file, LIBRARY)
    assert source.notices() == () and source.at(100).axes
    assert drawn(source, index(source, "plant", "x")) == dense(truth, "plant.x").tolist()


def ticked(file: Path) -> Trace:
    """A file's inputs played to the controller, every tick of them."""
    recorded, machine = read_trace(file), LIBRARY.machine("pcb-drill")
    ticker = Ticker(machine, playback(recorded, machine, file), traced=True, derived=True)
    ends = [*Player(ticker, recorded, machine, file).up_to(recorded.end)]
    trace = ticker.finished_trace(())
    assert trace is not None and ends[-1] == recorded.end
    return trace


HOMED = "KMD_INICJALIZACJA\nKMD_RUCHd x=20\n"


@pytest.mark.parametrize("form", [".trace", ".seg"])
@pytest.mark.parametrize("options", [(), ("--plant", "dynamic", "--seed", "3")])
def test_the_axes_at_any_tick_are_known_before_the_run_has_come_there(
    form: str, options: tuple[str, ...], tmp_path: Path
) -> None:
    """By a jump, or where the inputs are another plant's not at all; never wrongly."""
    (tmp_path / "job.kmd").write_text(HOMED)
    file = tmp_path / f"job{form}"
    assert main(["run", str(tmp_path / "job.kmd"), "--trace", str(file), *options]) == 0
    far, whole = TraceFile(file, LIBRARY), run_through(TraceFile(file, LIBRARY))
    for axis in "xyz":
        assert drawn(whole, index(whole, axis, "position")) == dense(ticked(file), f"{axis}.position").tolist()
    for tick in (whole.last_tick, whole.last_tick - 30, whole.last_tick // 2, 6, 0):
        there = far.at(tick)
        assert there == whole.at(tick) or (options and there.axes == ())
    assert far.known_to(index(far, "x", "column")) == 0


def test_a_run_may_be_opened_anywhere_in_it(file: Path, truth: Trace) -> None:
    assert TraceFile(file, LIBRARY, 700).opening_tick == 700
    with pytest.raises(TraceError, match=f"no tick {truth.end}: it has {truth.end} ticks"):
        TraceFile(file, LIBRARY, truth.end)


@pytest.mark.parametrize(
    ("old", "new", "lacks"),
    [("digest ", "digest 0", {"other tables"}), ("plant ideal", "overrun 1", {"underivable"}),
     ("KMD_GOTO_X_Y 60", "KMD_NONSENSE 60", {"underivable"})],
)  # fmt: skip
def test_what_can_not_be_found_is_said(file: Path, old: str, new: str, lacks: set[str]) -> None:
    file.write_text(file.read_text().replace(old, new, 1))
    source = TraceFile(file, LIBRARY)
    source.turn()
    assert {notice.lack for notice in source.notices()} == lacks
    assert source.at(50).values[index(source, "x", "1a")] is not None


def test_a_run_that_would_take_too_much_memory_is_known_in_part(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    job, file = file.with_suffix(".kmd"), file.with_suffix(".seg")
    job.write_text("KMD_RUCHd x=3\nKMD_RUCHd x=-3\n" * CAPACITY)
    assert main(["run", str(job), "--trace", str(file)]) == 0
    monkeypatch.setattr(tracefile, "MOST_ROWS", len(TraceFile(file, LIBRARY).lanes) + 16 * CAPACITY)
    source = TraceFile(file, LIBRARY)
    while source.notices()[0].lack == "running":
        source.turn()
    known = source.known_to(index(source, "x", "column"))
    assert source.notices() == (Notice("too long", known),) and 0 < known < source.last_tick
    x_column = index(source, "x", "column")
    assert source.window(x_column, known - 9, known + 9).ticks[-1] < known and source.first_tick == 0
    assert source.at(known - 1).axes and source.at(known).axes


def test_a_run_on_the_dynamic_plant_has_its_lanes_from_a_file_too(tmp_path: Path) -> None:
    job, file = tmp_path / "job.kmd", tmp_path / "job.trace"
    job.write_text(QUEUE)
    told = ("--plant", "dynamic", "--seed", "7", "--fault", "loose.x=0.3")
    assert main(["run", str(job), *told, "--trace", str(file)]) == 0
    machine = LIBRARY.machine("pcb-drill")
    ticker = Ticker.simulated(machine, True, True, PlantChoice("dynamic", ("loose.x=0.3",), 7))
    ticker.queue.put(parse_program(QUEUE, names_of(machine)))
    ticker.run(10**6, ticker.over)
    truth = ticker.finished_trace(())
    assert truth is not None
    source = run_through(TraceFile(file, LIBRARY))
    shown = [signal.name for signal in source.signals() if signal.group == "plant"]
    assert ticker.plant is not None and len(ticker.plant.lanes) == 4
    assert shown == [f"{axis}{lane}" for axis in "xyz" for lane in ticker.plant.lanes]
    for name in shown:
        values = dense(truth, f"plant.{name}")
        assert np.ptp(values) and drawn(source, index(source, "plant", name)) == values.tolist()


def test_a_run_on_the_ideal_plant_has_no_lanes_of_one(file: Path) -> None:
    assert not [signal for signal in TraceFile(file, LIBRARY).signals() if signal.group == "plant"]


@pytest.fixture
def console() -> Iterator[MachineConsole]:
    made = MachineConsole(LIBRARY, LIBRARY.machine("pcb-drill"), RunSettings(pace="free"))
    yield made
    made.close()


def test_the_machines_run_is_recorded_as_the_sampler_sees_it(console: MachineConsole, truth: Trace) -> None:
    console.run_queue(QUEUE)
    settle(console)
    recording = ScopeRuns(LIBRARY, console).running()
    recording.turn()
    assert recording.last_tick >= truth.end - 1 and recording.notices() == ()
    for axis in "xyz":
        for field in ("column", "position", "state"):
            found = drawn(recording, index(recording, axis, field))[: truth.end]
            assert found == dense(truth, f"{axis}.{field}").tolist()
        assert drawn(recording, index(recording, "plant", axis))[: truth.end] == dense(truth, f"plant.{axis}").tolist()


def test_commands_are_shown_as_they_were_written_job_by_job(console: MachineConsole) -> None:
    console.run_queue("KMD_RUCHd x=5\nKMD_CZEKAJ 3\n")
    settle(console)
    console.run_queue("KMD_RUCHd x=-5\n")
    settle(console)
    source = console.recording
    source.turn()
    ticks = walk(source, "command", -1, FORWARDS, 0)
    texts = [source.at(tick).command for tick in ticks]
    assert texts == ["1 KMD_RUCHd x=5", "2 KMD_CZEKAJ 3", "3 KMD_KONIEC", "4 KMD_RUCHd x=-5", "5 KMD_KONIEC"]


def test_a_long_recording_forgets_its_beginning_and_says_so(
    console: MachineConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(scope, "MOST_ROWS", 3000)
    assert console.choose_machine("pcb-drill") == ()
    console.run_queue("KMD_RUCHd x=900\nKMD_RUCHd x=-900\n")
    settle(console)
    source = console.recording
    source.turn()
    assert 0 < source.first_tick < source.last_tick and len(source.lanes) <= 3000
    assert source.notices() == (Notice("forgotten", source.first_tick),)
    assert source.at(source.first_tick).axes and not source.at(source.first_tick - 1).axes


def test_another_machine_has_a_recording_of_its_own(console: MachineConsole) -> None:
    before = console.recording
    assert console.choose_machine("eight-axis") == ()
    after = ScopeRuns(LIBRARY, console).running()
    assert after is not before and after.last_tick < after.first_tick
    assert ScopeSignal("c", "position", "count") in after.signals() or len(after.machine.axes) == 8


def test_a_file_is_refused_with_the_reason_and_not_while_the_machine_works(console: MachineConsole, file: Path) -> None:
    bench = ScopeRuns(LIBRARY, console)
    source, problems = bench.open_trace(str(file))
    assert problems == () and source is not None and source.name == "job.trace (pcb-drill)"
    (file.parent / "bad.trace").write_text("hello\n")
    source, problems = bench.open_trace(str(file.parent / "bad.trace"))
    assert source is None and "bad.trace:1: not a trace" in problems[0]
    assert "can't be read" in bench.open_trace("/nowhere.trace")[1][0]
    console.jog("x", 300)
    assert bench.open_trace(str(file)) == (None, (BUSY,))


def test_what_is_done_while_a_file_is_opened_is_told(file: Path) -> None:
    told: list[str] = []

    def waits(what: str) -> Advance:
        told.append(what)
        return ignored

    TraceFile(file, LIBRARY, waits=waits)
    assert told == ["reading job.trace", "laying out the waves"]


def test_a_shipped_queue_is_the_same_in_file_and_machine(console: MachineConsole, tmp_path: Path) -> None:
    square = Path(__file__).resolve().parents[2] / "examples" / "square.kmd"
    assert main(["run", str(square), "--trace", str(tmp_path / "square.trace")]) == 0
    source = TraceFile(tmp_path / "square.trace", LIBRARY)
    assert source.last_tick + 1 == read_text(tmp_path / "square.trace").end
    console.run_queue(square.read_text())
    settle(console)
    console.recording.turn()
    for signal in ("1a", "24b"):
        row = index(source, "x", signal)
        mine, theirs = drawn(source, row), drawn(console.recording, index(console.recording, "x", signal))
        assert mine == theirs[: len(mine)]
