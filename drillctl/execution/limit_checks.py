"""What can stop a machine: latched sensors, tracked positions and times, looked at before anything moves in a tick.

Rule: sensors and ranges are watched independently, so that one of them broken leaves the other (paper, section 3).
"""

from drillctl.execution.axis import SETTLING, STOPPING, Axis
from drillctl.execution.conditions import raise_fault
from drillctl.execution.controller import Controller
from drillctl.kmd import Fault


def guard(m: Controller) -> None:
    """Checks everything that can stop the machine; at most one fault a tick is raised."""
    sensors = m.sensors
    for pair in m.pairs:
        if sensors & pair == pair:
            raise_fault(m, Fault.SENSOR_CONTRADICTION)
            return
    for axis in m.axes:
        if SETTLING < axis.motion < STOPPING:
            fault = _watch(m, axis, sensors)
            if fault:
                raise_fault(m, fault)
                return
    if m.time_limit and m.elapsed >= m.time_limit:
        m.time_limit = 0
        raise_fault(m, Fault.DRILLING_TIME)


def _watch(m: Controller, axis: Axis, sensors: int) -> int:
    """Checks a moving axis: the sensor that it seeks or leaves, a limit ahead, the range. Returns a fault code."""
    if axis.seek_mask and sensors & axis.seek_mask:
        axis.ramp_down()
    elif axis.clear_mask:
        if axis.column_in_step == 0 and not sensors & axis.clear_mask:
            axis.stop_now()
    elif sensors & axis.limits[axis.direction] & ~axis.seek_mask:
        return Fault.LIMIT
    elif m.position_known and not axis.low <= axis.position <= axis.high:
        return Fault.RANGE
    return Fault.NONE
