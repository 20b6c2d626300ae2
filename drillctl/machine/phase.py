"""Phase tables: which wire is on in which column. Drawn in rows of ``x`` and ``.``, as the paper draws them.

Rule: a table is data. A wire above the table's lowest voltage is a forcing wire, and is off at rest.
"""

import re
from dataclasses import dataclass
from typing import Annotated

import msgspec

from drillctl.language import Counted, Message
from drillctl.machine.source import Source

LONGEST_TABLE = 96
Volts = Annotated[float, msgspec.Meta(gt=0, le=60)]
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
Name = Annotated[str, msgspec.Meta(min_length=1, max_length=40, pattern=rf"^{NAME.pattern}\Z")]


class _Row(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    volts: Volts
    pattern: str


class _ReverseRow(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    pattern: str


class _Direction(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    volts: Volts
    forward: str = "x"


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    wire: Annotated[list[_Row], msgspec.Meta(min_length=1, max_length=16)]
    description: str = ""
    direction: _Direction | None = None
    reverse: list[_ReverseRow] = []


@dataclass(frozen=True, slots=True)
class Wire:
    """One row: ``forward[i]`` and ``backward[i]`` say whether the wire is on in column i (from 0), by direction of
    motion.
    """

    name: str
    forcing: bool
    forward: tuple[bool, ...]
    backward: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class PhaseTable:
    """A checked phase table: rows of equal length, ``columns`` long (paper, Table 1: 12)."""

    name: str
    wires: tuple[Wire, ...]
    columns: int

    def wire_names(self) -> tuple[str, ...]:
        """Returns the wires' names in the order of the table's rows, which is the order of bits in a pattern."""
        return tuple(wire.name for wire in self.wires)


def parse_phase(source: Source) -> PhaseTable:
    """Reads and checks a phase table. Raises TableError naming file, row and reason."""
    raw = source.records(_File)
    columns = len(raw.wire[0].pattern)
    if not 2 <= columns <= LONGEST_TABLE:
        reason = Counted(
            "wire {name}: {count} column; a table has 2 to {most}",
            "wire {name}: {count} columns; a table has 2 to {most}",
            columns,
            name=raw.wire[0].name,
            most=LONGEST_TABLE,
        )
        raise source.error(reason, "wire", 0, "pattern")
    backward = _reverse_rows(source, raw, columns)
    normal_volts = min(row.volts for row in raw.wire)
    wires: list[Wire] = []
    for index, row in enumerate(raw.wire):
        if row.name in {wire.name for wire in wires}:
            raise source.error(Message("wire {name}: a second row of this name", name=row.name), "wire", index, "name")
        forward = _bits(source, row.name, row.pattern, columns, "wire", index)
        wires.append(Wire(row.name, row.volts > normal_volts, forward, backward.get(row.name, forward)))
    if raw.direction is not None:
        wires.append(_direction_wire(source, raw.direction, columns, [wire.name for wire in wires]))
    return PhaseTable(raw.name, tuple(wires), columns)


def phase_rows(source: Source) -> list[tuple[str, float, str, str | None]]:
    """Returns name, volts, pattern and own reverse pattern of each wire as written, right or wrong.
    Raises TableError.
    """
    raw = source.records(_File)
    reverse = {row.name: row.pattern for row in raw.reverse}
    return [(row.name, row.volts, row.pattern, reverse.get(row.name)) for row in raw.wire]


def _reverse_rows(source: Source, raw: _File, columns: int) -> dict[str, tuple[bool, ...]]:
    names = {row.name for row in raw.wire}
    rows: dict[str, tuple[bool, ...]] = {}
    for index, row in enumerate(raw.reverse):
        if row.name not in names or row.name in rows:
            reason = Message("reverse {name}: one row for each wire of the table, and no others", name=row.name)
            raise source.error(reason, "reverse", index, "name")
        rows[row.name] = _bits(source, row.name, row.pattern, columns, "reverse", index)
    if rows and rows.keys() != names:
        missing = ", ".join(sorted(names - rows.keys()))
        raise source.error(Message("reverse: no row for {names}", names=missing), "reverse", 0)
    return rows


def _bits(source: Source, name: str, pattern: str, columns: int, key: str, index: int) -> tuple[bool, ...]:
    if strange := pattern.strip("x."):
        reason = Message(
            "{key} {name}: {sign!r} in the pattern; only 'x' (on) and '.' (off)", key=key, name=name, sign=strange[0]
        )
        raise source.error(reason, key, index, "pattern")
    if len(pattern) != columns:
        reason = Counted(
            "{key} {name}: {count} column, the first row has {first}",
            "{key} {name}: {count} columns, the first row has {first}",
            len(pattern),
            key=key,
            name=name,
            first=columns,
        )
        raise source.error(reason, key, index, "pattern")
    return tuple(mark == "x" for mark in pattern)


def _direction_wire(source: Source, row: _Direction, columns: int, taken: list[str]) -> Wire:
    if row.name in taken:
        raise source.error(Message("direction {name}: a row has this name already", name=row.name), "direction", "name")
    if row.forward not in ("x", "."):
        raise source.error(Message("direction {name}: forward is 'x' or '.'", name=row.name), "direction", "forward")
    level = row.forward == "x"
    return Wire(row.name, False, (level,) * columns, (not level,) * columns)
