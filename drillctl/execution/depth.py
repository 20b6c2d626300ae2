"""Depth detection: where the bits touch their boards, and which of them are broken.

Rule: KMD_DOTYK finds the surface by head: the heads go slowly down until their bits touch. From then on a bit that
touches deeper than the breakage range is broken, and so is one that does not touch at the end of a stroke down. A
homing of the machine forgets the surfaces.
"""

from collections.abc import Sequence

from drillctl.execution.controller import NO_LIMIT, Controller
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
    m.blamed = sum(1 << index for index in heads if m.sensors & m.contacts[index])
    if m.blamed:
        return Fault.NO_CONTACT  # a contact that is always on finds nothing
    for index in heads:
        axis = m.axes[index]
        axis.seek_mask, axis.clear_mask, axis.halt_mask = 0, 0, m.contacts[index]
        lowest = min(axis.reach[1], m.descents[index])
        floor = max(command.floor_ticks, command.args[index], axis.interval[1])
        axis.set_target(max(lowest, axis.position), floor)
    return Fault.NONE


def touched(m: Controller, command: Command) -> int:
    """Ends it at rest: notes where each bit has touched. Returns a fault code."""
    heads = _heads(m, command)
    missed = [index for index in heads if m.axes[index].halt_mask]
    for index in missed:
        m.axes[index].halt_mask = 0
        m.blamed |= 1 << index
    if missed:
        return Fault.NO_CONTACT
    found = [(index, m.axes[index].position) for index in heads]
    for index, place in found:
        if place > m.surfaces.get(index, place) + m.breakage_ranges[index]:
            m.blamed |= 1 << index
    if m.blamed:
        return Fault.BIT_BROKEN
    m.surfaces.update(found)
    return Fault.NONE


def watch_touches(m: Controller, heads: Sequence[int]) -> int:
    """At the beginning of a stroke down: looks from now on when the bits of these heads, by axis, touch. A head whose
    surface is not known, or that has no breakage range, is left out. Returns a fault code: a contact is on above its
    board.
    """
    m.watched = 0
    for index in heads:
        if index in m.surfaces and m.breakage_ranges[index] != NO_LIMIT:
            m.watched |= m.contacts[index]
            if m.sensors & m.contacts[index] and m.axes[index].position < m.surfaces[index]:
                m.blamed |= 1 << index
    m.touching = m.sensors & m.watched
    m.touched.clear()
    return Fault.NO_CONTACT if m.blamed else Fault.NONE


def note_touches(m: Controller) -> None:
    """A bit has begun or ceased to touch: notes where it did first."""
    came, m.touching = m.sensors & m.watched & ~m.touching, m.sensors & m.watched
    for index in m.machine.drill_axes:
        if m.contacts[index] & came:
            axis = m.axes[index]
            m.touched.setdefault(index, axis.position + (axis.column_in_step > 0))  # the step that it is on


def all_whole(m: Controller) -> bool:
    """At the end of a stroke down: whether each bit that was watched touches its board, and did so in its range."""
    watched, m.watched = m.watched, 0
    for index in m.machine.drill_axes:
        if watched & m.contacts[index]:
            deepest = m.surfaces[index] + m.breakage_ranges[index]
            if not m.sensors & m.contacts[index] or m.touched.get(index, deepest) > deepest:
                m.blamed |= 1 << index
    return not m.blamed


def _heads(m: Controller, command: Command) -> list[int]:
    heads = m.machine.drill_axes
    return [index for index in heads if command.axes >> index & 1] if command.axes else list(heads)
