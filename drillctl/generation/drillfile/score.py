"""How plausible a number format is for given digits. Rule: every term is the logarithm of a probability,
rough but stated, so terms add and a difference of 3 means twenty to one.

The constants describe drilled boards in general: sizes of boards and drills, distances of holes, drawing
grids, and how often CAD programs write each format. recognise.py adds the terms for each candidate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .layout import Layout, median
from .model import DEFAULT_DIGITS, Floats, FormatChoice, Integers

SAMPLE_HOLES = 600

# How common a format is where nothing is declared (logarithms; the first is the CNC-7 default).
COMMON_DIGITS: dict[str, dict[tuple[int, int], float]] = {
    "inch": {
        (2, 4): 0.0, (2, 3): -2.5, (2, 5): -2.0, (3, 3): -3.0, (3, 5): -3.5, (1, 4): -4.0, (3, 4): -4.0,
        (2, 6): -4.5, (4, 4): -5.0, (2, 2): -5.0,
    },
    "mm": {
        (3, 3): 0.0, (4, 2): -2.0, (3, 2): -2.5, (4, 4): -3.0, (3, 4): -3.0, (4, 3): -3.5, (2, 4): -3.5,
        (3, 5): -4.0, (5, 3): -5.0, (2, 2): -5.0,
    },
}  # fmt: skip
DECIMAL_AMONG_WHOLE = -1.0  # 12 beside 12.7 means 12, unless digits were declared

# Typical value and spread (factor) of lengths in mm: longer side of a board, distance to the next hole, drill.
BOARD_MM, BOARD_SPREAD = 70.0, 2.2
PITCH_MM, PITCH_SPREAD = 2.2, 2.0
DRILL_MM, DRILL_SPREAD = 0.8, 1.9
# A board has a drill below the one, and one above the other.
WIDEST_OF_ALL_MM, FINEST_OF_ALL_MM, ABSURD_DRILLS_WEIGHT = 7.0, 0.15, 6.0
BOARD_DRILLS, BOARD_DRILLS_SPREAD = 50.0, 4.0  # longer side in diameters of the widest drill
FEW_PLACES = 20
USUAL_WEIGHT = 1.5
TAIL = 4.0  # Student's degrees of freedom: how soon an odd value stops being held against a format

GRID_WEIGHT = 1.5
CROWD_WEIGHT = 20.0  # times the square of the share: a third may be an area nibbled out, all is a wrong scale
EAGLE_PLACES = 2.0  # EAGLE writes its drills with as many decimals as its coordinates
MOST_DIGITS = 15  # numbers.py reads no longer ones
DROPPED_WEIGHT = 14.0  # every number that begins (ends) with a zero, times the share of such numbers
TOO_LONG_WEIGHT = 8.0
UNUSED_PLACE_WEIGHT = 0.3
# Numbers whose zeros at the end were dropped begin with 0 up to 10 inch or 100 mm; the others end with 0 on a grid.
NO_ZERO_IN_FRONT, NO_ZERO_IN_FRONT_MOST = 0.7, 6.0
NO_ZERO_AT_END = 1.0


@dataclass(frozen=True)
class Digits:
    """What the written numbers tell. Zero is left out: every format writes it as it likes.

    counts (length, begins with 0, ends with 0): how many numbers there are of each kind.
    """

    counts: Integers

    @classmethod
    def of(cls, whole: Floats, length: Integers) -> Digits:
        """From absolute values and digit counts (n,) of numbers without a point."""
        whole, length = whole[whole > 0], length[whole > 0]
        counts = np.zeros((MOST_DIGITS + 1, 2, 2), dtype=np.int64)
        begins, ends = whole < 10.0 ** (length - 1), whole % 10 == 0
        np.add.at(counts, (length, begins.astype(np.int64), ends.astype(np.int64)), 1)
        return cls(counts)

    @property
    def count(self) -> int:
        """How many numbers were counted, of any length."""
        return int(self.counts.sum())

    @property
    def longest(self) -> int:
        """Most digits of a number."""
        return int(np.flatnonzero(self.counts.any(axis=(1, 2))).max(initial=0))

    @property
    def equal(self) -> bool:
        """Whether all are as long."""
        return int(self.counts.any(axis=(1, 2)).sum()) <= 1

    @property
    def begins(self) -> float:
        """Share of numbers that begin with 0."""
        return float(self.counts[:, 1].sum()) / max(1, self.count)

    def ends(self, integer: int = 0) -> float:
        """Share of numbers that end with 0 behind the integer places: some write those in full, 010 for 10."""
        return float(self.counts[integer + 1 :, :, 1].sum()) / max(1, self.count)

    def full_width(self, digits: tuple[int, int]) -> bool:
        """Whether every number has all its places, so that no zero was dropped."""
        return self.equal and self.longest == sum(digits) > 1

    def other_width(self, digits: tuple[int, int], zeros: str | None) -> bool:
        """Whether the numbers can't have these places: longer, or equally long with zeros kept at both ends."""
        if self.longest > sum(digits):
            return True
        kept = self.begins > 0 and (self.ends(digits[0]) > 0 or zeros == "leading")
        return bool(self.equal and 1 < self.longest < sum(digits) and kept)

    def dropped(self, zeros: str | None, digits: tuple[int, int]) -> float:
        """That `zeros` were dropped, against the zeros that are still there."""
        if self.full_width(digits):
            return 0.0
        if zeros == "none":
            return -DROPPED_WEIGHT
        begins, ends = self.begins, self.ends(digits[0])
        if zeros == "leading":
            return -DROPPED_WEIGHT * begins - (0.0 if self.ends() else NO_ZERO_AT_END)
        return -DROPPED_WEIGHT * ends - (0.0 if begins else min(NO_ZERO_IN_FRONT_MOST, NO_ZERO_IN_FRONT * self.count))

    def fits(self, digits: tuple[int, int]) -> float:
        """That the format has as many places as the numbers have digits."""
        unused = sum(digits) - self.longest
        return TOO_LONG_WEIGHT * unused if unused < 0 else -UNUSED_PLACE_WEIGHT * unused


