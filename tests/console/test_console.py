"""The operator's console without a screen: what is asked happens, what can't be is refused with a reason."""

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.ticker.paced_link import PacedLink
from drillctl.viewmodel.console import Asked
from tests.support.operator import settle, until

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def station() -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill").at_rate(5000), RunSettings(pace="real"))
    yield made
    made.close()


def test_initialise_jog_base_and_go(station: MachineConsole) -> None:
    assert station.initialise() == ()
    settle(station)
    assert station.view().position_known
    assert station.jog("x", 300) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300
    assert station.set_base() == ()
    settle(station)
    assert station.view().axes[0].position_mm == 0
    assert station.go_to(2.54, 0.0) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300 + 120


def test_a_board_is_loaded_and_drilled_dry(station: MachineConsole) -> None:
    assert station.start(dry=True) == ("no board is loaded: open a drill file first",)
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked(order="nearest")) == ()
    board = station.board()
    assert board is not None and len(board.xy_mm) == 26 and board.estimate.ticks > 0
    assert station.start(dry=True) == ()
    settle(station)
    view, progress = station.view(), station.progress()
    assert view.fault is None and view.lost_steps == (0, 0, 0)
    assert progress is not None and (progress.holes_done, progress.holes_total) == (26, 26)
    assert (view.axes[0].position_steps, view.axes[1].position_steps) == (0, 0)


def test_a_bad_file_leaves_the_board_as_it_was(station: MachineConsole, tmp_path: Path) -> None:
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked()) == ()
    (tmp_path / "bad.drl").write_text("hello\n")
    problems = station.load(str(tmp_path / "bad.drl"), Asked())
    assert len(problems) == 1 and "bad.drl" in problems[0]
    board = station.board()
    assert board is not None and board.name == "blinker.drl"


def test_hold_resume_and_stop(station: MachineConsole) -> None:
    station.initialise()
    settle(station)
    assert station.jog("x", 9000) == ()
    for _ in range(20):
        station.turn()
    assert station.hold() == ()
    until(station, lambda: station.view().condition == "held")
    held_at = station.view().axes[0].position_steps
    assert 0 < held_at < 9000
    assert station.jog("y", 5)[0].startswith("the machine is at work")
    assert station.resume() == ()
    settle(station)
    assert station.view().axes[0].position_steps == 9000
    station.jog("x", -9000)
    for _ in range(20):
        station.turn()
    station.stop()
    settle(station)
    view = station.view()
    assert view.position_known and view.condition == "ready" and 0 < view.axes[0].position_steps < 9000


def test_an_emergency_stop_latches_until_it_is_acknowledged(station: MachineConsole) -> None:
    station.initialise()
    settle(station)
    assert station.emergency_stop() == ()
    until(station, lambda: station.view().condition == "latched")
    view = station.view()
    assert view.fault is not None and view.fault.name == "EMERGENCY_STOP" and not view.position_known
    assert station.jog("x", 5) == ("a fault waits to be acknowledged",)
    assert station.acknowledge() == ()
    until(station, lambda: station.view().condition == "ready")
    assert station.initialise() == ()
    settle(station)
    assert station.view().position_known


def test_a_fault_in_a_queue_is_told(station: MachineConsole) -> None:
    assert station.run_queue("KMD_GOTO_X_Y 1 1\n") == ()
    settle(station)
    fault = station.view().fault
    assert fault is not None and fault.name == "HOMING_REQUIRED"
    assert station.run_queue("KMD_NONSENSE\n")[0].startswith("queue:1:1: unknown command")


def test_another_machine_starts_anew(station: MachineConsole) -> None:
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked()) == ()
    assert station.choose_machine("boiler-drum") == ()
    assert station.view().machine == "boiler-drum" and station.board() is None
    assert "no machine of this name" in station.choose_machine("nonsense")[0]


def test_a_busy_desk_at_rest_loses_nothing_and_a_moving_machine_takes_no_board(station: MachineConsole) -> None:
    """Reading and planning a large board may take seconds."""
    station.initialise()
    settle(station)
    time.sleep(1.5)
    station.turn()
    assert station.view().fault is None and station.view().position_known
    station.jog("x", 9000)
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked())[0].startswith("the machine is at work")
    settle(station)


def test_a_ticker_that_was_killed_is_told_of_and_started_anew(station: MachineConsole) -> None:
    station.initialise()
    settle(station)
    station.jog("x", 3000)
    assert isinstance(station.link, PacedLink)
    os.kill(station.link._ticker.pid, signal.SIGKILL)
    settle(station)
    view = station.view()
    assert view.fault is not None and view.fault.name == "TICKER_LOST" and view.fault.position == "lost"
    assert (view.condition, view.moving, view.position_known, view.command) == ("latched", False, False, "")
    assert "acknowledge" in station.initialise()[0]
    assert station.acknowledge() == ()
    assert station.view().fault is None
    assert station.initialise() == ()
    settle(station)
    assert station.view().position_known
