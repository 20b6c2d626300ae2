"""The tables that a sweep or a search is to use, by their names; and phase tables broken on purpose.

Rule: an unknown name is refused with the nearest known ones. Everything here raises TableError or LabError.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NoReturn

from drillctl.lab.errors import LabError
from drillctl.language import Message, known_words
from drillctl.machine import AxisTable, Library, Machine
from drillctl.machine.phase import NAME, PhaseTable, Wire, parse_phase
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import read_ramp
from drillctl.machine.source import Source

ALL_BROKEN = "broken"
LONGEST_NAME = 40
DIRECT_START = "direct-start"


def axis_index(machine: Machine, name: str) -> int:
    """The index of the axis of this name. Raises LabError."""
    index = machine.axis_index(name)
    if index is None:
        raise LabError(
            Message(
                "{name} has no axis {name2!r}; {words}",
                name=machine.name,
                name2=name,
                words=known_words(name, machine.axis_names),
            )
        )
    return index


def axis_of(machine: Machine, name: str | None) -> AxisTable:
    """The axis of this name; for None the first."""
    return machine.axes[axis_index(machine, name) if name else 0]


def ramps(names: str | None, axis: AxisTable, library: Library) -> tuple[RampTable, ...]:
    """Ramps by names separated by commas: of the library, or ``direct-start`` (no ramp); for None the axis's own."""
    if names is None:
        return (axis.ramp,)
    return tuple(_ramp(name, axis, library) for name in _listed(names))


def phases(names: str | None, axis: AxisTable, library: Library) -> tuple[tuple[str, PhaseTable], ...]:
    """Phase tables with their names: of the library, or names of BROKEN, the axis's own with a defect; for None the
    axis's own.
    """
    if names is None:
        return ((axis.phase.name, axis.phase),)
    wanted = [each for name in _listed(names) for each in (BROKEN if name == ALL_BROKEN else (name,))]
    return tuple((name, _phase(name, axis, library)) for name in wanted)


def check_name(name: str) -> str:
    """Returns a name for a new table. Raises LabError for one that a table can't have."""
    if not NAME.fullmatch(name) or len(name) > LONGEST_NAME:
        raise LabError(
            Message(
                "{name!r} can't name a table: letters, digits, - and _, {longest_name} at most",
                name=name[:60],
                longest_name=LONGEST_NAME,
            )
        )
    return name


def _ramp(name: str, axis: AxisTable, library: Library) -> RampTable:
    if name == DIRECT_START:
        return replace(direct_start(axis.ramp), name=name)
    known = [*library.names("ramp"), DIRECT_START]
    return read_ramp(library.find("ramp", name) or _unknown("ramp", name, known))


def _phase(name: str, axis: AxisTable, library: Library) -> PhaseTable:
    if name in BROKEN:
        return BROKEN[name](axis.phase)
    known = [*library.names("phase"), *BROKEN]
    return parse_phase(Source.read(library.find("phase", name) or _unknown(Message("phase table"), name, known)))


def _unknown(kind: str, name: str, known: list[str]) -> NoReturn:
    raise LabError(
        Message("no {kind} is named {name!r}; {others}", kind=kind, name=name[:60], others=known_words(name, known))
    )


def _listed(names: str) -> list[str]:
    """The names of a list separated by commas. Raises LabError for one that comes twice."""
    found = [name.strip() for name in names.split(",")]
    if len(found) > len(set(found)):
        raise LabError(Message("{names!r} has a name twice", names=names[:80]))
    return found


Breaking = Callable[[PhaseTable], PhaseTable]


def direct_start(ramp: RampTable) -> RampTable:
    """A ramp that is none: every state as fast as the fastest."""
    return replace(ramp, interval=(min(ramp.interval),) * len(ramp.interval))


def reordered(table: PhaseTable, order: Sequence[int]) -> PhaseTable:
    """The table with its columns in another order, counted from 1."""
    return _with(table, lambda wire: [wire.forward[column - 1] for column in order])


def without(table: PhaseTable, *names: str) -> PhaseTable:
    """The table with these wires never on."""
    return _with(table, lambda wire: [on and wire.name not in names for on in wire.forward])


def wave(table: PhaseTable) -> PhaseTable:
    """A table of twelve columns: one half winding at a time, three columns each, without forcing."""
    first = {"1a": 1, "2b": 4, "1b": 7, "2a": 10}
    return _with(table, lambda wire: [wire.name in first and 0 <= c - first[wire.name] < 3 for c in range(1, 13)])


def _with(table: PhaseTable, row: Callable[[Wire], Sequence[bool]]) -> PhaseTable:
    """The same wires with other rows, played backwards for the other direction."""
    wires = tuple(replace(wire, forward=tuple(row(wire)), backward=tuple(row(wire))) for wire in table.wires)
    return replace(table, wires=wires)


BROKEN: dict[str, Breaking] = {
    "forcing removed": lambda table: without(table, "24a", "24b"),
    "forcing of one phase": lambda table: without(table, "24b"),
    "columns 1 and 2 exchanged": lambda table: reordered(table, (2, 1, *range(3, 13))),
    "columns 3 and 4 exchanged": lambda table: reordered(table, (1, 2, 4, 3, *range(5, 13))),
    "columns 4 and 7 exchanged": lambda table: reordered(table, (1, 2, 3, 7, 5, 6, 4, *range(8, 13))),
    "columns 4-6 and 7-9 exchanged": lambda table: reordered(table, (1, 2, 3, 7, 8, 9, 4, 5, 6, 10, 11, 12)),
    "reversed": lambda table: reordered(table, range(12, 0, -1)),
    "one phase alone": lambda table: without(table, "2a", "2b", "24b"),
    "2b never on": lambda table: without(table, "2b"),
    "one winding at a time": wave,
}
