"""What a gap in time does to a machine: a tick that begins whole periods late is never made up for.

Rule: the gap is a stimulus (docs/SPEC.md 1.14): from the same gaps a replay makes the same image. Called by tick.
"""

from drillctl.execution.controller import Controller
from drillctl.execution.stops import hold, raise_fault, too_fast_to_stop
from drillctl.kmd import Fault

HOLD_MS = 50
FAULT_MS = 250


def apply_gap(m: Controller) -> None:
    """The gap before this tick: every axis that it stopped starts anew; a long one holds, a longer one is a fault."""
    gap_ticks, m.gap = m.late, 0
    stopped = [axis for axis in m.axes if (axis.counting or axis.led) and gap_ticks > axis.interval[0]]
    m.caught = any(too_fast_to_stop(m, axis) for axis in stopped)
    for axis in stopped:
        axis.start_again()
    gap_ms = gap_ticks * 1000 // m.tick_hz
    if gap_ms > FAULT_MS and (m.busy or m.moving):
        m.position_known = m.position_known and not m.caught
        raise_fault(m, Fault.LATE_TICK)
    elif gap_ms > HOLD_MS:
        hold(m)
