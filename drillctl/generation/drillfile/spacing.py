"""Which holes touch each other. Rule: never every pair; neighbours are found through a grid.

Two holes closer than their radii overlap: rare on a real board, certain when a format is read ten times
too small. checks.py warns with it, score.py chooses formats by it (on a sample, every pair).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .model import Floats, Integers

TOUCH_MM = 0.002  # holes that only touch do not overlap; files round to about this
SAME_MM = 1e-6
LAG_LIMIT = 24  # neighbours looked at within one cell: more holes of one class cannot lie there without overlap


def meetings(xy_mm: Floats, diameter_mm: Floats) -> tuple[Integers, Integers]:
    """Indices of holes that overlap an earlier hole, and of holes in the very place of one.

    xy_mm (n, 2), diameter_mm (n,) with 0 for unknown. Both answers ascending, without repetitions.
    """
    overlapping = np.zeros(len(xy_mm), dtype=bool)
    duplicate = np.zeros(len(xy_mm), dtype=bool)
    for first, second in _neighbours(xy_mm, diameter_mm):
        distance = np.hypot(*(xy_mm[first] - xy_mm[second]).T)
        reach = (diameter_mm[first] + diameter_mm[second]) / 2 - TOUCH_MM
        later = np.maximum(first, second)
        duplicate[later[distance <= SAME_MM]] = True
        overlapping[later[(distance < reach) & (distance > SAME_MM)]] = True
    return np.flatnonzero(overlapping), np.flatnonzero(duplicate)


def _neighbours(xy_mm: Floats, diameter_mm: Floats) -> Iterator[tuple[Integers, Integers]]:
    """Pairs (first, second) of indices that may overlap, by classes of diameter.

    A class reaches up to twice its smallest diameter, so that one 6 mm hole does not make the grid of a
    thousand 0.3 mm holes coarse.
    """
    size = np.maximum(diameter_mm, TOUCH_MM)
    octave = np.ceil(np.log2(size)).astype(np.int64)
    for power in np.unique(octave):
        pool = np.flatnonzero(octave <= power)
        belongs = octave[pool] == power
        for first, second in _cell_mates(xy_mm[pool], float(size[pool].max()), belongs):
            yield pool[first], pool[second]


def _cell_mates(xy_mm: Floats, reach_mm: float, wanted: np.ndarray) -> Iterator[tuple[Integers, Integers]]:
    """Pairs within reach that share a cell with a wanted point.

    Cells are twice the reach wide; of four grids, shifted by half a cell, one holds any such pair.
    """
    for shift in ((0, 0), (1, 0), (0, 1), (1, 1)):
        cell = np.floor((xy_mm / reach_mm + shift) / 2).astype(np.int64)
        key = cell[:, 0] * (1 << 31) + cell[:, 1]
        order = np.argsort(key, kind="stable")
        sorted_key = key[order]
        starts = np.flatnonzero(np.diff(sorted_key, prepend=sorted_key[0] - 1))
        crowded = np.repeat(np.logical_or.reduceat(wanted[order], starts), np.diff(starts, append=len(key)))
        order, sorted_key = order[crowded], sorted_key[crowded]
        for lag in range(1, LAG_LIMIT):
            mates = np.flatnonzero(sorted_key[lag:] == sorted_key[:-lag])
            if not len(mates):
                break
            yield order[mates], order[mates + lag]
