"""Keys in one breath: what was asked last counts, though the machine is a tick or two behind it, or has not begun."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import Asked, Problems
from tests.support.operator import settle, until

Begin = Callable[[MachineConsole], Problems]
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
BEGUN: dict[str, Begin] = {
    "a jog": lambda station: station.jog("x", 300),
    "a place": lambda station: station.go_to(10.0, 10.0),
    "a queue": lambda station: station.run_queue("KMD_GOTO_X_Y 500 500\n"),
    "a board": lambda station: station.start(dry=False),
    "a dry run": lambda station: station.start(dry=True),
}
NOT_BEGUN_STEPS = 60  # of the 236 and more that are asked for


@pytest.fixture(params=["free", "real"])
def station(request: pytest.FixtureRequest) -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(
        library, library.machine("pcb-drill").at_rate(2000), RunSettings(pace=request.param), tools="assume"
    )
    assert made.load(str(EXAMPLES / "blinker.drl"), Asked()) == () == made.initialise()
    settle(made)
    yield made
    made.close()


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_hold_in_one_breath_with_the_start_holds_before_anything_moves(station: MachineConsole, begin: Begin) -> None:
    """By then no command has been taken from the queue that could be held."""
    assert begin(station) == () == station.hold()
    until(station, lambda: station.view().condition == "held")
    assert station.at_work and farthest(station) < NOT_BEGUN_STEPS
    assert station.resume() == ()
    until(station, lambda: station.view().condition == "ready")
    assert station.at_work and station.stop() == ()
    settle(station)


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_stop_in_one_breath_with_the_start_ends_it(station: MachineConsole, begin: Begin) -> None:
    assert begin(station) == () == station.stop()
    until(station, lambda: not station.at_work)
    assert station.view().condition == "ready" and farthest(station) < NOT_BEGUN_STEPS


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_an_emergency_stop_in_one_breath_with_the_start_latches(station: MachineConsole, begin: Begin) -> None:
    assert begin(station) == () == station.emergency_stop()
    until(station, lambda: not station.at_work)
    assert station.view().condition == "latched" and farthest(station) < NOT_BEGUN_STEPS


def test_what_follows_a_stop_at_rest_in_one_breath_is_done(station: MachineConsole) -> None:
    assert station.stop() == () == station.jog("x", 30)
    settle(station)
    assert station.view().axes[0].position_steps == 30


def space(station: MachineConsole) -> None:
    """As the screen has it: one key holds and lets go on."""
    assert (station.resume() if station.view().condition in ("holding", "held") else station.hold()) == ()


def test_two_holds_in_one_breath_hold_nothing_up(station: MachineConsole) -> None:
    """What was wanted last is what comes of it."""
    assert station.jog("x", 9000) == ()
    until(station, lambda: station.view().axes[0].position_steps > 30)
    space(station)
    space(station)
    for _ in range(20):
        station.turn()
    settle(station)
    assert station.view().axes[0].position_steps == 9000


def test_two_keys_of_a_held_machine_leave_it_held(station: MachineConsole) -> None:
    assert station.start(dry=False) == () == station.hold()
    until(station, lambda: station.view().condition == "held")
    space(station)
    space(station)
    for _ in range(200):
        station.turn()
    assert station.view().condition == "held" and station.at_work


def test_a_base_that_was_not_taken_is_none(station: MachineConsole) -> None:
    """Asked for, and stopped in the same breath."""
    station.jog("x", 300)
    settle(station)
    assert station.set_base() == () == station.emergency_stop()
    until(station, lambda: not station.at_work)
    assert station.view().axes[0].position_mm == pytest.approx(6.35)


def test_a_base_of_a_queue_is_the_operators(station: MachineConsole) -> None:
    assert station.run_queue("KMD_RUCHd x=300\nKMD_BAZA\nKMD_RUCHd x=60\n") == ()
    settle(station)
    assert station.view().axes[0].position_mm == pytest.approx(1.27)
    assert station.go_to(0.0, 0.0) == ()
    settle(station)
    assert station.view().axes[0].position_steps == 300


def test_after_a_board_that_never_took_its_base_again_millimetres_are_the_operators(station: MachineConsole) -> None:
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


def farthest(station: MachineConsole) -> int:
    return max(abs(axis.position_steps) for axis in station.view().axes)
