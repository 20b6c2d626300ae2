"""What was switched on by hand and would burn a winding is on for a second: 24 V at rest, both halves of a winding.

Rule: counted in ticks, so a trace has it and replays; whoever paces counts ticks while it lasts, though nothing moves.
A column that a phase table puts out is never touched.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller

LIMIT_S = 1


def output_set(m: Controller) -> None:
    """An output was set by hand: the time begins with the first one that is dangerous, and ends with the last."""
    m.cut_off = 0
    hot = any(_hot(axis) for axis in m.axes)
    m.hot_until = (m.hot_until or m.tick + LIMIT_S * m.tick_hz) if hot else 0


def rate_set(m: Controller, before_hz: int) -> None:
    """What is left of the second stays so long."""
    if m.hot_until:
        m.hot_until = m.tick + max(1, (m.hot_until - m.tick) * m.tick_hz // before_hz)


def cut_off(m: Controller) -> None:
    """The second is over: what the axes' tables don't have goes off, where it was dangerous."""
    m.hot_until = 0
    for axis in m.axes:
        hot = _hot(axis)
        if hot:
            m.cut_off = 1
            axis.set_wire(hot, 0)


def _hot(axis: Axis) -> int:
    """The bits that were added by hand to what the axis holds, and would burn it. An axis that moves has none."""
    table = axis.hold_patterns[axis.direction * axis.direction_sign]
    added = axis.hold_bits & ~table[axis.column]
    hot = added & axis.forcing
    for pair in axis.halves:
        if axis.hold_bits & pair == pair:
            hot |= added & pair
    return hot
