"""Which spindles of a machine drill: all of them, or those that ``--spindles`` names, by number from 1.

Rule: spindle n is the n-th axis of the machine file's ``[drill] axes``. All that drill make the same holes.
"""

from drillctl.generation.errors import JobError
from drillctl.language import Message
from drillctl.machine import Machine


def heads_of(machine: Machine, spindles: tuple[int, ...]) -> tuple[int, ...]:
    """Returns the axes of these spindles, in the machine's order; of all where none is named. Raises JobError."""
    if not spindles:
        return machine.drill_axes
    count = len(machine.drill_axes)
    for number in spindles:
        if not 1 <= number <= count:
            fields = {"machine": machine.name, "number": number, "count": count}
            raise JobError(Message("{machine} has no spindle {number}; it has {count}, counted from 1", **fields))
    return tuple(axis for number, axis in enumerate(machine.drill_axes, start=1) if number in spindles)
