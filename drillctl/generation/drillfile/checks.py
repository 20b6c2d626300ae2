"""What can only be judged in millimetres, after the format is settled. Rule: faults refuse, oddities warn.

`reader` calls the checks in its last step.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from .errors import Remark
from .facts import Voice
from .machine import Machine
from .model import Floats, Integers
from .tools import NO_TOOL

FURTHEST_MM = 5_000.0
THINNEST_MM, THICKEST_MM = 0.15, 6.5  # drills that houses have
SAME_SIZE_MM, SAME_SIZE_SHARE = 0.03, 0.03  # how far a report may round a diameter
SHORTEST_SLOT_MM = 1e-6


def faults(machine: Machine, mm_per_unit: float, ends_mm: Floats) -> Iterator[Remark]:
    """Refusals: holes without a tool, with an impossible drill, or far outside any board.

    mm_per_unit: of the chosen units; ends_mm (n, 2, 2): both ends of every row.
    """
    rows = machine.rows.array()
    if machine.tools.entries:
        toolless = rows["line"][rows["tool"] == NO_TOOL]
        yield from (Remark("no-tool-selected", int(line)) for line in toolless[:1])
    used = set(rows["tool"].tolist())
    for index, entry in enumerate(machine.tools.entries):
        if index in used and not entry.usable(mm_per_unit):
            yield Remark("bad-diameter", entry.line, f"T{entry.number} C{entry.diameter}")
    far = rows["line"][(np.abs(ends_mm) > FURTHEST_MM).any(axis=(1, 2))]
    yield from (Remark("coordinate-out-of-range", int(line)) for line in far[:1])


def tool_warnings(machine: Machine, mm_per_unit: float) -> Iterator[Remark]:
    """Tools without a diameter, with a useless one, or with another number of holes than announced."""
    count = np.bincount(machine.rows.array()["tool"] + 1, minlength=len(machine.tools.entries) + 1)[1:]
    if machine.toolless():
        yield Remark("missing-tools")
    units = machine.facts.units
    if (
        units
        and units.voice == Voice.SIDE_FILE
        and any(entry.diameter and not entry.mm for entry in machine.tools.entries)
    ):
        yield Remark("units-from-report", None, f"{units.value}: {units.source}")
    for entry, holes in zip(machine.tools.entries, count.tolist(), strict=True):
        if not holes and not entry.usable(mm_per_unit):
            yield Remark("bad-diameter-unused", entry.line, f"T{entry.number} C{entry.diameter}")
        diameter_mm = entry.diameter_mm(mm_per_unit)
        if holes and diameter_mm and entry.usable(mm_per_unit) and not THINNEST_MM <= diameter_mm <= THICKEST_MM:
            yield Remark("diameter-unlikely", entry.line, f"T{entry.number}: {diameter_mm:g} mm")
        if holes and entry.diameter is None:
            yield Remark("missing-diameter", entry.line, f"T{entry.number}")
        size = machine.facts.sizes.get(entry.number)
        if size and diameter_mm and _differs(diameter_mm, size.diameter * (size.mm or mm_per_unit)):
            text = f"T{entry.number}: {diameter_mm:g} mm, else {size.diameter * (size.mm or mm_per_unit):g} mm"
            yield Remark("size-mismatch", entry.line, text)
        if size and size.count not in (None, holes):
            text = f"T{entry.number}: {size.count} announced, {holes} drilled"
            yield Remark("count-mismatch", entry.line, text)


def hole_warnings(overlapping: Integers, duplicate: Integers, hole_line: Integers) -> Iterator[Remark]:
    """Overlapping and doubled holes, by the line of the later one (indices of holes)."""
    for code, holes in (("overlapping-holes", overlapping), ("duplicate-hole", duplicate)):
        yield from (Remark(code, line) for line in hole_line[holes].tolist())


def slots_without_length(machine: Machine, ends_mm: Floats) -> list[Remark]:
    """Slots (G85) whose ends (n, 2, 2) are one place become holes, each with a warning."""
    rows = machine.rows.array()
    short = rows["slot"] & (np.abs(ends_mm[:, 0] - ends_mm[:, 1]) < SHORTEST_SLOT_MM).all(axis=1)
    rows["slot"][short] = False
    return [Remark("slot-without-length", line) for line in rows["line"][short].tolist()]


def number_warnings(machine: Machine) -> Iterator[Remark]:
    """Numbers with and without a point side by side; nothing drilled at all."""
    if machine.evidence.decimals and (machine.evidence.whole > 0).any():
        yield Remark("mixed-decimal-implied")
    if not len(machine.rows):
        yield Remark("no-holes")


def first_ones(remarks: Iterable[Remark]) -> tuple[Remark, ...]:
    """One remark of each kind: the one of the first line, with how many there are."""
    kinds: dict[str, list[Remark]] = {}
    for remark in remarks:
        kinds.setdefault(remark.code, []).append(remark)
    return tuple(_counted(alike) for alike in kinds.values())


def _counted(alike: list[Remark]) -> Remark:
    first = min(alike, key=lambda remark: (remark.line is None, remark.line))
    return first._replace(alike=len(alike))


def _differs(one_mm: float, other_mm: float) -> bool:
    return abs(one_mm - other_mm) > max(SAME_SIZE_MM, SAME_SIZE_SHARE * one_mm)
