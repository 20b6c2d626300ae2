"""What must hold after every tick, whatever the program and the requests. Used by the property tests of execution.

Create one for a controller and call it after each tick; it remembers the tick before.
"""

from dataclasses import dataclass
from functools import reduce
from operator import or_

from drillctl.execution import Controller
from drillctl.execution.axis import Axis
from drillctl.execution.controller import CONDITIONS, Stage
from drillctl.execution.motion import MOVING, REST, SETTLING


@dataclass(frozen=True)
class Seen:
    """What is remembered of a tick."""

    stage: int
    positions: tuple[int, ...]
    hold_bits: tuple[int, ...]
    motions: tuple[int, ...]
    inside: bool
    kept: tuple[int, ...]  # what only a request changes while latched


class Invariants:
    """Asserts them for one controller whose outputs nobody sets by hand."""

    def __init__(self, m: Controller):
        self._m = m
        self._columns = [_columns(axis) for axis in m.axes]
        self._before = self._seen()

    def __call__(self) -> bool:
        """Checks the tick that has just been made; never wants a run to end."""
        m, before, now = self._m, self._before, self._seen()
        assert (m.condition, m.job) == (CONDITIONS[m.stage], m.stage in (Stage.RUNNING, Stage.HOLDING))
        assert (m.stage >= Stage.FAULT_STOPPING) == bool(m.fault)
        assert m.image == m.switched | reduce(or_, (axis.bits for axis in m.axes)), "the port has another image"
        counting = sum(axis.counting for axis in m.axes)
        begins_row = m.moving == 0 and not m.position_known  # of a homing: its axes count from the next tick on
        assert m.moving == counting or begins_row
        for axis, columns, motion in zip(m.axes, self._columns, before.motions, strict=True):
            self._check_windings(axis, columns, motion)
        if m.position_known and not m.fault:
            assert now.inside or before.inside, "outside its travel for two ticks without a fault"
        assert m.stage != Stage.ZERO_ONLY or (m.zero_first and m.position_known), "bound to a zero that is not known"
        if m.stage == Stage.LATCHED == before.stage:
            assert not m.moving and now.positions == before.positions, "something moves while latched"
            assert now.hold_bits in (before.hold_bits, (0,) * len(m.axes)), "neither held nor dropped"
            assert m.served or (now.kept, now.hold_bits) == (before.kept, before.hold_bits), "a latched machine acts"
        if m.stage <= Stage.ZERO_ONLY:
            assert not m.moving and not m.busy, "something moves outside a job"
        self._before = now
        return False

    def _check_windings(self, axis: Axis, columns: set[int], motion_before: int) -> None:
        assert axis.hold_bits == axis.bits & ~axis.forcing
        column = {pattern[axis.column] for pattern in axis.drive_patterns + axis.hold_patterns if pattern}
        assert axis.bits == 0 or axis.bits in column, "bits that the column of its table does not have"
        if axis.motion == REST:
            assert not axis.bits & axis.forcing, "forcing at rest"
        settled = axis.motion == SETTLING == motion_before
        assert not settled or not axis.bits & axis.forcing, "forcing a tick after it came to rest"
        for pair in axis.halves:
            both = axis.bits & pair == pair
            assert not both or axis.hold_bits in columns, "two halves of a winding that no column of the table has on"
        assert axis.motion >= MOVING or axis.follows or (axis.state, axis.column_in_step) == (0, 0)

    def _seen(self) -> Seen:
        axes = self._m.axes
        inside = all(axis.low <= axis.position <= axis.high for axis in axes)
        positions, hold_bits = tuple(axis.position for axis in axes), tuple(axis.hold_bits for axis in axes)
        m, motions = self._m, tuple(axis.motion for axis in axes)
        kept = (m.fault, m.fault_kept, m.position_known, m.epoch, m.switched)
        return Seen(m.stage, positions, hold_bits, motions, inside, kept)


def _columns(axis: Axis) -> set[int]:
    """The bits of all columns of an axis's table, without forcing."""
    return {bits for pattern in axis.hold_patterns for bits in pattern}
