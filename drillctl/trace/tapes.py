"""Pools of port images, and tapes: the output of one axis in a whole run, as slices of a pool.

Rule: a tape is a list of slices, never an array of ticks; only ``images`` makes that, as the OR of all tapes. A machine
puts out few different strips: a rest, the head of a ramp, a cruise through the phase cycle, a tail. Each is in the pool
once for every column that it may begin at.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

Count = NDArray[np.int64]
Images = NDArray[np.unsignedinteger]

DARK = 0  # the image of no output
PERIOD = 4096  # ticks of a strip that repeats itself: long enough to copy well, short enough for the cache
CHUNK = 1 << 16  # ticks put together at once, so that the OR of the tapes stays in the cache


class ImagePool:
    """Strips of images, one after the other, of one unsigned dtype. It grows; a strip never moves within it."""

    def __init__(self, dtype: DTypeLike):
        self._strips = np.zeros(1 << 16, dtype)
        self._length = 0
        self._steady: dict[int, int] = {}
        self.steady(DARK)

    @property
    def images(self) -> Images:
        """All strips as one array, shape (length,)."""
        return self._strips[: self._length]

    def add(self, strip: ArrayLike) -> int:
        """Adds a strip (n,) at the end; returns where it begins."""
        images = np.asarray(strip, self._strips.dtype)
        start, end = self._length, self._length + len(images)
        if end > len(self._strips):
            self._strips = np.resize(self._strips, max(end, 2 * len(self._strips)))
        self._strips[start:end] = images
        self._length = end
        return start

    def steady(self, image: int) -> int:
        """Returns where a strip of PERIOD times the same image begins; that of no output at all begins at 0."""
        if image not in self._steady:
            self._steady[image] = self.add(np.full(PERIOD, image, self._strips.dtype))
        return self._steady[image]


@dataclass(frozen=True, eq=False)
class Tape:
    """Slices of a pool, in the order of time: ``start`` and ``ticks``, both int64 (k,)."""

    start: Count
    ticks: Count

    @classmethod
    def of(cls, start: Count, ticks: Count, period: Count) -> "Tape":
        """Returns a tape of slices (k,) that may be empty, or longer than their strip: those repeat after ``period``
        ticks. A period of PERIOD is a steady image, which joins the same one before it.
        """
        some = np.flatnonzero(ticks > 0)
        start, ticks, period = start[some], ticks[some], period[some]
        joins = (start[1:] == start[:-1]) & (period[1:] == PERIOD) & (period[:-1] == PERIOD)
        first = np.flatnonzero(np.append(True, ~joins)[: len(start)])
        ticks = np.add.reduceat(ticks, first) if len(first) else ticks
        start, period = start[first], period[first]
        periods = -(-ticks // period)
        last = np.cumsum(periods) - 1
        left = ticks - (periods - 1) * period
        start, ticks = np.repeat(start, periods), np.repeat(period, periods)
        ticks[last] = left
        return cls(start, ticks)

    @classmethod
    def whole(cls, start: int, ticks: int) -> "Tape":
        """Returns a tape of one slice."""
        return cls(np.array([start]), np.array([ticks]))

    @classmethod
    def steady(cls, start: int, ticks: int) -> "Tape":
        """Returns a tape of one image, whose strip begins at ``start``, for ``ticks`` ticks."""
        return cls.of(np.array([start]), np.array([ticks]), np.array([PERIOD]))

    @classmethod
    def joined(cls, tapes: Sequence["Tape"]) -> "Tape":
        """Returns one tape of several, one after the other."""
        return cls(np.concatenate([t.start for t in tapes]), np.concatenate([t.ticks for t in tapes]))

    def same(self, other: "Tape") -> bool:
        """Returns whether both have the same slices."""
        return np.array_equal(self.start, other.start) and np.array_equal(self.ticks, other.ticks)

    @property
    def dark(self) -> bool:
        """Whether no output is ever on."""
        return not self.start.any()

    def up_to(self, end: int) -> "Tape":
        """Returns the tape's first ``end`` ticks."""
        count = int(np.searchsorted(self.ends(), end)) + 1
        ticks = self.ticks[:count].copy()
        ticks[-1] -= int(ticks.sum()) - end
        return Tape(self.start[:count], ticks)

    def ends(self) -> Count:
        """Returns the tick behind each slice, (k,)."""
        return self._ends

    @cached_property
    def _ends(self) -> Count:
        return np.cumsum(self.ticks)

    def at(self, ticks: Count) -> Count:
        """Returns where in the pool the image of each of these ticks (n,) is."""
        row = np.searchsorted(self._ends, ticks, side="right")
        return self.start[row] + self.ticks[row] - (self._ends[row] - ticks)


def images(pool: Images, tapes: Sequence[Tape], out: Images, first: int = 0) -> Images:
    """Fills ``out`` (n,) with the images from tick ``first`` on: the OR of all tapes, each of which
    reaches that far.
    """
    cuts = [(tape, tape.ends()) for tape in tapes if not tape.dark] or [(tapes[0], tapes[0].ends())]
    scratch = np.empty(CHUNK, out.dtype)
    for begin in range(0, len(out), CHUNK):
        part = out[begin : begin + CHUNK]
        window, beside = (first + begin, first + begin + len(part)), scratch[: len(part)]
        np.concatenate(_slices(pool, *cuts[0], *window), out=part)
        for tape, ends in cuts[1:]:
            np.concatenate(_slices(pool, tape, ends, *window), out=beside)
            np.bitwise_or(part, beside, out=part)
    return out


def _slices(pool: Images, tape: Tape, ends: Count, first: int, end: int) -> list[Images]:
    """Returns the slices of the pool that are on the tape from tick ``first`` up to ``end``."""
    low, high = np.searchsorted(ends, (first, end - 1), side="right")
    start, stop = tape.start[low : high + 1].copy(), tape.start[low : high + 1] + tape.ticks[low : high + 1]
    start[0] = stop[0] - (ends[low] - first)
    stop[-1] -= ends[high] - end
    return list(map(pool.__getitem__, map(slice, start.tolist(), stop.tolist())))
