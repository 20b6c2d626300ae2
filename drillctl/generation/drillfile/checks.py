"""What can only be judged in millimetres, after the format is settled. Rule: faults refuse, oddities warn.

`reader` calls the checks in its last step.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

import numpy as np

from .errors import Remark
from .machine import Machine
from .model import Floats, Integers
from .tools import NO_TOOL

FURTHEST_MM = 5_000.0
NAMED_PER_CODE = 20
DOUBTFUL_SHARE = 0.05  # of overlapping holes, from which on the format itself is doubted


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
    for entry, holes in zip(machine.tools.entries, count.tolist(), strict=True):
        if not holes and not entry.usable(mm_per_unit):
            yield Remark("bad-diameter-unused", entry.line, f"T{entry.number} C{entry.diameter}")
        if holes and entry.diameter is None:
            yield Remark("missing-diameter", entry.line, f"T{entry.number}")
        size = machine.facts.sizes.get(entry.number)
        if size and size.count not in (None, holes):
            text = f"T{entry.number}: {size.count} announced, {holes} drilled"
            yield Remark("count-mismatch", entry.line, text)


def hole_warnings(overlapping: Integers, duplicate: Integers, hole_line: Integers) -> Iterator[Remark]:
    """The first overlapping and doubled holes, by the line of the later one (indices of holes)."""
    for code, holes in (("overlapping-holes", overlapping), ("duplicate-hole", duplicate)):
        text = f"{len(holes)} in all" if len(holes) > 1 else ""
        for line in dict.fromkeys(hole_line[holes[:NAMED_PER_CODE]].tolist()):
            yield Remark(code, line, text)


def number_warnings(machine: Machine) -> Iterator[Remark]:
    """Numbers with and without a point side by side; nothing drilled at all."""
    if machine.evidence.decimals and (machine.evidence.whole > 0).any():
        yield Remark("mixed-decimal-implied")
    if not len(machine.rows):
        yield Remark("no-holes")


def first_ones(remarks: Iterable[Remark]) -> tuple[Remark, ...]:
    """At most NAMED_PER_CODE remarks of each kind: a person reads the first ones, a screen holds no more."""
    named: Counter[str] = Counter()
    kept = []
    for remark in remarks:
        named[remark.code] += 1
        if named[remark.code] <= NAMED_PER_CODE:
            kept.append(remark)
    return tuple(kept)
