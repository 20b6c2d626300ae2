"""KMD_POWROT: back to machine zero by the count of steps, the heads first, then all other axes (docs/SPEC.md, 1.25).

Rule: the next row of axes starts when those of the last one rest. Zero is as near as an axis's limit sensor allows.
"""

from drillctl.execution.controller import Controller
from drillctl.execution.homing import GOES_ON
from drillctl.kmd import Command, Fault


def begin_return(m: Controller, command: Command) -> int:
    """Sends the heads back. Returns a fault code."""
    if not m.position_known:
        return Fault.HOMING_REQUIRED
    m.return_row = 0
    _send(m, command)
    return Fault.NONE


def carry_return(m: Controller, command: Command) -> int:
    """The heads are there: sends the other axes back. Returns Fault.NONE when these are there too, else GOES_ON."""
    while m.return_row + 1 < len(m.return_rows):
        m.return_row += 1
        if _send(m, command):
            return GOES_ON
    m.zero_first = False
    return Fault.NONE


def _send(m: Controller, command: Command) -> bool:
    """Sends the axes of the current row back; True where one of them is elsewhere."""
    moving = False
    for axis in m.return_rows[m.return_row]:
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        axis.set_target(axis.top, max(command.floor_ticks, m.machine.return_interval))
        moving = moving or axis.counting
    return moving
