"""The drilling heads: how KMD_WIERTLO_DOL and KMD_WIERTLO_GORA start and end (docs/SPEC.md, 1.10).

Rule: a head goes towards its sensor at that end and stops on it; without one it goes to the distance that the machine's
file gives, down to the detected depth where its surface was found. The range's end without the sensor is a fault. A
command's argument of a head is its own least interval.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.depth import all_whole, watch_touches
from drillctl.kmd import Command, Fault, Op

UP, DOWN = -1, 1


def lower_heads(m: Controller, command: Command) -> int:
    """Starts KMD_WIERTLO_DOL, each head to its own target; drilling is limited in time. Returns a fault code."""
    m.hole_begun = command.tag or m.hole_begun
    m.time_limit = m.longest_drilling
    heads = [index for index, axis in enumerate(m.axes) if _is_head(m, command, index, axis)]
    return watch_touches(m, heads) or _drive_head(m, command, DOWN)


def raise_heads(m: Controller, command: Command) -> int:
    """Starts KMD_WIERTLO_GORA. Returns a fault code."""
    return _drive_head(m, command, UP)


def heads_lowered(m: Controller, command: Command) -> int:
    """Ends KMD_WIERTLO_DOL at rest: the hole is made where every head is down, its bit whole. Returns a fault code."""
    if not _at_sensors(m, command, DOWN):
        return Fault.DRILL_NOT_DOWN
    if m.watched and not all_whole(m):
        return Fault.BIT_BROKEN
    m.holes_done += command.tag > 0
    return Fault.NONE


def heads_raised(m: Controller, command: Command) -> int:
    """Ends KMD_WIERTLO_GORA at rest, where every head is up. Returns a fault code."""
    return Fault.NONE if _at_sensors(m, command, UP) else Fault.HEAD_NOT_UP


def drive_to_sensors(m: Controller, command: Command, direction: int) -> int:
    """Sends each head to its sensor at that end, also where its place is known. Returns a fault code."""
    for index, axis in enumerate(m.axes):
        if _is_head(m, command, index, axis):
            sensor = axis.limits[direction] & ~m.shared
            if not sensor:
                return Fault.BAD_COMMAND
            axis.seek_mask, axis.clear_mask, axis.halt_mask = sensor, 0, 0
            if not m.sensors & sensor:
                axis.set_target(_head_target(m, index, direction, sensor), command.floor_ticks)
    return Fault.NONE


def reached_sensors(m: Controller, command: Command, direction: int) -> bool:
    """Ends what ``drive_to_sensors`` began: returns whether every head has reached its sensor."""
    for index, axis in enumerate(m.axes):
        if _is_head(m, command, index, axis):
            axis.seek_mask = 0
            if not m.sensors & axis.limits[direction]:
                m.blamed |= 1 << index
    return not m.blamed


def _drive_head(m: Controller, command: Command, direction: int) -> int:
    """Sends each head to its sensor at that end; without one, to the distance that the machine's file gives."""
    for index, axis in enumerate(m.axes):
        if _is_head(m, command, index, axis):
            sensor = _head_sensor(m, axis, direction)
            if not sensor and not m.position_known:
                return Fault.HOMING_REQUIRED
            axis.seek_mask, axis.clear_mask, axis.halt_mask = sensor, 0, 0
            if not m.sensors & sensor:
                target = _head_target(m, index, direction, sensor)
                axis.set_target(target, max(command.floor_ticks, command.args[index]))
    return Fault.NONE


def _is_head(m: Controller, command: Command, index: int, axis: Axis) -> bool:
    """Whether a command moves an axis as a head: those that it names, else all heads of the machine."""
    named = command.axes & m.head_mask if command.opcode == Op.GORA_X_Y else command.axes
    return bool(named >> index & 1) if named else axis in m.drill_axes


def _head_sensor(m: Controller, axis: Axis, direction: int) -> int:
    """The sensor that ends the way, as an input bit. A head fed by a distance, where that is known, needs none; one
    that shares its line with other ends has none.
    """
    by_distance = m.machine.drill_down_steps is not None and (direction == DOWN or m.position_known)
    return 0 if by_distance else axis.limits[direction] & ~m.shared


def _head_target(m: Controller, index: int, direction: int, sensor: int) -> int:
    axis = m.axes[index]
    if not sensor:
        return _bottom(m, index) if direction == DOWN else axis.up
    if not m.position_known:
        least, most = axis.been()
        return max(most, least + axis.span) if direction == DOWN else min(least, most - axis.span)
    return axis.high if direction == DOWN else axis.low


def _bottom(m: Controller, index: int) -> int:
    """Where a head that is fed by a distance turns back: the detected depth below its surface, where both are known."""
    axis, depth = m.axes[index], m.depths[index]
    if depth and index in m.surfaces:
        return min(m.surfaces[index] + depth, axis.reach[1])
    return m.machine.drill_down_steps or axis.high


def _at_sensors(m: Controller, command: Command, direction: int) -> bool:
    for index, axis in enumerate(m.axes):
        if _is_head(m, command, index, axis):
            sensor = _head_sensor(m, axis, direction)
            axis.seek_mask = 0
            if sensor and not m.sensors & sensor:
                m.blamed |= 1 << index
    return not m.blamed
