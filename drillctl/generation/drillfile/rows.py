"""The growing list of holes and slots. Rule: never more than HOLE_LIMIT rows, however they are asked for.

A row is one hole or slot, its two ends as number triples (numbers.py); a hole's ends are the same.
R and M25..M02 copy rows with an offset, so they need no format either. machine.py fills it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .errors import Complaint
from .model import Floats

HOLE_LIMIT = 200_000

# at: (end, axis, reading); mm: millimetres per unit in force there, 0 where none was declared yet.
ROW = np.dtype([("at", "f8", (2, 2, 3)), ("mm", "f8"), ("tool", "i8"), ("line", "i8"), ("slot", "?")], align=True)
RowArray = NDArray[np.void]


class Rows:
    """Holes and slots in file order, with the pattern that may be open."""

    def __init__(self) -> None:
        self._blocks: list[RowArray] = []
        self._count = 0
        self._pattern_start: int | None = None
        self._must_end = True
        self._ended_copies = False
        self._pattern: RowArray | None = None

    def __len__(self) -> int:
        return self._count

    def array(self) -> RowArray:
        """All rows as one array (n,) of ROW."""
        if len(self._blocks) != 1:
            self._blocks = [np.concatenate([np.empty(0, ROW), *self._blocks])]
        return self._blocks[0]

    def append(self, block: RowArray) -> None:
        """Add rows; whoever makes them has asked check_room before."""
        self._blocks.append(block)
        self._count += len(block)

    def check_room(self, wanted: int, code: str = "too-many-holes") -> None:
        """Fatal Complaint before memory is spent on more rows than HOLE_LIMIT."""
        if self._count + wanted > HOLE_LIMIT:
            raise Complaint(code, f"more than {HOLE_LIMIT} holes", fatal=True)

    def repeat(self, count: int, offset: Floats, line: int) -> Floats:
        """R: the last row, which there must be, again count times, each one offset (2, 3) further; where it ended."""
        return self._copy(self._blocks[-1][-1:], count, offset, line)

    def last_tool(self) -> int:
        """The tool of the last row. Complaint 'repeat-without-hole' for none."""
        if not self._count:
            raise Complaint("repeat-without-hole")
        return int(self._blocks[-1][-1]["tool"])

    @property
    def in_pattern(self) -> bool:
        """Whether step and repeat has begun and not ended."""
        return self._pattern_start is not None and (self._must_end or self._pattern is not None)

    def begin_pattern(self, *, must_end: bool = True) -> None:
        """M25: what follows is a pattern. A % in the body may begin one, or be nothing: must_end says which."""
        if self.in_pattern and self._pattern is None:
            raise Complaint("bad-pattern", "M25 inside M25")
        self._pattern_start, self._pattern, self._must_end = self._count, None, must_end

    def end_pattern(self) -> None:
        """M01: all since M25 is the pattern, copies of an inner one too. Without M25 it is a stop for the operator."""
        if self._pattern_start is not None:
            self._pattern = self.array()[self._pattern_start :].copy()
            self._ended_copies = False

    def end_copies(self) -> None:
        """M02 without a distance: no more copies until M01 ends a larger pattern."""
        self._ended_copies = True

    def repeat_pattern(self, count: int, offset: Floats, line: int) -> None:
        """M02: the pattern again, offset (2, 3) further than it was last drilled; count times."""
        if self._pattern_start is None:
            raise Complaint("pattern-without-start")
        if self._pattern is None or self._ended_copies:
            raise Complaint("bad-pattern", "M02 before M01")
        if len(self._pattern):
            self._copy(self._pattern, count, offset, line)
            self._pattern["at"] += count * offset

    def _copy(self, some: RowArray, count: int, offset: Floats, line: int) -> Floats:
        """Append rows count times, each time one offset further; returns the place of the last."""
        self.check_room(count * len(some), "repeat-too-large")
        block = np.tile(some, count)
        times = np.repeat(np.arange(1, count + 1), len(some))
        block["at"] += times[:, None, None, None] * offset
        block["line"] = line
        self.append(block)
        return np.array(block["at"][-1, 1])

    def close_pattern(self) -> None:
        """M08 or the end of the program."""
        if self.in_pattern and self._pattern is None:
            raise Complaint("bad-pattern", "M25 without M01")
        self._pattern_start = self._pattern = None
