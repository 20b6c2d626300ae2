"""Keys in one breath: what was asked last counts, though the machine is a tick or two behind it, or has not begun."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import Library
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.job_options import JobOptions
from tests.support.operator import settle, until

pytestmark = pytest.mark.paced

Begin = Callable[[MachineConsole], Problems]
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
BEGUN: dict[str, Begin] = {
    "a jog": lambda console: console.jog("x", 300),
    "a place": lambda console: console.go_to(10.0, 10.0),
    "a queue": lambda console: console.run_queue("KMD_GOTO_X_Y 500 500\n"),
    "a board": lambda console: console.start(dry=False),
    "a dry run": lambda console: console.start(dry=True),
}
NOT_BEGUN_STEPS = 60  # of the 236 and more that are asked for


@pytest.fixture(params=["free", "real"])
def console(request: pytest.FixtureRequest) -> Iterator[MachineConsole]:
    library = Library.standard()
    made = MachineConsole(
        library, library.machine("pcb-drill").at_rate(2000), RunSettings(pace=request.param), tools="assume"
    )
    assert made.load(str(EXAMPLES / "blinker.drl"), JobOptions()) == () == made.initialise()
    settle(made)
    yield made
    made.close()


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_hold_in_one_breath_with_the_start_holds_before_anything_moves(console: MachineConsole, begin: Begin) -> None:
    """By then no command has been taken from the queue that could be held."""
    assert begin(console) == () == console.hold()
    until(console, lambda: console.view().condition == "held")
    assert console.at_work and farthest(console) < NOT_BEGUN_STEPS
    assert console.resume() == ()
    until(console, lambda: console.view().condition == "ready")
    assert console.at_work and console.stop() == ()
    settle(console)


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_a_stop_in_one_breath_with_the_start_ends_it(console: MachineConsole, begin: Begin) -> None:
    assert begin(console) == () == console.stop()
    until(console, lambda: not console.at_work)
    assert console.view().condition == "ready" and farthest(console) < NOT_BEGUN_STEPS


@pytest.mark.parametrize("begin", BEGUN.values(), ids=BEGUN)
def test_an_emergency_stop_in_one_breath_with_the_start_latches(console: MachineConsole, begin: Begin) -> None:
    assert begin(console) == () == console.emergency_stop()
    until(console, lambda: not console.at_work)
    assert console.view().condition == "latched" and farthest(console) < NOT_BEGUN_STEPS


def test_what_follows_a_stop_at_rest_in_one_breath_is_done(console: MachineConsole) -> None:
    assert console.stop() == () == console.jog("x", 30)
    settle(console)
    assert console.view().axes[0].position_steps == 30


def space(console: MachineConsole) -> None:
    """As the screen has it: one key holds and lets go on."""
    assert (console.resume() if console.view().condition in ("holding", "held") else console.hold()) == ()


def test_two_holds_in_one_breath_hold_nothing_up(console: MachineConsole) -> None:
    """What was wanted last is what comes of it."""
    assert console.jog("x", 9000) == ()
    until(console, lambda: console.view().axes[0].position_steps > 30)
    space(console)
    space(console)
    for _ in range(20):
        console.turn()
    settle(console)
    assert console.view().axes[0].position_steps == 9000


def test_two_keys_of_a_held_machine_leave_it_held(console: MachineConsole) -> None:
    assert console.start(dry=False) == () == console.hold()
    until(console, lambda: console.view().condition == "held")
    space(console)
    space(console)
    for _ in range(200):
        console.turn()
    assert console.view().condition == "held" and console.at_work


def test_a_base_that_was_not_taken_is_none(console: MachineConsole) -> None:
    """Asked for, and stopped in the same breath: a clock that runs on may take it between the two."""
    console.jog("x", 300)
    settle(console)
    assert console.set_base() == () == console.emergency_stop()
    until(console, lambda: not console.at_work)
    taken = int(console.link.status()["base"][0])
    assert taken in ((0,) if console.used.runs_free else (0, 300))
    assert console.view().axes[0].position_mm == pytest.approx((300 - taken) * 6.35 / 300)


def test_a_base_of_a_queue_is_the_operators(console: MachineConsole) -> None:
    assert console.run_queue("KMD_RUCHd x=300\nKMD_BAZA\nKMD_RUCHd x=60\n") == ()
    settle(console)
    assert console.view().axes[0].position_mm == pytest.approx(1.27)
    assert console.go_to(0.0, 0.0) == ()
    settle(console)
    assert console.view().axes[0].position_steps == 300


def test_after_a_board_that_never_took_its_base_again_millimetres_are_the_operators(console: MachineConsole) -> None:
    console.jog("x", 300)
    settle(console)
    console.set_base()
    settle(console)
    assert console.start(dry=True) == ()
    until(console, lambda: console.view().command.startswith("KMD_GOTO"))
    console.stop()
    until(console, lambda: not console.at_work)
    assert int(console.link.status()["base"][0]) == 0, "it had only initialised"
    x = console.view().axes[0]
    assert x.position_mm == pytest.approx((x.position_steps - 300) / x.steps_per_mm)
    assert console.go_to(0.0, 0.0) == ()
    settle(console)
    assert console.view().axes[0].position_steps == 300
    board = console.board()
    assert board is not None and console.start(dry=True) == ()
    settle(console)
    assert console.view().axes[0].position_steps == 300, "drilled from there"


def farthest(console: MachineConsole) -> int:
    return max(abs(axis.position_steps) for axis in console.view().axes)
