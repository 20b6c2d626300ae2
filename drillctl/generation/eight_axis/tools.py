"""Which tool of a machine makes which holes: by diameter, within the deviation that is allowed, as long as it lives.

Rule: the tool of the file's own number comes first where its diameter fits, then the nearest; when its hits are used
up, a tool of the same diameter goes on, and when there is none, an operator is asked to put a new bit in.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from drillctl.generation.eight_axis.magazine import Magazine, place_of
from drillctl.generation.errors import JobError
from drillctl.generation.worklist import Group
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.parameters import ParameterRow

EXACT_MM = 1e-9


@dataclass(frozen=True)
class Stretch:
    """Holes ``start`` to ``stop`` of the work list, made by one bit. ``tool`` is None where the machine has no tool of
    the diameter; ``renewed``: an operator puts a new bit in first.
    """

    start: int
    stop: int
    tool: int | None
    renewed: bool = False


def is_automatic(machine: Machine) -> bool:
    """Returns whether the machine changes its tools itself."""
    parameters = machine.parameters
    wanted = parameters is not None and parameters.value("machining", "tool_change") == "AUTOMATIC"
    return wanted and machine.tool_changer is not None


def stretches(group: Group, machine: Machine, spindles: tuple[int, ...], magazine: Magazine) -> Iterator[Stretch]:
    """Yields what makes the holes of a group, in order. Raises JobError where an automatic change has no tool."""
    fitting = [int(row.number("number") or 0) for row in _fitting(group, machine)]
    automatic = is_automatic(machine)
    if automatic:
        fitting = [tool for tool in fitting if _at_hand(machine, tool, spindles, magazine)]
    if not fitting:
        if automatic:
            raise JobError(_none_fits(group))
        yield Stretch(group.start, group.stop, None)
        return
    at, made = group.start, magazine
    for tool in fitting if automatic else fitting[:1]:
        left = min(group.stop - at, made.hits_left(machine, tool))
        if left:
            yield Stretch(at, at + left, tool)
        at += left
    while at < group.stop:
        life = made.renew(fitting[0]).hits_left(machine, fitting[0])
        stop = min(group.stop, at + life)
        yield Stretch(at, stop, fitting[0], renewed=True)
        at = stop


def speed_of(machine: Machine, tool: int | None, name: str) -> float:
    """Returns a speed of a tool by its parameter's name (feed_mm_min, lift_mm_min, spindle_rev_min), that of the
    machining parameters for a tool that the machine does not have.
    """
    assert machine.parameters is not None
    row = None if tool is None else machine.parameters.tool(tool)
    own = row.number(name) if row is not None else None
    return own if own is not None else machine.parameters.number("machining", name) or 0.0


def _fitting(group: Group, machine: Machine) -> list[ParameterRow]:
    """The tools of the machine that may make a group's holes, the best first."""
    assert machine.parameters is not None
    rows = [row for row in machine.parameters.tools if row.value("kind") == "DRILL" and _fits(row, group)]
    return sorted(rows, key=lambda row: (row.value("number") != group.number, _off_mm(row, group)))


def _fits(row: ParameterRow, group: Group) -> bool:
    """A tool of the file without a diameter is served by the tool of its number."""
    if group.diameter_mm is None:
        return row.value("number") == group.number
    return _off_mm(row, group) <= (row.number("offset_mm") or 0.0) + EXACT_MM


def _off_mm(row: ParameterRow, group: Group) -> float:
    return abs((row.number("diameter_mm") or 0.0) - (group.diameter_mm or 0.0)) if group.diameter_mm else 0.0


def _at_hand(machine: Machine, tool: int, spindles: tuple[int, ...], magazine: Magazine) -> bool:
    """Whether each of the spindles has the tool, or can take it from its place."""
    place = place_of(machine, tool)
    return place > 0 and all(
        magazine.chucks.get(spindle) == tool or magazine.bits.get((place, spindle)) for spindle in spindles
    )


def _none_fits(group: Group) -> Message:
    if group.diameter_mm is None:
        return Message("no tool of the magazine serves tool T{number}, which has no diameter", number=group.number)
    return Message(
        "no tool of the magazine serves tool T{number} ({diameter:.3f} mm)",
        number=group.number,
        diameter=group.diameter_mm,
    )
