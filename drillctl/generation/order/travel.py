"""What a move costs: the ticks of the slower axis, looked up in the ramps' travel tables.

Rule: a table is taken as it is. With a ramp a longer move may be quicker (seven-state ramp: 3 steps take
18 ticks, 4 take 17), so nothing here or in its callers may assume that costs grow with distance.
Every module of this package counts in these ticks.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Steps = NDArray[np.int64]
Ticks = NDArray[np.int64]


class OrderError(ValueError):
    """An order that cannot be planned: a name not known, or holes farther apart than the tables reach."""


@dataclass(frozen=True, eq=False)
class TravelCost:
    """Travel tables of the two axes: `ticks_x[d]` and `ticks_y[d]` are the ticks of a move of d >= 0 steps.

    Both axes run at once, so a move takes the greater of the two, and at least 1 tick. Entries are kept
    as int64 of 1 or more. Raises OrderError for tables that are empty or not one-dimensional.
    """

    ticks_x: Ticks
    ticks_y: Ticks
    least_x: Ticks = field(init=False)
    least_y: Ticks = field(init=False)

    def __post_init__(self) -> None:
        for axis in ("x", "y"):
            table = np.asarray(getattr(self, f"ticks_{axis}"))
            if table.ndim != 1 or not len(table) or table.dtype.kind not in "iu":
                raise OrderError(f"the travel table of {axis} must be a row of whole numbers, not {table!r}")
            ticks = np.maximum(table.astype(np.int64), 1)
            object.__setattr__(self, f"ticks_{axis}", ticks)
            object.__setattr__(self, f"least_{axis}", np.minimum.accumulate(ticks[::-1])[::-1])

    def between(self, here: Steps, there: Steps) -> Ticks:
        """Ticks from `here` to `there`, both (..., 2) in steps and broadcast against each other."""
        distance = np.abs(here - there)
        return np.maximum(self.ticks_x[distance[..., 0]], self.ticks_y[distance[..., 1]])

    def at_least(self, gap: Steps) -> Ticks:
        """Least ticks of any move of `gap` (..., 2) steps or more in both axes."""
        return np.maximum(self.least_x[gap[..., 0]], self.least_y[gap[..., 1]])

    def check_reach(self, points: Steps) -> None:
        """Raise OrderError unless the tables hold every move between two of `points` (n, 2), n >= 1."""
        reach = (len(self.ticks_x) - 1, len(self.ticks_y) - 1)
        for axis, needed, held in zip("xy", np.ptp(points, axis=0), reach, strict=True):
            if needed > held:
                raise OrderError(
                    f"the holes lie {needed} steps apart in {axis}, the travel table ends at {held}; "
                    "check the holes against the axis's range first"
                )


def as_steps(points: ArrayLike) -> Steps:
    """Points as int64 (n, 2), n may be 0. Raises OrderError for anything but whole numbers in pairs."""
    array = np.asarray(points)
    if array.size == 0:
        return np.zeros((0, 2), np.int64)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise OrderError(f"points are pairs of whole steps, (n, 2), not {array.dtype} {array.shape}")
    return array.astype(np.int64)
