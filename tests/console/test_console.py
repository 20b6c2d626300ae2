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
from drillctl.viewmodel.job_options import JobOptions
from tests.support.operator import settle, until

pytestmark = pytest.mark.paced

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def console() -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(library, library.machine("pcb-drill").at_rate(5000), RunSettings(pace="real"))
    yield made
    made.close()


def test_initialise_jog_base_and_go(console: MachineConsole) -> None:
    assert console.initialise() == ()
    settle(console)
    assert console.view().position_known
    assert console.jog("x", 300) == ()
    settle(console)
    assert console.view().axes[0].position_steps == 300
    assert console.set_base() == ()
    settle(console)
    assert console.view().axes[0].position_mm == 0
    assert console.go_to(2.54, 0.0) == ()
    settle(console)
    assert console.view().axes[0].position_steps == 300 + 120


def test_a_board_is_loaded_and_drilled_dry(console: MachineConsole) -> None:
    assert console.start(dry=True) == ("no board is loaded: open a drill file first",)
    assert console.load(str(EXAMPLES / "blinker.drl"), JobOptions(order="nearest")) == ()
    board = console.board()
    assert board is not None and len(board.xy_mm) == 26 and board.estimate.ticks > 0
    assert console.start(dry=True) == ()
    settle(console)
    view, progress = console.view(), console.progress()
    assert view.fault is None and view.lost_steps == (0, 0, 0)
    assert progress is not None and (progress.holes_done, progress.holes_total) == (26, 26)
    assert (view.axes[0].position_steps, view.axes[1].position_steps) == (0, 0)


def test_a_bad_file_leaves_the_board_as_it_was(console: MachineConsole, tmp_path: Path) -> None:
    assert console.load(str(EXAMPLES / "blinker.drl"), JobOptions()) == ()
    (tmp_path / "bad.drl").write_text("hello\n")
    problems = console.load(str(tmp_path / "bad.drl"), JobOptions())
    assert len(problems) == 1 and "bad.drl" in problems[0]
    board = console.board()
    assert board is not None and board.name == "blinker.drl"


def test_hold_resume_and_stop(console: MachineConsole) -> None:
    console.initialise()
    settle(console)
    assert console.jog("x", 9000) == ()
    for _ in range(20):
        console.turn()
    assert console.hold() == ()
    until(console, lambda: console.view().condition == "held")
    held_at = console.view().axes[0].position_steps
    assert 0 < held_at < 9000
    assert console.jog("y", 5)[0].startswith("the machine is at work")
    assert console.resume() == ()
    settle(console)
    assert console.view().axes[0].position_steps == 9000
    console.jog("x", -9000)
    for _ in range(20):
        console.turn()
    console.stop()
    settle(console)
    view = console.view()
    assert view.position_known and view.condition == "ready" and 0 < view.axes[0].position_steps < 9000


def test_an_emergency_stop_latches_until_it_is_acknowledged(console: MachineConsole) -> None:
    console.initialise()
    settle(console)
    assert console.emergency_stop() == ()
    until(console, lambda: console.view().condition == "latched")
    view = console.view()
    assert view.fault is not None and view.fault.name == "EMERGENCY_STOP" and not view.position_known
    assert console.jog("x", 5) == ("a fault waits to be acknowledged",)
    assert console.acknowledge() == ()
    until(console, lambda: console.view().condition == "ready")
    assert console.initialise() == ()
    settle(console)
    assert console.view().position_known


def test_a_fault_in_a_queue_is_told(console: MachineConsole) -> None:
    assert console.run_queue("KMD_GOTO_X_Y 1 1\n") == ()
    settle(console)
    fault = console.view().fault
    assert fault is not None and fault.name == "HOMING_REQUIRED"
    assert console.run_queue("KMD_NONSENSE\n")[0].startswith("queue:1:1: unknown command")


def test_another_machine_starts_anew(console: MachineConsole) -> None:
    assert console.load(str(EXAMPLES / "blinker.drl"), JobOptions()) == ()
    assert console.choose_machine("pcb-drill-ramp-lab") == ()
    assert console.view().machine == "pcb-drill-ramp-lab" and console.board() is None
    assert "no machine of this name" in console.choose_machine("nonsense")[0]


def test_a_busy_desk_at_rest_loses_nothing_and_a_moving_machine_takes_no_board(console: MachineConsole) -> None:
    """Reading and planning a large board may take seconds."""
    console.initialise()
    settle(console)
    time.sleep(1.5)
    console.turn()
    assert console.view().fault is None and console.view().position_known
    time.sleep(1.5)
    assert console.jog("x", 9000) == ()
    until(console, lambda: console.view().moving)
    assert console.load(str(EXAMPLES / "blinker.drl"), JobOptions())[0].startswith("the machine is at work")
    settle(console)
    assert console.view().fault is None


def test_a_ticker_that_was_killed_is_told_of_and_started_anew(console: MachineConsole) -> None:
    console.initialise()
    settle(console)
    console.jog("x", 3000)
    assert isinstance(console.link, PacedLink)
    os.kill(console.link._ticker.pid, signal.SIGKILL)
    settle(console)
    view = console.view()
    assert view.fault is not None and view.fault.name == "TICKER_LOST" and view.fault.position == "lost"
    assert (view.condition, view.moving, view.position_known, view.command) == ("latched", False, False, "")
    assert "acknowledge" in console.initialise()[0]
    assert console.acknowledge() == ()
    assert console.view().fault is None
    assert console.initialise() == ()
    settle(console)
    assert console.view().position_known
