"""What the holes look like in millimetres under one number format, and whether that can be a board.

Rule: measures only, of a sample; holes that overlap in a row are a slot drawn as hits, and say nothing against
a format. recognise.py compares the layouts of several formats, score.py says how plausible each is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .model import Floats

GRIDS_MM = (1.27, 0.5)
GRID_TOLERANCE_MM = 0.01
OFF_LINE = 0.25  # of the drills' reach: a neighbour further off the line to the nearest one is no part of a slot

# Outside of these a board is odd: its longer side in mm, and in drill diameters.
SMALLEST_MM, SMALLEST_DIAMETERS = 10.0, 12.0
LARGEST_MM = 300.0
# Below these it is odd whatever was declared: drills of 2 mm and more hold a board or a connector.
CROWDED_DIAMETERS, WIDE_DRILL_MM = 5.5, 2.0
TOUCHING_DIAMETERS = 1.0
PILED_HOLES, PILED_SHARE, PILED_DIAMETERS = 20, 0.5, 12.0  # slots drawn as hits may cross, on a wide board
WIDEST_DRILL_MM = 10.0  # wider tools are openings that are milled


@dataclass(frozen=True)
class Layout:
    """Measures of n distinct holes (mm).

    extent_mm: longer side; pitch_mm: median distance to the next hole; drill_mm: widest drill, 0 if unknown;
    overlap: share of holes that overlap another; crowding: share that overlaps others in more than one direction;
    grid: share of coordinates on a drawing grid.
    """

    count: int
    extent_mm: float
    pitch_mm: float
    drill_mm: float
    overlap: float
    crowding: float
    grid: float

    @classmethod
    def of(cls, xy_mm: Floats, diameter_mm: Floats) -> Layout:
        """From distinct holes (n, 2) and their diameters (n,), 0 for unknown."""
        drill_mm = float(diameter_mm[diameter_mm <= WIDEST_DRILL_MM].max(initial=0.0))
        if len(xy_mm) < 2:
            return cls(len(xy_mm), 0.0, 0.0, drill_mm, 0.0, 0.0, 0.0)
        steps = xy_mm[:, None] - xy_mm[None]
        distance = np.hypot(steps[..., 0], steps[..., 1])
        np.fill_diagonal(distance, np.inf)
        reach = (diameter_mm[:, None] + diameter_mm[None]) / 2
        touching = distance < reach
        return cls(
            count=len(xy_mm),
            extent_mm=float(np.ptp(xy_mm, axis=0).max()),
            pitch_mm=median(distance.min(axis=1)),
            drill_mm=drill_mm,
            overlap=float(touching.any(axis=1).mean()),
            crowding=_crowding(steps, distance, reach, touching) if touching.any() else 0.0,
            grid=_on_grid(xy_mm),
        )

    @property
    def places(self) -> int:
        """How many places there are to judge by: a slot drawn as hits is one."""
        return round(self.count * (1 - self.overlap)) + (self.overlap > 0)

    @property
    def piled_up(self) -> bool:
        """Whether no board can be so: most of many holes overlap in two directions, on a few drills' width."""
        narrow = self.extent_mm < PILED_DIAMETERS * self.drill_mm
        return narrow and self.count >= PILED_HOLES and self.crowding >= PILED_SHARE

    @property
    def odd(self) -> bool:
        """Whether the board is absurd for its drills, whatever the file declares."""
        if self.count < 2 or not self.drill_mm:
            return False
        diameters = self.extent_mm / self.drill_mm
        return diameters < (CROWDED_DIAMETERS if self.drill_mm >= WIDE_DRILL_MM else TOUCHING_DIAMETERS)

    @property
    def unusual(self) -> bool:
        """Whether the board is so small or large that digits which were not declared are doubtful."""
        if self.count < 2:
            return False
        small = self.extent_mm < max(SMALLEST_MM, SMALLEST_DIAMETERS * self.drill_mm)
        return self.odd or small or self.extent_mm > LARGEST_MM

    def __str__(self) -> str:
        drills = f", drills to {self.drill_mm:.2f} mm" if self.drill_mm else ""
        return f"longer side {self.extent_mm:.1f} mm{drills}"


def median(values: Floats) -> float:
    """The middle of values (n,), n > 0, as np.median has it; that would import numpy.ma, a tenth of a short verb."""
    ordered = np.sort(values)
    return float((ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2)


def _crowding(steps: Floats, distance: Floats, reach: Floats, touching: np.ndarray) -> float:
    """Share of holes with an overlapping neighbour off the line to their farthest overlapping one."""
    farthest = np.where(touching, distance, -1.0).argmax(axis=1)
    rows = np.arange(len(steps))
    along = steps[rows, farthest] / np.maximum(distance[rows, farthest], 1e-9)[:, None]
    off = np.abs(along[:, None, 0] * steps[..., 1] - along[:, None, 1] * steps[..., 0])
    return float((touching & (off > OFF_LINE * reach)).any(axis=1).mean())


def _on_grid(xy_mm: Floats) -> float:
    """Share of distances to the middle hole that are whole steps of the better drawing grid, beyond chance."""
    steps = xy_mm - np.sort(xy_mm, axis=0)[len(xy_mm) // 2]
    steps = steps[np.abs(steps) > GRID_TOLERANCE_MM]
    if not len(steps):
        return 0.0
    shares = []
    for grid_mm in GRIDS_MM:
        off = np.abs(steps - grid_mm * np.round(steps / grid_mm))
        chance = 2 * GRID_TOLERANCE_MM / grid_mm
        shares.append((float((off <= GRID_TOLERANCE_MM).mean()) - chance) / (1 - chance))
    return max(0.0, *shares)
