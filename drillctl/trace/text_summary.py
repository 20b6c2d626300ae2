"""A trace in text form of which the outputs are only summed up: enough to see whether another run is the same.

Rule: the memory it takes grows with the commands and inputs of the run, not with what was put out.
"""

import os
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from drillctl.trace.reader import read_text
from drillctl.trace.record import Signal, Trace
from drillctl.trace.segments import CHUNK_TICKS, MOST_TICKS, OUTPUT, Segments, without_outputs
from drillctl.trace.stretches import Stretch
from drillctl.trace.tapes import Count, Images
from drillctl.trace.values import WIDEST_BITS


@dataclass(frozen=True, eq=False)
class TextSummary:
    """A run: ``rest`` is the trace without its outputs; ``signals`` are all. ``checksum`` is that of the segments
    (segments.py) of the same run, None where these would be too long.
    """

    rest: Trace
    signals: tuple[Signal, ...]
    checksum: int | None

    def of(self, segments: Segments) -> bool:
        """Returns whether segments are this run, with the same header and remarks."""
        names = [[signal.name for signal in run.signals] for run in (self, segments)]
        return names[0] == names[1] and segments.rest == self.rest and segments.checksum == self.checksum


def read_summary(
    path: str | os.PathLike[str], advance: Callable[[int, int], None] = lambda done, total: None
) -> TextSummary:
    """Returns the summary of the text trace in a file. ``advance``, errors: as ``read_text``."""
    outputs = _OutputSum()
    trace = read_text(path, advance=advance, kept=outputs.without)
    return TextSummary(without_outputs(trace), trace.signals, outputs.checksum(trace.end))


class _OutputSum:
    """The CRC-32 of the images of all ticks, made from the changes of the outputs, a stretch at a time."""

    def __init__(self) -> None:
        self._crc, self._tick, self._image = 0, 0, 0  # the image stands from this tick on; those before are in the CRC
        self._dtype: np.dtype[np.unsignedinteger] = np.dtype("<u4")

    def without(self, names: Sequence[str], stretch: Stretch) -> Stretch:
        """Takes the outputs out of a stretch of a run with signals of these names; returns the other changes."""
        cards = {index: int(match[1]) for index, name in enumerate(names) if (match := OUTPUT.fullmatch(name))}
        self._dtype = np.dtype("<u4") if len(cards) == 1 else np.dtype("<u8")
        outputs = np.isin(stretch.signal, list(cards))
        if outputs.any() and max(cards.values()) < 2 and stretch.end <= MOST_TICKS:
            self._add(stretch, np.flatnonzero(outputs), cards)
        return Stretch(stretch.end, stretch.ticks[~outputs], stretch.signal[~outputs], stretch.values[~outputs])

    def checksum(self, end: int) -> int | None:
        """Returns the CRC of the whole run of ``end`` ticks."""
        if end > MOST_TICKS:
            return None
        self._stand(np.array([self._image], self._dtype), np.array([end - self._tick]))
        return self._crc

    def _add(self, stretch: Stretch, rows: Count, cards: dict[int, int]) -> None:
        ticks, values = np.append(self._tick, stretch.ticks[rows]), stretch.values[rows].astype(self._dtype)
        images: Images = np.zeros(len(ticks), self._dtype)
        for index, card in cards.items():
            shift = np.array(WIDEST_BITS * card, self._dtype)
            word = np.array(self._image >> WIDEST_BITS * card & (1 << WIDEST_BITS) - 1, self._dtype)
            last = np.maximum.accumulate(np.where(stretch.signal[rows] == index, np.arange(1, len(ticks)), 0))
            images |= np.append(word, values)[np.append(0, last)] << shift
        self._stand(images[:-1], np.diff(ticks))
        self._tick, self._image = int(ticks[-1]), int(images[-1])

    def _stand(self, images: Images, ticks: Count) -> None:
        """Adds images (n,) that stand for so many ticks each."""
        ends = ticks.cumsum()
        for first in range(0, int(ends[-1]) if len(ends) else 0, CHUNK_TICKS):
            part = np.diff(np.clip(ends, first, first + CHUNK_TICKS), prepend=first)
            self._crc = zlib.crc32(np.repeat(images, part).data, self._crc)
