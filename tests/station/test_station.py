"""The operator's console without a screen: what is asked happens, what can't be is refused with a reason."""

import os
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.machine import Library
from drillctl.panel.console import Asked, Problems
from drillctl.station.station import Station
from drillctl.wiring.machinery import Running
from drillctl.wiring.paced import PacedLink
from tests.support.operator import settle, until

Begin = Callable[[Station], Problems]
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def station() -> Iterator[Station]:
    library = Library.standard()
    made = Station(library, library.machine("pcb-drill").at_rate(5000), Running(pace="real"))
    yield made
    made.close()


def test_initialise_jog_base_and_go(station: Station) -> None:
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


def test_a_board_is_loaded_and_drilled_dry(station: Station) -> None:
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


def test_a_bad_file_leaves_the_board_as_it_was(station: Station, tmp_path: Path) -> None:
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked()) == ()
    (tmp_path / "bad.drl").write_text("hello\n")
    problems = station.load(str(tmp_path / "bad.drl"), Asked())
    assert len(problems) == 1 and "bad.drl" in problems[0]
    board = station.board()
    assert board is not None and board.name == "blinker.drl"


def test_hold_resume_and_stop(station: Station) -> None:
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


BEGUN: dict[str, Begin] = {
    "a jog": lambda station: station.jog("x", 300),
    "a place": lambda station: station.go_to(10.0, 10.0),
    "a queue": lambda station: station.run_queue("KMD_GOTO_X_Y 500 500\n"),
    "a board": lambda station: station.start(dry=False),
    "a dry run": lambda station: station.start(dry=True),
}
NOT_BEGUN_STEPS = 5


@pytest.fixture(params=["free", "real"])
def with_a_board(request: pytest.FixtureRequest) -> Iterator[Station]:
    library = Library.standard()
    made = Station(library, library.machine("pcb-drill"), Running(pace=request.param), tools="assume")
    assert made.load(str(EXAMPLES / "blinker.drl"), Asked()) == () == made.initialise()
    settle(made)
    yield made
    made.close()


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_hold_in_one_breath_with_the_start_holds_before_anything_moves(with_a_board: Station, begin: Begin) -> None:
    """By then no command has been taken from the queue that could be held."""
    station = with_a_board
    assert begin(station) == () == station.hold()
    until(station, lambda: station.view().condition == "held")
    assert station.at_work and farthest(station) < NOT_BEGUN_STEPS
    assert station.resume() == ()
    until(station, lambda: station.view().condition == "ready")
    assert station.at_work and station.stop() == ()
    settle(station)


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_stop_in_one_breath_with_the_start_ends_it(with_a_board: Station, begin: Begin) -> None:
    station = with_a_board
    assert begin(station) == () == station.stop()
    until(station, lambda: not station.at_work)
    assert station.view().condition == "ready" and farthest(station) < NOT_BEGUN_STEPS


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_an_emergency_stop_in_one_breath_with_the_start_latches(with_a_board: Station, begin: Begin) -> None:
    station = with_a_board
    assert begin(station) == () == station.emergency_stop()
    until(station, lambda: not station.at_work)
    assert station.view().condition == "latched" and farthest(station) < NOT_BEGUN_STEPS


def test_what_follows_a_stop_at_rest_in_one_breath_is_done(with_a_board: Station) -> None:
    station = with_a_board
    assert station.stop() == () == station.jog("x", 30)
    settle(station)
    assert station.view().axes[0].position_steps == 30


def space(station: Station) -> None:
    """As the screen has it: one key holds and lets go on."""
    assert (station.resume() if station.view().condition in ("holding", "held") else station.hold()) == ()


def test_two_holds_in_one_breath_hold_nothing_up(with_a_board: Station) -> None:
    """What was wanted last is what comes of it."""
    station = with_a_board
    assert station.jog("x", 9000) == ()
    until(station, lambda: station.view().axes[0].position_steps > 30)
    space(station)
    space(station)
    for _ in range(20):
        station.turn()
    settle(station)
    assert station.view().axes[0].position_steps == 9000


def test_two_keys_of_a_held_machine_leave_it_held(with_a_board: Station) -> None:
    station = with_a_board
    assert station.start(dry=False) == () == station.hold()
    until(station, lambda: station.view().condition == "held")
    space(station)
    space(station)
    for _ in range(200):
        station.turn()
    assert station.view().condition == "held" and station.at_work


def test_a_base_that_was_not_taken_is_none(with_a_board: Station) -> None:
    """Asked for, and stopped in the same breath."""
    station = with_a_board
    station.jog("x", 300)
    settle(station)
    assert station.set_base() == () == station.emergency_stop()
    until(station, lambda: not station.at_work)
    assert station.view().axes[0].position_mm == pytest.approx(6.35)


def test_a_base_of_a_queue_is_the_operators(with_a_board: Station) -> None:
    station = with_a_board
    assert station.run_queue("KMD_RUCHd x=300\nKMD_BAZA\nKMD_RUCHd x=60\n") == ()
    settle(station)
    assert station.view().axes[0].position_mm == pytest.approx(1.27)
    assert station.go_to(0.0, 0.0) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300


def test_after_a_board_that_never_took_its_base_again_millimetres_are_the_operators(with_a_board: Station) -> None:
    station = with_a_board
    station.jog("x", 300)
    settle(station)
    station.set_base()
    settle(station)
    assert station.start(dry=True) == ()
    until(station, lambda: station.view().command.startswith("KMD_GOTO"))
    station.stop()
    until(station, lambda: not station.at_work)
    assert int(station.link.status()["base"][0]) == 0, "it had only initialised"
    x = station.view().axes[0]
    assert x.position_mm == pytest.approx((x.position_steps - 300) / x.steps_per_mm)
    assert station.go_to(0.0, 0.0) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300
    board = station.board()
    assert board is not None and station.start(dry=True) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300, "drilled from there"


def farthest(station: Station) -> int:
    return max(abs(axis.position_steps) for axis in station.view().axes)


def test_an_emergency_stop_latches_until_it_is_acknowledged(station: Station) -> None:
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


def test_a_fault_in_a_queue_is_told(station: Station) -> None:
    assert station.run_queue("KMD_GOTO_X_Y 1 1\n") == ()
    settle(station)
    fault = station.view().fault
    assert fault is not None and fault.name == "HOMING_REQUIRED"
    assert station.run_queue("KMD_NONSENSE\n")[0].startswith("queue:1:1: unknown command")


def test_another_machine_starts_anew(station: Station) -> None:
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked()) == ()
    assert station.choose_machine("boiler-drum") == ()
    assert station.view().machine == "boiler-drum" and station.board() is None
    assert "no machine of this name" in station.choose_machine("nonsense")[0]


def test_a_busy_desk_at_rest_loses_nothing_and_a_moving_machine_takes_no_board(station: Station) -> None:
    """Reading and planning a large board may take seconds."""
    station.initialise()
    settle(station)
    time.sleep(1.5)
    station.turn()
    assert station.view().fault is None and station.view().position_known
    station.jog("x", 9000)
    assert station.load(str(EXAMPLES / "blinker.drl"), Asked())[0].startswith("the machine is at work")
    settle(station)


def test_a_ticker_that_was_killed_is_told_of_and_started_anew(station: Station) -> None:
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
