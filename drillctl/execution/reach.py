"""Whether a command's axes may be sent where it says: asked before anything moves.

Rule: a place needs a known position; a distance from here must stay within the travel, wherever the axis may be.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.kmd import Command, Fault
from drillctl.kmd.commands import Flag


def target_of(axis: Axis, command: Command, index: int) -> int:
    """Returns where a command sends an axis, in steps from machine zero."""
    return command.args[index] + (axis.base if command.flags & Flag.ABSOLUTE else axis.position)


def refused(m: Controller, command: Command, axes: int) -> int:
    """Returns the fault of the first of the axes in the mask ``axes`` that can't be sent where the command says,
    Fault.NONE where all can. Before initialisation only moves from here are allowed, all together within the travel.
    """
    for index, axis in enumerate(m.axes):
        if axes >> index & 1:
            fault = _refused(m, axis, target_of(axis, command, index), command.flags & Flag.ABSOLUTE)
            if fault:
                return fault
    return Fault.NONE


def _refused(m: Controller, axis: Axis, target: int, absolute: int) -> int:
    if m.position_known:
        return Fault.NONE if axis.in_reach(target) else Fault.SOFT_LIMIT
    if absolute:
        return Fault.HOMING_REQUIRED
    return Fault.NONE if axis.within_travel(target) else Fault.SOFT_LIMIT
