"""Stretches of ticks in the middle of a command, whose outputs are known unless an input changes.

An axis that neither speeds up nor brakes puts out its phase table's columns at one interval, until it must brake; one
at rest keeps its image. So as long as the inputs stay as they are, nothing is decided.

Rule: tick is the law. ``stretch`` is 0 wherever anything but counting may happen; whoever runs one finds out how many
of its ticks passed before an input changed, and lets ``leave`` make the controller what tick would have made of it.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import BRAKING, MOVING, REST, Axis
from drillctl.execution.controller import Controller, Stage
from drillctl.kmd import Op

SHORTEST, LONGEST = 8, 1 << 16  # ticks: fewer are quicker ticked; more take too much memory at once

Images = NDArray[np.uint64]


def stretch(m: Controller, inputs: int) -> int:
    """Returns how many ticks are known, if the inputs stay what they are now."""
    if m.stage != Stage.RUNNING or not m.busy or m.requests.waiting or inputs != m.inputs:
        return 0
    if m.fault or m.gap or m.late or m.served or m.unseen or m.hot_until:
        return 0
    ticks, counting = LONGEST, 0
    for axis in m.axes:
        if axis.motion == MOVING or axis.motion == BRAKING:
            ticks, counting = min(ticks, _even_ticks(axis, m.position_known)), counting + 1
        elif axis.motion != REST:
            return 0
    if counting != m.moving:
        return 0
    if not counting:
        ticks = min(ticks, m.command.args[0] - m.elapsed - 1 if m.command.opcode == Op.CZEKAJ else 0)
    if m.time_limit:
        ticks = min(ticks, m.time_limit - m.elapsed)
    return ticks if ticks >= SHORTEST else 0


def images(m: Controller, ticks: int) -> Images:
    """Returns the output image of each tick of a stretch, (ticks,)."""
    shown = np.full(ticks, m.switched, np.uint64)
    for axis in m.axes:
        if axis.motion == REST:
            shown |= np.uint64(axis.bits)
            continue
        turn = axis.direction * axis.direction_sign
        columns = np.arange(axis.count + 1, axis.count + ticks + 1) // axis.wait
        pattern = np.array(axis.drive_patterns[turn], np.uint64)
        shown |= np.where(columns, pattern[(axis.column + turn * columns) % axis.length], np.uint64(axis.bits))
    return shown


def leave(m: Controller, ticks: int, image: int) -> None:
    """Makes the controller what it is after so many ticks of a stretch; ``image`` is the last one."""
    m.elapsed += ticks
    m.tick += ticks
    m.image = image
    for axis in m.axes:
        if axis.motion != REST:
            _count_on(axis, ticks)


def _even_ticks(axis: Axis, position_known: bool) -> int:
    """Ticks up to the last step after which its state is the same."""
    state, to_go = axis.state, (axis.target - axis.position) * axis.direction
    steps = to_go - axis.ramp.brake[state]
    if position_known:
        steps = min(steps, axis.high - axis.position if axis.direction > 0 else axis.position - axis.low)
    if not state or steps < 1 or axis.followers is not None or axis.clear_mask:
        return 0
    may_rise = axis.motion == MOVING and axis.interval[state] > axis.min_interval
    if axis.ramp.after_step(state, axis.direction, to_go - 1, may_rise) != state:
        return 0
    return (steps * axis.columns_per_step - axis.column_in_step) * axis.wait - axis.count


def _count_on(axis: Axis, ticks: int) -> None:
    columns, axis.count = divmod(axis.count + ticks, axis.wait)
    steps, axis.column_in_step = divmod(axis.column_in_step + columns, axis.columns_per_step)
    axis.position += axis.direction * steps
    axis.travelled += axis.direction * columns
    axis.made += steps
    if columns:
        turn = axis.direction * axis.direction_sign
        axis.column = (axis.column + turn * columns) % axis.length
        axis.bits, axis.hold_bits = axis.drive_patterns[turn][axis.column], axis.hold_patterns[turn][axis.column]
