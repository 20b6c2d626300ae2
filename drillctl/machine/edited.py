"""A machine with single values changed in memory: of its own file, or of a table that it names.

A place is written as in the files: ``tick_hz``, ``axis.x.ramp``, ``sensor.x_min.edge``, and for a table its kind and
name first: ``phase.two-phase-forced.wire.1a.pattern``, ``ramp.seven-state.state.1.interval``. A row of a list is
called by its name, a row of a ramp by its state.

Rule: the changed texts go through the readers of files; what they would refuse in a file is refused here too.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast

from tomlkit.exceptions import ConvertError

from drillctl.language import Message
from drillctl.machine.config import parse_machine
from drillctl.machine.edit import set_value
from drillctl.machine.errors import TableError
from drillctl.machine.library import Library, tables_beside
from drillctl.machine.model import Machine
from drillctl.machine.parts import Parts
from drillctl.machine.source import Source
from drillctl.machine.source import Value as Single

KINDS = ("phase", "ramp", "motor", "dynamics")  # folders of tables that a machine's file names
Value = Single | Sequence[Single]
Texts = dict[tuple[str, str], Source]  # by kind and name


def edited(library: Library, machine: Machine, changes: Mapping[str, Value]) -> Machine:
    """Returns the machine with these values, by their places. No file is written. Raises TableError for a place that is
    not there, or a value that the table can't have.
    """
    own = Source.read(Path(machine.file))
    parts = _EditedParts(_folders(library, own.file), own.file)
    for place, value in changes.items():
        kind, *inner = place.split(".")
        if kind in KINDS and len(inner) > 1:
            parts.change(kind, inner[0], inner[1:], value)
        else:
            own = _changed(own, [kind, *inner], value)
    return parse_machine(own, False, parts)


class _EditedParts(Parts):
    """The tables of a machine, of which some have changed texts."""

    def __init__(self, folders: Sequence[Path], machine_file: Path):
        super().__init__(folders, machine_file)
        self._changed: Texts = {}

    def change(self, kind: str, name: str, place: Sequence[str], value: Value) -> None:
        """Changes a value of a table. Raises TableError where table or place is not there."""
        found = self._find(kind, name)
        if found is None:
            raise TableError(name, Message("there is no {kind} table of this name", kind=kind))
        self._changed[kind, name] = _changed(found, place, value)

    def _find(self, kind: str, name: str) -> Source | None:
        return self._changed.get((kind, name)) or super()._find(kind, name)


def _folders(library: Library, file: Path) -> tuple[Path, ...]:
    """A machine of the library has its tables there; one given by its file has those beside it first."""
    in_library = any(file.parent == folder / "machines" for folder in library.folders)
    return library.folders if in_library else (tables_beside(file), *library.folders)


def _changed(source: Source, names: Sequence[str], value: Value) -> Source:
    named = ".".join(names)
    try:
        place, there = _place(source.tree(), names)
        if isinstance(there, dict) and there:
            reason = Message("{place} is a table and no value: name one in it", place=named)
        else:
            return Source(source.file, set_value(source.text, place, cast(Single, value)))
    except ConvertError:
        reason = Message("expected {wanted}, got {found}", wanted="a text or a number", found=type(value).__name__)
        reason = reason.at(named)
    except (KeyError, TableError):
        reason = Message("there is no {place} in it", place=named)
    raise TableError(source.file, reason)


def _place(tree: Any, names: Sequence[str]) -> tuple[tuple[str | int, ...], Any]:
    """The place with rows by number, and what is there; {} for what is not. Raises KeyError for a row that is not
    there.
    """
    place: list[str | int] = []
    for name in names:
        if isinstance(tree, list):
            row = _row(tree, name)
            place.append(row)
            tree = tree[row]
        else:
            place.append(name)
            tree = tree.get(name, {}) if isinstance(tree, dict) else {}
    return tuple(place), tree


def _row(rows: list[Any], name: str) -> int:
    for number, row in enumerate(rows):
        if isinstance(row, dict) and name in (row.get("name"), str(row.get("state"))):
            return number
    if name.isdecimal() and int(name) < len(rows):
        return int(name)
    raise KeyError(name)