def common(choice: FormatChoice) -> float:
    """How often CAD programs write this format."""
    if choice.digits is None:
        return DECIMAL_AMONG_WHOLE
    return COMMON_DIGITS[choice.units].get(choice.digits, -5.0)


def usual(choice: FormatChoice, layout: Layout) -> float:
    """That few places, which say little of the board, have the unit's default digits."""
    few = FEW_PLACES / (layout.places + FEW_PLACES)
    return USUAL_WEIGHT * few * few if choice.digits == DEFAULT_DIGITS[choice.units] else 0.0


def same_places(choice: FormatChoice, places: int) -> float:
    """That inch drills written with `places` decimals (4 or more) belong to coordinates in this format."""
    alike = choice.units == "inch" and choice.digits is not None and choice.digits[1] == places >= 4
    return EAGLE_PLACES if alike else 0.0


def drills(diameter_mm: Floats) -> float:
    """That these are drills of a board, for the tools' known diameters."""
    known = diameter_mm[diameter_mm > 0]
    if not len(known):
        return 0.0
    absurd = known.min() > WIDEST_OF_ALL_MM or known.max() < FINEST_OF_ALL_MM
    return _typical(median(known), DRILL_MM, DRILL_SPREAD) - ABSURD_DRILLS_WEIGHT * absurd


def board(layout: Layout) -> float:
    """That holes laid out so are those of a board."""
    if layout.count < 2 or not layout.extent_mm:
        return 0.0
    dense = layout.places / (layout.places + FEW_PLACES)  # a few holes lie anywhere
    return (
        _typical(layout.extent_mm, BOARD_MM, BOARD_SPREAD)
        + dense * _typical(layout.pitch_mm, PITCH_MM, PITCH_SPREAD)
        + (_typical(layout.extent_mm / layout.drill_mm, BOARD_DRILLS, BOARD_DRILLS_SPREAD) if layout.drill_mm else 0.0)
        - CROWD_WEIGHT * layout.crowding**2
        + GRID_WEIGHT * layout.grid
    )


def _typical(value: float, typical: float, spread: float) -> float:
    """Logarithm of a density over log(value), 0 at the typical value; Student's t, as odd boards do exist."""
    deviation = np.log(max(value, 1e-6) / typical) / np.log(spread)
    return float(-(TAIL + 1) / 2 * np.log1p(deviation * deviation / TAIL))
