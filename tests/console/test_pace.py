"""The tick rate from the operator's console: set at rest, shown once it is in force, refused with the rate there is."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library, shipped_tables
from drillctl.machine.edit import set_pattern, set_value
from drillctl.ticker import launch as machinery
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.job_options import JobOptions
from tests.support.operator import settle, until

pytestmark = pytest.mark.paced

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
PACES = ["free", pytest.param("real", marks=pytest.mark.skipif(sys.platform != "linux", reason="real pace"))]


@pytest.fixture(params=PACES)
def console(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[MachineConsole]:
    library = Library((tmp_path, shipped_tables()))
    made = MachineConsole(library, library.machine("pcb-drill"), RunSettings(pace=request.param))
    yield made
    made.close()


def test_the_rate_is_shown_once_it_is_in_force_and_the_position_stays(console: MachineConsole) -> None:
    console.run_queue("KMD_RUCHd x=5\n")
    settle(console)
    before = console.view()
    assert before.tick_hz == 500 and console.set_tick_hz(580) == ()
    until(console, lambda: console.view().tick_hz == 580)
    view = console.view()
    assert view.axes == before.axes and view.position_known == before.position_known and view.fault is None
    assert "the tick rate was set to 580 Hz; it was 500" in view.notices
    assert console.machine.longest_drilling_ticks == (18 * 580)


def test_at_work_it_is_refused_and_so_is_what_is_no_rate(console: MachineConsole) -> None:
    for hz in (0, -1, 100_001):
        assert console.set_tick_hz(hz) == (f"the tick rate can be 1 to 100000 Hz, not {hz}",)
    console.run_queue("KMD_CZEKAJ 1000000\n")
    assert console.set_tick_hz(580) == ("the machine is at work; hold or stop it first",)
    console.stop()
    settle(console)
    assert console.view().tick_hz == 500


def test_a_port_that_can_not_carry_it_refuses_with_the_rate_it_can(
    console: MachineConsole, monkeypatch: pytest.MonkeyPatch
) -> None:
    used = console.used
    used.running = RunSettings(port="firmata:/dev/ttyACM0", pace="real")  # not opened: the rate alone is looked at
    (refusal,) = console.set_tick_hz(5000)
    assert "5000 interrupts a second are too many for it with 3 axes moving; --tick-hz" in refusal
    used.running = RunSettings(pace="real")
    monkeypatch.setattr(machinery, "most_ticks_hz", lambda machine: 700)
    (refusal,) = console.set_tick_hz(701)
    assert "701 ticks a second of pcb-drill are too many for this computer; --tick-hz 700 is the most" in refusal


def test_a_board_on_the_desk_takes_its_time_by_the_new_rate(console: MachineConsole) -> None:
    console.load(str(EXAMPLES / "blinker.drl"), JobOptions())
    console.set_tick_hz(580)
    until(console, lambda: console.view().tick_hz == 580)
    board = console.board()
    assert board is not None and board.estimate.tick_hz == 580


def test_edited_tables_are_taken_at_the_rate_in_force(console: MachineConsole, tmp_path: Path) -> None:
    console.run_queue("KMD_RUCHd x=5\n")
    settle(console)
    console.set_tick_hz(580)
    until(console, lambda: console.view().tick_hz == 580)
    table = console.machine.axes[0].phase
    text = Path(next(file for file in console.machine.files if Path(file).stem == table.name)).read_text()
    (tmp_path / "phase").mkdir()
    (tmp_path / "phase" / f"{table.name}.toml").write_text(set_pattern(text, table.wires[0].name, "x" * 12))
    assert console.choose_machine("pcb-drill") == ()
    assert console.view().axes[0].position_steps == 5 and console.view().tick_hz == 580


def test_another_rate_in_the_machines_file_starts_it_anew(console: MachineConsole, tmp_path: Path) -> None:
    console.set_tick_hz(580)
    until(console, lambda: console.view().tick_hz == 580)
    text = Path(console.machine.file).read_text()
    (tmp_path / "machines").mkdir()
    (tmp_path / "machines" / "pcb-drill.toml").write_text(set_value(text, ("tick_hz",), 400))
    assert console.choose_machine("pcb-drill") == ()
    assert console.view().tick_hz == 400


def test_the_scope_says_where_the_rate_changed(console: MachineConsole) -> None:
    console.run_queue("KMD_RUCHd x=5\n")
    settle(console)
    ticks = console.view().tick
    console.set_tick_hz(580)
    until(console, lambda: console.view().tick_hz == 580)
    console.recording.turn()
    notices = [(notice.lack, notice.value) for notice in console.recording.notices()]
    assert notices == [("other rate", ticks)] and console.recording.tick_hz == 580
