"""Which holes touch each other. Rule: never every pair; neighbours are found through a grid.

Two holes closer than their radii overlap: rare on a real board, certain when a format is read ten times
too small. checks.py warns with it, score.py chooses formats by it (on a sample, every pair).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .model import Floats, Integers

Flags = NDArray[np.bool_]
Meets = Callable[[Integers, Integers], Flags]  # whether the holes of each pair of indices meet, (k,)

TOUCH_MM = 0.002  # holes that only touch do not overlap; files round to about this
SAME_MM = 1e-6
LAG_LIMIT = 24  # neighbours looked at within one cell: more holes of one class cannot lie there without overlap


def meetings(xy_mm: Floats, diameter_mm: Floats) -> tuple[Integers, Integers]:
    """Indices of holes that overlap an earlier hole, and of holes in the very place of one.

    xy_mm (n, 2), diameter_mm (n,) with 0 for unknown. Both answers ascending, without repetitions.
    """
    x, y = xy_mm[:, 0].copy(), xy_mm[:, 1].copy()

    def overlap(first: Integers, second: Integers) -> Flags:
        distance = np.hypot(x[first] - x[second], y[first] - y[second])
        reach = (diameter_mm[first] + diameter_mm[second]) / 2 - TOUCH_MM
        return (distance < reach) & (distance > SAME_MM)

    def same(first: Integers, second: Integers) -> Flags:
        return np.hypot(x[first] - x[second], y[first] - y[second]) <= SAME_MM

    overlapping, duplicate = np.zeros((2, len(xy_mm)), bool)
    everything = np.arange(len(xy_mm))
    _mark(duplicate, xy_mm, everything, SAME_MM, np.ones(len(xy_mm), bool), same)
    size = np.maximum(diameter_mm, TOUCH_MM)
    octave = np.ceil(np.log2(size)).astype(np.int64)
    for power in sorted(set(octave.tolist())):  # np.unique would import numpy.ma, a tenth of a short verb's time
        # A class reaches up to twice its smallest diameter, so that one 6 mm hole does not make the grid of a
        # thousand 0.3 mm holes coarse.
        pool = np.flatnonzero(octave <= power)
        _mark(overlapping, xy_mm, pool, float(size[pool].max()), octave[pool] == power, overlap)
    return np.flatnonzero(overlapping), np.flatnonzero(duplicate)


def _mark(found: Flags, xy_mm: Floats, pool: Integers, reach_mm: float, wanted: Flags, meets: Meets) -> None:
    """Sets ``found`` (n,) for each hole of ``pool`` (k,), ascending, that meets an earlier one of it within reach.

    ``wanted`` (k,): of each pair one must be; another pair may be looked at as well. Cells are twice the reach wide; of
    four grids, shifted by half a cell, one holds any such pair. A hole once found is not looked at again, so that many
    overlaps cost no more than few.
    """
    for shift in ((0, 0), (1, 0), (0, 1), (1, 1)):
        cell = np.floor((xy_mm[pool] / reach_mm + shift) / 2).astype(np.int64)
        key = cell[:, 0] * (1 << 31) + cell[:, 1]
        order = np.argsort(key, kind="stable")  # within a cell the holes stay ascending
        starts = np.flatnonzero(np.diff(key[order], prepend=key[order[:1]] - 1))
        sizes = np.diff(starts, append=len(key))
        before = np.arange(len(key)) - np.repeat(starts, sizes)  # holes that come before it in its cell
        crowded = np.repeat(np.logical_or.reduceat(wanted[order], starts), sizes)
        place = np.flatnonzero(crowded)
        for lag in range(1, LAG_LIMIT):
            place = place[(before[place] >= lag) & ~found[pool[order[place]]]]
            if not len(place):
                break
            later = pool[order[place]]
            found[later[meets(pool[order[place - lag]], later)]] = True
