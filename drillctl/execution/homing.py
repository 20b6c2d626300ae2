"""Initialisation: the machine's homing table, row by row (docs/SPEC.md 1.11). Also the way home after a fault.

Rule: by the sensors, never by counters; the next row starts when all axes of the last one rest. A row is judged when it
ends: where its sensors don't say what it wanted, the homing ends with a fault.
"""

from collections.abc import Callable, Mapping

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.kmd import Fault
from drillctl.machine import HomingStep

TOWARDS = {"min": -1, "max": 1}
GOES_ON = -1  # instead of a fault code: it has not ended yet


def begin_homing(m: Controller) -> None:
    """The first row starts; the position is unknown until the last has ended."""
    m.position_known = False
    m.homing_row = 0
    _start_row(m)


def carry_homing(m: Controller) -> int:
    """Nothing moves: judges the row that ends here and starts the next.

    Returns Fault.NONE when the table is through, GOES_ON before, or the fault with which it ended.
    """
    while m.homing_row < len(m.machine.homing):
        row = m.machine.homing[m.homing_row]
        fault = _ENDED[row.do](m, row)
        if fault:
            return fault
        m.homing_row += 1
        if _start_row(m):
            return GOES_ON
    for axis in m.axes:
        axis.base = 0
    return Fault.NONE


def _start_row(m: Controller) -> bool:
    """Starts the current row, if there is one; True when something moves."""
    if m.homing_row == len(m.machine.homing):
        return False
    row = m.machine.homing[m.homing_row]
    started = _STARTED[row.do]
    moving = False
    for index in row.axes:
        axis = m.axes[index]
        axis.seek_mask = axis.clear_mask = 0
        started(m, axis, TOWARDS[row.end], row.limit_steps)
        moving = moving or axis.counting
    return moving


def _seek(m: Controller, axis: Axis, towards: int, limit: int) -> None:
    """To the sensor, at most a tenth beyond the range; the edge brakes (guard)."""
    if not m.sensors & axis.limits[towards]:
        axis.seek_mask = axis.limits[towards]
        axis.set_target(axis.position + towards * (axis.span + axis.span // 10), 0)


def _leave(m: Controller, axis: Axis, towards: int, limit: int) -> None:
    """Slowly off the sensor, the ramp capped at state 1; the first step with the sensor clear halts (guard)."""
    if m.sensors & axis.limits[towards]:
        axis.clear_mask = axis.limits[towards]
        axis.set_target(axis.position - towards * limit, axis.interval[-towards])


def _stay(m: Controller, axis: Axis, towards: int, limit: int) -> None:
    """Nothing moves in this row."""


def _reached(m: Controller, row: HomingStep) -> int:
    reached = all(m.sensors & m.axes[index].limits[TOWARDS[row.end]] for index in row.axes)
    missing = Fault.HEAD_NOT_UP if row.do == "raise" else Fault.HOMING_NOT_FOUND
    return Fault.NONE if reached else missing


def _left(m: Controller, row: HomingStep) -> int:
    stuck = any(m.sensors & m.axes[index].limits[TOWARDS[row.end]] for index in row.axes)
    return Fault.HOMING_NOT_FOUND if stuck else Fault.NONE


def _left_at_zero(m: Controller, row: HomingStep) -> int:
    return _left(m, row) or _zeroed(m, row)


def _zeroed(m: Controller, row: HomingStep) -> int:
    for index in row.axes:
        m.axes[index].zero()
    return Fault.NONE


_STARTED: Mapping[str, Callable[[Controller, Axis, int, int], None]] = {
    "raise": _seek,
    "seek": _seek,
    "release": _leave,
    "creep": _leave,
    "zero": _stay,
}
_ENDED: Mapping[str, Callable[[Controller, HomingStep], int]] = {
    "raise": _reached,
    "seek": _reached,
    "release": _left,
    "creep": _left_at_zero,
    "zero": _zeroed,
}
