"""KMD_DOTYK: the heads go slowly down until their bits touch the board. Finds the surface by head, and broken bits.

Rule: where a head has touched before, a bit that touches deeper than the breakage range is broken. A homing of the
machine forgets the surfaces.
"""

from drillctl.execution.controller import Controller
from drillctl.kmd import Command, Fault


def lower_to_contact(m: Controller, command: Command) -> int:
    """Starts the heads named, else all, towards their boards: at most the detection descent of their parameters, else
    as far as they reach. The contact of a bit halts its head. Returns a fault code.
    """
    if not m.position_known:
        return Fault.HOMING_REQUIRED
    heads = _heads(m, command)
    if not heads or not all(m.contacts[index] for index in heads):
        return Fault.BAD_COMMAND
    for index in heads:
        axis = m.axes[index]
        axis.seek_mask, axis.clear_mask, axis.halt_mask = 0, 0, m.contacts[index]
        lowest = min(axis.reach[1], m.descents[index])
        axis.set_target(max(lowest, axis.position), max(command.floor_ticks, axis.interval[1]))
    return Fault.NONE


def touched(m: Controller, command: Command) -> int:
    """Ends it at rest: notes where each bit has touched. Returns a fault code."""
    heads = _heads(m, command)
    if any(m.axes[index].halt_mask for index in heads):
        for index in heads:
            m.axes[index].halt_mask = 0
        return Fault.NO_CONTACT
    found = [(index, m.axes[index].position) for index in heads]
    broken = [index for index, place in found if place > m.surfaces.get(index, place) + m.breakage_ranges[index]]
    if broken:
        return Fault.BIT_BROKEN
    m.surfaces.update(found)
    return Fault.NONE


def _heads(m: Controller, command: Command) -> list[int]:
    heads = m.machine.drill_axes
    return [index for index in heads if command.axes >> index & 1] if command.axes else list(heads)
