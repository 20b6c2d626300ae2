"""The tables that a sweep or a search is asked to use, by name. Raises TableError and LabError. Called by the verbs
and by watched.py.
"""

from dataclasses import replace
from typing import NoReturn

from drillctl.lab.broken import BROKEN, direct_start
from drillctl.lab.errors import LabError
from drillctl.machine import AxisTable, Library, Machine
from drillctl.machine.phase import NAME, PhaseTable, parse_phase
from drillctl.machine.ramp import RampTable, read_ramp
from drillctl.machine.source import Source
from drillctl.wording import known_words

ALL_BROKEN = "broken"
LONGEST_NAME = 40
DIRECT_START = "direct-start"


def axis_index(machine: Machine, name: str) -> int:
    """An axis by its name. Raises LabError."""
    index = machine.axis_index(name)
    if index is None:
        raise LabError(f"{machine.name} has no axis {name!r}; {known_words(name, machine.axis_names)}")
    return index


def axis_of(machine: Machine, name: str | None) -> AxisTable:
    """The axis of this name; None: the first."""
    return machine.axes[axis_index(machine, name) if name else 0]


def ramps(names: str | None, axis: AxisTable, library: Library) -> tuple[RampTable, ...]:
    """The ramps named, apart by commas: of the library, or ``direct-start``, none at all; None: the axis's own."""
    if names is None:
        return (axis.ramp,)
    return tuple(_ramp(name, axis, library) for name in _apart(names))


def phases(names: str | None, axis: AxisTable, library: Library) -> tuple[tuple[str, PhaseTable], ...]:
    """Phase tables with their names: of the library, or the axis's own, broken on purpose (lab/broken.py)."""
    if names is None:
        return ((axis.phase.name, axis.phase),)
    wanted = [each for name in _apart(names) for each in (BROKEN if name == ALL_BROKEN else (name,))]
    return tuple((name, _phase(name, axis, library)) for name in wanted)


def check_name(name: str) -> str:
    """A table's name, as it may stand in a file. Raises LabError."""
    if not NAME.fullmatch(name) or len(name) > LONGEST_NAME:
        raise LabError(f"{name[:60]!r} can't name a table: letters, digits, - and _, {LONGEST_NAME} at most")
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
    return parse_phase(Source.read(library.find("phase", name) or _unknown("phase table", name, known)))


def _unknown(kind: str, name: str, known: list[str]) -> NoReturn:
    raise LabError(f"no {kind} is named {name[:60]!r}; {known_words(name, known)}")


def _apart(names: str) -> list[str]:
    """Raises LabError for one that is named twice."""
    found = [name.strip() for name in names.split(",")]
    if len(found) > len(set(found)):
        raise LabError(f"{names[:80]!r} has a name twice")
    return found
