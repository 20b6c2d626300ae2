"""The invariants of tests/support/invariants.py fail where execution is broken on purpose, and hold where it is not."""

from collections.abc import Callable
from importlib import import_module

import pytest

from drillctl.execution import limit_checks
from drillctl.execution.axis import Axis
from drillctl.kmd import Fault, Request
from tests.support.bench import Bench, shipped
from tests.support.invariants import Invariants

TICK = import_module("drillctl.execution.tick")  # the package has a function of this name
Break = Callable[[pytest.MonkeyPatch], None]
Disturb = Callable[[Bench], None]


def without_range_checks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither the check of a command's target nor that of a moving axis."""
    monkeypatch.setattr(Axis, "in_reach", lambda axis, target: True)
    monkeypatch.setattr(limit_checks, "_watch", lambda m, axis, sensors: Fault.NONE)


def with_windings_left_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """A new column is added to the last one instead of taking its place."""
    put_column = Axis.put_column

    def added(axis: Axis) -> bool:
        bits, hold_bits = axis.bits, axis.hold_bits
        stepped = put_column(axis)
        axis.bits |= bits
        axis.hold_bits |= hold_bits
        return stepped

    monkeypatch.setattr(Axis, "put_column", added)


def with_guard_while_latched(monkeypatch: pytest.MonkeyPatch) -> None:
    """The guard runs in the stage in which nothing can be stopped any more."""
    monkeypatch.setattr(TICK, "LATCHED", -1)


def with_forcing_at_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """No axis that comes to rest has its forcing wires taken off."""
    monkeypatch.setattr(TICK, "SETTLES", frozenset())


def go_far(b: Bench) -> None:
    """A move that ends beyond the near end of the range."""
    b.queue(f"KMD_RUCH x={b.m.axes[0].low - 20}")


def go(b: Bench) -> None:
    """A move within the range, to a column that has a forcing wire on."""
    b.queue("KMD_RUCH x=21")


def latch_with_two_ends_on(b: Bench) -> None:
    """An emergency stop, and both end sensors of an axis read on from then."""
    b.ask(Request.ESTOP).tick()
    b.card.stuck_high, b.card.stuck_low = b.input_bit("x_min") | b.input_bit("x_max"), 0


PLANTED: list[tuple[Break, Disturb, str]] = [
    (without_range_checks, go_far, "outside its travel"),
    (with_windings_left_on, go, "bits that the column"),
    (with_guard_while_latched, latch_with_two_ends_on, "a latched machine acts"),
    (with_forcing_at_rest, go, "forcing a tick after"),
]


def run_checked(disturb: Disturb, break_it: Callable[[], None] = lambda: None) -> None:
    """A homed machine, broken, disturbed, and run for so long that every violation shows; checked after every tick."""
    b = Bench(shipped("pcb-drill")).ready()
    break_it()
    disturb(b)
    b.ticker.run(2_000, Invariants(b.m))


@pytest.mark.parametrize(("broken", "disturb", "message"), PLANTED)
def test_a_planted_violation_is_found(
    broken: Break, disturb: Disturb, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_checked(disturb)
    with pytest.raises(AssertionError, match=message):
        run_checked(disturb, lambda: broken(monkeypatch))
