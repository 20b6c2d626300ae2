"""Initialisation: the machine's homing table, row by row (docs/SPEC.md 1.11). Also the way home after a fault.

Rule: by the sensors, never by counters; the next row starts when all axes of the last one rest. A row is judged when it
ends: where its sensors don't say what it wanted, the homing ends with a fault.
"""

from collections.abc import Callable, Mapping

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.tool_change import leave_step, whole_strokes
from drillctl.kmd import Fault
from drillctl.machine import HomingStep, Way

TOWARDS = {"min": -1, "max": 1}
GOES_ON = -1  # instead of a fault code: it has not ended yet


def begin_homing(m: Controller) -> None:
    """The first row starts; the position is unknown until the last has ended."""
    m.position_known = False
    m.homing_row = 0
    m.surfaces.clear()
    m.step = 0
    leave_step(m)
    whole_strokes(m)
    m.homing_fault = _start_row(m)


def carry_homing(m: Controller) -> int:
    """Nothing moves: judges the row that ends here and starts the next.

    Returns Fault.NONE when the table is through, GOES_ON before, or the fault with which it ended.
    """
    while m.homing_row < len(m.machine.homing):
        row = m.machine.homing[m.homing_row]
        fault = m.homing_fault or _ENDED[row.do](m, row)
        if fault:
            return fault
        m.homing_row += 1
        m.homing_fault = _start_row(m)
        if any(axis.counting for axis in m.axes):
            return GOES_ON
    for axis in m.axes:
        axis.base = 0
    return Fault.NONE


def _start_row(m: Controller) -> int:
    """Starts the current row, if there is one. Returns the fault of one that can't begin; nothing moves then."""
    if m.homing_row == len(m.machine.homing):
        return Fault.NONE
    row = m.machine.homing[m.homing_row]
    if row.do == "index" and m.sensors & sum(m.indexes[index] for index in row.axes):
        return Fault.HOMING_EARLY_INDEX
    for index, way in zip(row.axes, m.homing_ways[m.homing_row], strict=True):
        axis = m.axes[index]
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        _STARTED[row.do](m, index, TOWARDS[row.end], way)
    return Fault.NONE


def _seek(m: Controller, index: int, towards: int, way: Way) -> None:
    """To the sensor, at most a tenth beyond the range; the edge brakes (guard)."""
    axis = m.axes[index]
    if not m.sensors & axis.limits[towards]:
        axis.seek_mask = axis.limits[towards]
        axis.set_target(axis.position + towards * (axis.span + axis.span // 10), way.interval)


def _go_on(m: Controller, index: int, towards: int, way: Way) -> None:
    """Slowly on to the sensor, where braking has not ended on it; the first step with the sensor on halts (guard)."""
    axis = m.axes[index]
    if not m.sensors & axis.limits[towards]:
        axis.halt_mask = axis.limits[towards]
        _creep(axis, towards, way)


def _leave(m: Controller, index: int, towards: int, way: Way) -> None:
    """Slowly off the sensor; the first step with the sensor clear halts (guard)."""
    axis = m.axes[index]
    if m.sensors & axis.limits[towards]:
        axis.clear_mask = axis.limits[towards]
        _creep(axis, -towards, way)


def _to_index(m: Controller, index: int, towards: int, way: Way) -> None:
    """Slowly on, away from the end; the first step with the encoder's index on halts (guard)."""
    axis = m.axes[index]
    axis.halt_mask = m.indexes[index]
    _creep(axis, -towards, way)


def _move_off(m: Controller, index: int, towards: int, way: Way) -> None:
    """Slowly on by all its steps: away from the end, or back where they are negative."""
    _creep(m.axes[index], -towards, way)


def _stay(m: Controller, index: int, towards: int, way: Way) -> None:
    """Nothing moves in this row."""


def _creep(axis: Axis, direction: int, way: Way) -> None:
    """At most the row's steps, the ramp capped at state 1: from there an axis stops dead without losing steps."""
    steps = direction * way.limit_steps
    axis.set_target(axis.position + steps, max(way.interval, axis.interval[1 if steps > 0 else -1]))


def _on_sensors(m: Controller, row: HomingStep) -> list[bool]:
    """Whether the sensor of each axis is on."""
    return [bool(m.sensors & m.axes[index].limits[TOWARDS[row.end]]) for index in row.axes]


def _reached(m: Controller, row: HomingStep) -> int:
    return Fault.NONE if all(_on_sensors(m, row)) else _MISSING[row.do]


def _left(m: Controller, row: HomingStep) -> int:
    return _STUCK[row.do] if any(_on_sensors(m, row)) else Fault.NONE


def _left_at_zero(m: Controller, row: HomingStep) -> int:
    return _left(m, row) or _zeroed(m, row)


def _found(m: Controller, row: HomingStep) -> int:
    """The sensor of each axis has answered; an axis that braked may have left it again."""
    return Fault.HOMING_NO_SWITCH if any(m.axes[index].seek_mask for index in row.axes) else Fault.NONE


def _at_index(m: Controller, row: HomingStep) -> int:
    """The index of each axis has come; a rotor that swings may have left it again."""
    missing = any(m.axes[index].halt_mask for index in row.axes)
    return Fault.HOMING_NO_INDEX if missing else _zeroed(m, row)


def _zeroed(m: Controller, row: HomingStep) -> int:
    for index in row.axes:
        m.axes[index].zero()
    return Fault.NONE


_MISSING = {"raise": Fault.HEAD_NOT_UP, "seek": Fault.HOMING_NOT_FOUND, "slow": Fault.HOMING_OFF_SWITCH}
_STUCK = {"release": Fault.HOMING_NOT_FOUND, "creep": Fault.HOMING_NOT_FOUND, "back": Fault.HOMING_ON_SWITCH}
_STARTED: Mapping[str, Callable[[Controller, int, int, Way], None]] = {
    "raise": _seek,
    "seek": _seek,
    "fast": _seek,
    "slow": _go_on,
    "release": _leave,
    "creep": _leave,
    "back": _leave,
    "index": _to_index,
    "offset": _move_off,
    "zero": _stay,
}
_ENDED: Mapping[str, Callable[[Controller, HomingStep], int]] = {
    "raise": _reached,
    "seek": _reached,
    "fast": _found,
    "slow": _reached,
    "release": _left,
    "creep": _left_at_zero,
    "back": _left,
    "index": _at_index,
    "offset": _zeroed,
    "zero": _zeroed,
}
