"""The outputs of a run in segments, looked at lane by lane without making its changes.

Rule: what a question needs of the run is put together when it is asked. A question about a long stretch is answered
from a summary of blocks, made once, in one pass over the images; only the two ends of the stretch are put together
again. The answers are those of a Column (lanes.py), but changes are counted to MANY.
"""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.segments import CHUNK_TICKS, Segments
from drillctl.trace.tapes import Images
from drillctl.trace.values import Values

BLOCK_TICKS = 1 << 12
SHORT_STRETCH = 2 * BLOCK_TICKS  # ticks: put together, without the summary
MANY = 2  # changes within a stretch of a strip: that many or more


class TapeView:
    """The images of a run in segments, and which of their bits change where."""

    def __init__(self, segments: Segments) -> None:
        self._segments, self.end = segments, segments.end
        self._strip_of = b""
        self._strip: tuple[Images, Images, Images] = self._none
        self._image_at: tuple[int, int] = (-1, 0)

    def image(self, tick: int) -> int:
        """Returns the image of a tick."""
        if self._image_at[0] != tick:  # all lanes are asked for the same tick, one after the other
            self._image_at = tick, int(self._segments.images_at(np.array([tick]))[0])
        return self._image_at[1]

    def flips(self, first: int, end: int) -> Images:
        """Returns which bits change in the ticks first..end-1, (n,): those that differ from the tick before, none in
        tick 0.
        """
        if first >= end:
            return self._none[0]
        images = self._segments.images(max(first - 1, 0), end)
        if first == 0:
            images = np.append(images[:1], images)
        return np.bitwise_xor(images[1:], images[:-1])

    def strip(self, edges: Values) -> tuple[Images, Images, Images]:
        """Returns, for rising ``edges`` (n+1,), the image at the end of each stretch between two of them, the bits that
        change in it, and those that change twice or more, (n,) each.
        """
        if self._strip_of != edges.tobytes():  # all lanes are asked for the same strip, one after the other
            pairs = zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)
            begin, end = int(edges[0]), int(edges[-1])
            if end - begin <= SHORT_STRETCH * len(edges):
                flips = self.flips(begin, end)
                changed = [_once_and_again(flips[first - begin : last - begin]) for first, last in pairs]
            else:
                changed = [self._changed(*pair) for pair in pairs]
            once, again = np.array(changed, self._segments.pool.dtype).reshape(-1, 2).T
            self._strip = self._segments.images_at(np.maximum(edges[1:] - 1, 0)), once, again
            self._strip_of = edges.tobytes()
        return self._strip

    def next_block(self, bit: int, block: int, direction: int) -> int | None:
        """Returns the first block from ``block`` on in which a bit changes, in this direction; None for none."""
        once = self._summary[0]
        rows = np.arange(block, len(once)) if direction > 0 else np.arange(min(block, len(once) - 1), -1, -1)
        found = np.flatnonzero(once[rows] >> np.array(bit, once.dtype) & np.array(1, once.dtype))
        return int(rows[found[0]]) if len(found) else None

    def _changed(self, first: int, end: int) -> tuple[int, int]:
        """Returns the bits that change in first..end-1, and those that change twice or more."""
        if end - first <= SHORT_STRETCH:
            return _once_and_again(self.flips(first, end))
        low, high = -(-first // BLOCK_TICKS), end // BLOCK_TICKS
        inner = [column[low:high] for column in self._summary]
        parts = [
            _once_and_again(self.flips(first, low * BLOCK_TICKS)),
            (_once_and_again(inner[0])[0], _once_and_again(inner[0])[1] | int(np.bitwise_or.reduce(inner[1]))),
            _once_and_again(self.flips(high * BLOCK_TICKS, end)),
        ]
        once = again = 0
        for part_once, part_again in parts:
            once, again = once | part_once, again | part_again | (once & part_once)
        return once, again

    @cached_property
    def _summary(self) -> tuple[Images, Images]:
        """The bits that change in each block, and those that change twice or more in it, (blocks,) each."""
        once, again = [], []
        for first in range(0, self.end, CHUNK_TICKS):
            flips = self.flips(first, min(first + CHUNK_TICKS, self.end))
            rows = np.append(flips, np.zeros(-len(flips) % BLOCK_TICKS, flips.dtype)).reshape(-1, BLOCK_TICKS)
            before = np.bitwise_or.accumulate(rows, axis=1)
            once.append(before[:, -1].copy())
            again.append(np.bitwise_or.reduce(rows[:, 1:] & before[:, :-1], axis=1))
        return np.concatenate(once or [self._none[0]]), np.concatenate(again or [self._none[0]])

    @property
    def _none(self) -> tuple[Images, Images, Images]:
        nothing = np.zeros(0, self._segments.pool.dtype)
        return nothing, nothing, nothing


class TapeColumn:
    """One bit of the outputs; the questions are those of a Column."""

    def __init__(self, view: TapeView, bit: int, invert: bool) -> None:
        self._view, self._bit, self._invert = view, bit, invert

    def at(self, tick: int) -> int | None:
        """Returns the value in a tick."""
        return self._view.image(tick) >> self._bit & 1 ^ self._invert

    def window(self, from_tick: int, to_tick: int) -> tuple[Values, Values]:
        """Like the method of Column; the ticks between are put together."""
        to_tick = min(to_tick, self._view.end)
        if from_tick >= to_tick:
            return np.zeros(0, np.int64), np.zeros(0, np.int64)
        changes = np.flatnonzero(self._of(self._view.flips(from_tick + 1, to_tick)))
        ticks = np.append(from_tick, from_tick + 1 + changes)
        return ticks, np.arange(len(ticks)) & 1 ^ (self.at(from_tick) or 0)

    def strip(self, edges: Values) -> tuple[Values, Values]:
        """Like the method of Column, with changes counted to MANY."""
        last, once, again = map(self._of, self._view.strip(edges))
        return last ^ self._invert, once + again

    def find(self, tick: int, direction: int, onset: bool) -> int | None:
        """Like the method of Column: block by block, those without a change passed over."""
        if onset and tick < 0 < direction and self.at(0):
            return 0  # a lane that is on from the beginning came on there
        block = max(tick + direction, 0) // BLOCK_TICKS
        while block >= 0 and (found := self._view.next_block(self._bit, block, direction)) is not None:
            first = found * BLOCK_TICKS
            flips = self._view.flips(first, min(first + BLOCK_TICKS, self._view.end))
            changes = first + np.flatnonzero(self._of(flips))
            beyond = changes[changes > tick] if direction > 0 else changes[changes < tick]
            wanted = [at for at in beyond.tolist() if not onset or self.at(at)]
            if wanted:
                return wanted[0] if direction > 0 else wanted[-1]
            block = found + direction
        return 0 if onset and direction < 0 < tick and self.at(0) else None

    def _of(self, images: Images) -> NDArray[np.int64]:
        return (images >> np.array(self._bit, images.dtype) & np.array(1, images.dtype)).astype(np.int64)


def _once_and_again(flips: Images) -> tuple[int, int]:
    """Returns the bits that are set in any of the rows (n,), and those that are set in two or more."""
    if len(flips) == 0:
        return 0, 0
    before = np.bitwise_or.accumulate(flips)
    return int(before[-1]), int(np.bitwise_or.reduce(flips[1:] & before[:-1]))
