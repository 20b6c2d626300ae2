"""Strips of port images, and tapes cut from them: what one axis puts out in a whole run, as slices of a small array.

Rule: a tape is a list of slices, never an array of ticks; only ``images`` makes that, as the OR of all tapes. A machine
puts out few different things: a rest, a head of the ramp, a cruise through the phase cycle, a tail. Each lies in the
pool once, for every column that it may begin at. Made by execution/fastforward, kept in files by segments.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

Count = NDArray[np.int64]
Images = NDArray[np.unsignedinteger]

DARK = 0  # the image of no output
PERIOD = 4096  # ticks of a strip that repeats itself: long enough to copy well, short enough for the cache
CHUNK = 1 << 16  # ticks put together at once, so that the OR of the tapes stays in the cache


class ImagePool:
    """Strips of images laid end to end, of one unsigned dtype. It grows; what lies in it stays where it is."""

    def __init__(self, dtype: DTypeLike):
        self._kept = np.zeros(1 << 16, dtype)
        self._length = 0
        self._steady: dict[int, int] = {}
        self.steady(DARK)

    @property
    def images(self) -> Images:
        """All strips, shape (length,)."""
        return self._kept[: self._length]

    def add(self, strip: ArrayLike) -> int:
        """Lays a strip (n,) at the end; returns where it begins."""
        images = np.asarray(strip, self._kept.dtype)
        start, end = self._length, self._length + len(images)
        if end > len(self._kept):
            self._kept = np.resize(self._kept, max(end, 2 * len(self._kept)))
        self._kept[start:end] = images
        self._length = end
        return start

    def steady(self, image: int) -> int:
        """Where a strip of PERIOD times the same image begins; that of no output at all begins at 0."""
        if image not in self._steady:
            self._steady[image] = self.add(np.full(PERIOD, image, self._kept.dtype))
        return self._steady[image]


@dataclass(frozen=True, eq=False)
class Tape:
    """Slices of a pool: ``start`` and ``ticks``, both int64 (k,). What follows what is the order in time."""

    start: Count
    ticks: Count

    @classmethod
    def of(cls, start: Count, ticks: Count, period: Count) -> "Tape":
        """From slices (k,) that may be empty, or longer than their strip: those repeat after ``period`` ticks. A period
        of PERIOD is a steady image, which joins the same one before it.
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
        """One slice."""
        return cls(np.array([start]), np.array([ticks]))

    @classmethod
    def steady(cls, start: int, ticks: int) -> "Tape":
        """One image, whose strip begins there, for so long."""
        return cls.of(np.array([start]), np.array([ticks]), np.array([PERIOD]))

    @classmethod
    def joined(cls, tapes: Sequence["Tape"]) -> "Tape":
        """One after the other."""
        return cls(np.concatenate([t.start for t in tapes]), np.concatenate([t.ticks for t in tapes]))

    def same(self, other: "Tape") -> bool:
        """Whether both are the same slices."""
        return np.array_equal(self.start, other.start) and np.array_equal(self.ticks, other.ticks)

    @property
    def dark(self) -> bool:
        """Whether nothing is ever on."""
        return not self.start.any()

    def up_to(self, end: int) -> "Tape":
        """Its first ``end`` ticks."""
        kept = int(np.searchsorted(self.ends(), end)) + 1
        ticks = self.ticks[:kept].copy()
        ticks[-1] -= int(ticks.sum()) - end
        return Tape(self.start[:kept], ticks)

    def ends(self) -> Count:
        """The tick behind each slice, (k,)."""
        return np.cumsum(self.ticks)


def images(pool: Images, tapes: Sequence[Tape], out: Images, first: int = 0) -> Images:
    """Fills ``out`` (n,) with the images from tick ``first`` on: the OR of all tapes, each of which reaches so far."""
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
    """The pieces of the pool that are on the tape from tick ``first`` up to ``end``."""
    low, high = np.searchsorted(ends, (first, end - 1), side="right")
    start, stop = tape.start[low : high + 1].copy(), tape.start[low : high + 1] + tape.ticks[low : high + 1]
    start[0] = stop[0] - (ends[low] - first)
    stop[-1] -= ends[high] - end
    return list(map(pool.__getitem__, map(slice, start.tolist(), stop.tolist())))
