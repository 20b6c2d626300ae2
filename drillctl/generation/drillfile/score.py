"""How plausible a number format is for given digits. Rule: every term is the logarithm of a probability,
rough but stated, so terms add and a difference of 3 means twenty to one.

The constants describe drilled boards in general: sizes of boards and drills, distances of holes, drawing
grids, and how often CAD programs write each format. recognise.py adds the terms for each candidate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .model import Floats, FormatChoice, Integers

SAMPLE_HOLES = 600

# How common a format is where nothing is declared (logarithms; the first is the CNC-7 default).
COMMON_DIGITS: dict[str, dict[tuple[int, int], float]] = {
    "inch": {
        (2, 4): 0.0, (2, 3): -2.5, (2, 5): -2.5, (3, 3): -3.0, (3, 5): -3.5, (1, 4): -4.0, (3, 4): -4.0,
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
TAIL = 4.0  # Student's degrees of freedom: how soon an odd value stops being held against a format

GRIDS_MM = (1.27, 0.5)
GRID_TOLERANCE_MM = 0.01
GRID_WEIGHT = 1.5
OVERLAP_WEIGHT = 20.0  # times the square of the share: a third may be two drills for one hole, all is a wrong scale
EAGLE_PLACES = 2.0  # EAGLE writes its drills with as many decimals as its coordinates
DROPPED_WEIGHT = 14.0  # every number that begins (ends) with a zero, times the share of such numbers
TOO_LONG_WEIGHT = 8.0
TOO_SHORT_WEIGHT = 4.0
UNUSED_PLACE_WEIGHT = 0.3
NONE_OF_THE_KIND_WEIGHT = 1.0


@dataclass(frozen=True)
class Digits:
    """What the written numbers tell. Zero is left out: every format writes it as it likes.

    starts, ends: share of numbers that begin or end with 0; longest: most digits; equal: all as long.
    """

    count: int
    starts: float
    ends: float
    longest: int
    equal: bool

    @classmethod
    def of(cls, whole: Floats, length: Integers) -> Digits:
        """From absolute values and digit counts (n,) of numbers without a point."""
        whole, length = whole[whole > 0], length[whole > 0]
        if not len(whole):
            return cls(0, 0.0, 0.0, 0, True)
        starts = float((whole < 10.0 ** (length - 1)).mean())
        ends = float((whole % 10 == 0).mean())
        return cls(len(whole), starts, ends, int(length.max()), bool((length == length[0]).all()))

    @property
    def full_width(self) -> bool:
        """All equally long with zeros in front: nothing was dropped."""
        return self.equal and self.starts > 0

    def dropped(self, zeros: str | None) -> float:
        """That `zeros` were dropped, against the zeros that are still there."""
        if zeros == "none":
            return 0.0 if self.equal else -DROPPED_WEIGHT
        if self.full_width:
            return 0.0
        there, other = (self.starts, self.ends) if zeros == "leading" else (self.ends, self.starts)
        unlikely = NONE_OF_THE_KIND_WEIGHT if not (other or self.equal) else 0.0
        return -DROPPED_WEIGHT * there - unlikely

    def fits(self, digits: tuple[int, int]) -> float:
        """That the format has as many places as the numbers have digits."""
        spare = sum(digits) - self.longest
        if spare < 0:
            return TOO_LONG_WEIGHT * spare
        return -TOO_SHORT_WEIGHT * spare if self.full_width else -UNUSED_PLACE_WEIGHT * spare


def common(choice: FormatChoice) -> float:
    """How often CAD programs write this format."""
    if choice.digits is None:
        return DECIMAL_AMONG_WHOLE
    return COMMON_DIGITS[choice.units].get(choice.digits, -5.0)


def same_places(choice: FormatChoice, places: int) -> float:
    """That inch drills written with `places` decimals (4 or more) belong to coordinates in this format."""
    alike = choice.units == "inch" and choice.digits is not None and choice.digits[1] == places >= 4
    return EAGLE_PLACES if alike else 0.0


def drills(diameter_mm: Floats) -> float:
    """That these are drills of a board, for the tools' known diameters."""
    known = diameter_mm[diameter_mm > 0]
    return _typical(float(np.median(known)), DRILL_MM, DRILL_SPREAD) if len(known) else 0.0


@dataclass(frozen=True)
class Layout:
    """Measures of a sample of holes under one format (mm): n holes, extent, median distance to the next hole,
    share of holes that overlap another, share on a drawing grid."""

    extent_mm: float
    pitch_mm: float
    overlap: float
    grid: float

    @classmethod
    def of(cls, xy_mm: Floats, diameter_mm: Floats) -> Layout:
        """From at most SAMPLE_HOLES distinct holes (n, 2) and their diameters (n,), 0 for unknown."""
        if len(xy_mm) < 2:
            return cls(0.0, 0.0, 0.0, 0.0)
        distance = np.hypot(*(xy_mm[:, None] - xy_mm[None]).transpose(2, 0, 1))
        np.fill_diagonal(distance, np.inf)
        reach = (diameter_mm[:, None] + diameter_mm[None]) / 2
        overlap = float((distance < reach).any(axis=1).mean())
        pitch_mm = float(np.median(distance.min(axis=1)))
        return cls(float(np.ptp(xy_mm, axis=0).max()), pitch_mm, overlap, _on_grid(xy_mm))

    def plausible(self) -> float:
        """That this is a board."""
        if not self.extent_mm:
            return 0.0
        return (
            _typical(self.extent_mm, BOARD_MM, BOARD_SPREAD)
            + _typical(self.pitch_mm, PITCH_MM, PITCH_SPREAD)
            - OVERLAP_WEIGHT * self.overlap**2
            + GRID_WEIGHT * self.grid
        )


def _typical(value: float, typical: float, spread: float) -> float:
    """Logarithm of a density over log(value), 0 at the typical value; Student's t, as odd boards do exist."""
    deviation = np.log(max(value, 1e-6) / typical) / np.log(spread)
    return float(-(TAIL + 1) / 2 * np.log1p(deviation * deviation / TAIL))


def _on_grid(xy_mm: Floats) -> float:
    """Share of coordinates on the better of the drawing grids, beyond what chance gives."""
    steps = xy_mm - np.sort(xy_mm, axis=0)[len(xy_mm) // 2]
    shares = []
    for grid_mm in GRIDS_MM:
        off = np.abs(steps - grid_mm * np.round(steps / grid_mm))
        chance = 2 * GRID_TOLERANCE_MM / grid_mm
        shares.append((float((off <= GRID_TOLERANCE_MM).mean()) - chance) / (1 - chance))
    return max(0.0, *shares)
