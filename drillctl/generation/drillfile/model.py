"""The records a drill file becomes. Rule: frozen, in millimetres, in the order of the file.

`DrillFile` is the reader's only product; planning, drawing and writing start from it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message

from .errors import Remark

SUPPRESSED = {
    "none": Message("no zeros"),
    "leading": Message("leading zeros"),
    "trailing": Message("trailing zeros"),
}
MM_PER_UNIT = {"inch": 25.4, "mm": 1.0}
# The format's rule for numbers without a point where only the unit is declared: 00.0000 and 000.000 (CNC-7 manual).
DEFAULT_DIGITS = {"inch": (2, 4), "mm": (3, 3)}

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class FormatChoice:
    """How the digits of a coordinate are to be read.

    units: 'inch' or 'mm'. digits: places before and after the implied point, None where the numbers
    carry a decimal point. zeros: which are left out, 'leading', 'trailing', 'none', or None with a point.
    other_digits: places of what is written in the other unit, where the file changes its units.
    score: logarithm of plausibility, comparable within one file only (0 where nothing was compared).
    """

    units: str
    digits: tuple[int, int] | None = None
    zeros: str | None = None
    other_digits: tuple[int, int] | None = None
    dialect: str = "Excellon"
    score: float = 0.0

    @property
    def format(self) -> str:
        """'2:4', or 'decimal' for an explicit point."""
        return "{}:{}".format(*self.digits) if self.digits else "decimal"

    def weights(self) -> Floats:
        """What one unit of a number's three readings is worth, in file units (see numbers.py)."""
        return self._weights(self.digits)

    def lengths_mm(self, at: Floats, mm: Floats) -> Floats:
        """Number triples (n, ..., 3) in millimetres (n, ...); mm (n,): per unit in force there, 0 undeclared."""
        own_mm = MM_PER_UNIT[self.units]
        in_force = np.where(mm > 0, mm, own_mm)
        per_row = in_force.reshape(-1, *[1] * (at.ndim - 2))
        lengths: Floats = (at @ self.weights()) * per_row
        foreign = in_force != own_mm
        if foreign.any() and self.digits and self.other_digits:
            lengths[foreign] = (at[foreign] @ self._weights(self.other_digits)) * per_row[foreign]
        return lengths

    def _weights(self, digits: tuple[int, int] | None) -> Floats:
        if digits is None:  # a whole number among decimal ones stands for itself
            return np.array([1.0, 0.0, 1.0])
        integer, decimal = digits
        if self.zeros == "trailing":
            return np.array([0.0, 10.0**integer, 1.0])
        return np.array([10.0**-decimal, 0.0, 1.0])

    def __str__(self) -> str:
        return self.message

    @property
    def message(self) -> Message:
        """The format in words: ``inch 2:4, trailing zeros suppressed``."""
        if self.digits is None:
            return Message("{units} decimal", units=self.units)
        kept = SUPPRESSED[self.zeros or "none"]
        return Message("{units} {digits}, {zeros} suppressed", units=self.units, digits=self.format, zeros=kept)


@dataclass(frozen=True)
class Tool:
    """A drill of the file; diameter_mm is None where neither the file nor its neighbours tell."""

    number: int
    diameter_mm: float | None


@dataclass(frozen=True, eq=False)
class Cuts:
    """The straight lines (k) of the router's cuts that can be milled, fields as of a file's slots; ``made``: of how
    many cuts they are.
    """

    mm: Floats
    tool: Integers
    line: Integers
    at: Integers
    made: int


@dataclass(frozen=True, eq=False)
class DrillFile:
    """Holes and slots of one file, arrays in file order (n holes, k slots).

    hole_xy_mm (n, 2), hole_tool (n,) index into tools, hole_line (n,) 1-based source line;
    slot_mm (k, 4) from x, y to x, y, slot_tool, slot_line (k,), slot_at (k,) number of holes before it;
    routs: milled cuts, read but not drilled; cuts: those of them that can be milled as slots;
    bbox_mm (x0, y0, x1, y1) of hole centres and slot ends.
    """

    name: str
    tools: tuple[Tool, ...]
    hole_xy_mm: Floats
    hole_tool: Integers
    hole_line: Integers
    slot_mm: Floats
    slot_tool: Integers
    slot_line: Integers
    slot_at: Integers
    routs: int
    format: FormatChoice
    confidence: float
    runner_up: FormatChoice | None
    reason: Message
    warnings: tuple[Remark, ...]
    cuts: Cuts | None = None

    @property
    def bbox_mm(self) -> tuple[float, float, float, float] | None:
        """Extent of hole centres and slot ends, None for a file without either."""
        points = np.concatenate([self.hole_xy_mm, self.slot_mm.reshape(-1, 2)])
        if not len(points):
            return None
        (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        return x0, y0, x1, y1
