"""One axis without a machine: the automaton as it runs, step by step. Used by the axis tests."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from drillctl.execution.axis import Axis
from drillctl.machine import AxisTable, shipped_tables
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import read_ramp
from tests.support.bench import even_ramp, shipped

RAMPS: dict[str, RampTable] = {  # the shipped ones of a few states, and computed ones
    **{name: read_ramp(shipped_tables() / "ramp" / f"{name}.toml") for name in ("drive-servo", "seven-state")},
    "even-steps": even_ramp(),
    "whole-strokes": even_ramp('short_strokes = "whole"\n'),
}
LONGEST_WAIT_TICKS = 2_000


@dataclass(frozen=True)
class Step:
    """One step as seen from outside: ticks since the one before, the states it was made in and left behind."""

    ticks: int
    state: int
    after: int
    direction: int


def axis_table(ramp: str, columns_per_step: int = 1, invert: bool = False) -> AxisTable:
    """The paper's X axis with another ramp."""
    x = shipped("pcb-drill").axes[0]
    return replace(x, ramp=RAMPS[ramp], columns_per_step=columns_per_step, invert=invert)


def lone_axis(ramp: str, columns_per_step: int = 1, invert: bool = False) -> Axis:
    """An axis at rest at 0, without sensors."""
    return Axis(axis_table(ramp, columns_per_step, invert), (0, 0, 0))


def next_step(axis: Axis) -> Step:
    """Counts until one step is made. The axis must be counting."""
    state, position = axis.state, axis.position
    for ticks in range(1, LONGEST_WAIT_TICKS):
        axis.interrupt()
        if axis.position != position:
            return Step(ticks, state, axis.state, axis.position - position)
    raise AssertionError(f"no step within {LONGEST_WAIT_TICKS} ticks of state {state}")


def steps_to_rest(axis: Axis) -> Iterator[Step]:
    """All steps until the axis rests."""
    while axis.counting:
        yield next_step(axis)
