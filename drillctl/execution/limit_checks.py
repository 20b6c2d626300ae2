"""The guard: latched sensors, tracked positions and times, before anything moves in a tick.

Rule: sensors and ranges are watched independently, so that one of them broken leaves the other (paper, section 3).
Called by tick once a tick; raises faults through stops.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.stops import raise_fault
from drillctl.kmd import Fault


def guard(m: Controller) -> None:
    """Looks once at everything that can stop the machine; at most one fault a tick is raised."""
    sensors = m.sensors
    for pair in m.pairs:
        if sensors & pair == pair:
            raise_fault(m, Fault.SENSOR_CONTRADICTION)
            return
    for axis in m.axes:
        if (axis.counting or axis.follower) and not axis.stopping:
            fault = _watch(m, axis, sensors)
            if fault:
                raise_fault(m, fault)
                return
    if m.time_limit and m.elapsed >= m.time_limit:
        m.time_limit = 0
        raise_fault(m, Fault.DRILLING_TIME)


def _watch(m: Controller, axis: Axis, sensors: int) -> int:
    """A moving axis: the sensor that it seeks or leaves, a limit ahead, the range."""
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
