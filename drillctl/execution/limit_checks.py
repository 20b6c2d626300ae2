"""What can stop a machine: latched sensors, tracked positions and times, looked at before anything moves in a tick.

Rule: sensors and ranges are watched independently, so that one of them broken leaves the other (paper, section 3).

Several end sensors may share one input line. Which of them answers is known from the motion in which the line came on:
that axis may then move the other way only. The others may move, watched by their ranges. A line that came on while
nothing moved tells no end, and nothing may move.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.conditions import raise_fault, serve_inputs
from drillctl.execution.controller import Controller
from drillctl.execution.depth import note_touches
from drillctl.execution.motion import SETTLING, STOPPING
from drillctl.execution.spindle import speed_is_lost
from drillctl.kmd import Fault


def guard(m: Controller) -> None:
    """Checks everything that can stop the machine; at most one fault a tick is raised."""
    sensors = m.sensors
    if m.action_mask and (sensors & m.action_mask or m.estops) and serve_inputs(m):
        return
    if (sensors & m.alarm_mask) != m.alarms and _drive_trips(m, sensors & m.alarm_mask):
        return
    if m.watched and sensors & m.watched != m.touching:
        note_touches(m)
    if m.shared:
        _note_ends(m, sensors & m.shared)
    for pair in m.pairs:
        if sensors & pair == pair:
            raise_fault(m, Fault.SENSOR_CONTRADICTION)
            return
    for index, axis in enumerate(m.axes):
        if axis.motion > SETTLING:
            fault = _watch(m, axis, sensors)
            if fault and axis.motion != STOPPING:  # it is being stopped already
                m.blamed = 1 << index
                raise_fault(m, fault)
                return
    if m.time_limit and m.elapsed >= m.time_limit:
        m.time_limit = 0
        raise_fault(m, m.step_fault or Fault.DRILLING_TIME)
        return
    if m.speed_reached and m.spindle is not None and speed_is_lost(m):
        m.speed_reached = m.dip_ticks = 0
        raise_fault(m, Fault.SPINDLE_LOST)


def _drive_trips(m: Controller, alarms: int) -> bool:
    """Notes which drives say that they have tripped; returns whether one of them is new, which is a fault."""
    new = alarms & ~m.alarms
    m.alarms = alarms
    if new:
        m.blamed = sum(1 << index for index, bit in enumerate(m.alarm_bits) if bit & new)
        raise_fault(m, Fault.DRIVE_ALARM)
    return new > 0


def _watch(m: Controller, axis: Axis, sensors: int) -> int:
    """Checks a moving axis: the sensor that it seeks or leaves, a limit ahead, the range. Returns a fault code. A mask
    whose sensor has answered is 0 from then on.
    """
    if sensors & axis.seek_mask:
        axis.seek_mask = 0
        axis.ramp_down()
    elif sensors & axis.halt_mask:
        if axis.column_in_step == 0:
            axis.halt_mask = 0
            axis.stop_now()
    elif axis.clear_mask:
        if axis.column_in_step == 0 and not sensors & axis.clear_mask:
            axis.stop_now()
    elif sensors & axis.limits[axis.direction] & ~axis.seek_mask and not _leads_away(m, axis):
        return Fault.LIMIT
    elif m.position_known and not axis.low <= axis.position <= axis.high:
        return Fault.RANGE
    return Fault.NONE


def _note_ends(m: Controller, on: int) -> None:
    """Notes for each axis that moves in which direction it was going when a line came on; forgets that once it moves
    with the line off.
    """
    came = on & ~m.shared_on
    m.shared_on = on
    for axis in m.axes:
        if axis.motion > SETTLING:
            if axis.limits[axis.direction] & came:
                axis.met = axis.direction
            elif not (axis.limits[1] | axis.limits[-1]) & on:
                axis.met = 0


def _leads_away(m: Controller, axis: Axis) -> bool:
    """Whether an axis may move although the line that answers at this end of it is on: another end answers there."""
    line = axis.limits[axis.direction] & m.shared
    if axis.met == axis.direction:
        return False
    return any(other.met and other.limits[other.met] & line for other in m.axes)
