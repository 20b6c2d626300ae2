"""The segment form of a trace: slices of an image pool for the outputs, changes for everything else. Exact, and small.

Rule: nothing is lost: ``trace`` returns every change, and a checksum over the images of all ticks proves it. The image
of any tick is found by a search, not by running up to it. segment_file.py has the file form.
"""

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

import numpy as np

from drillctl.trace.record import Header, Signal, Trace
from drillctl.trace.shape import dense
from drillctl.trace.stretches import Stretch
from drillctl.trace.tapes import Images, Tape, images
from drillctl.trace.values import WIDEST_BITS, Values

OUTPUT = re.compile(r"out\.(\d+)")
MOST_TICKS = 100_000_000  # of a run that is kept in segments, or run again: two days at 500 Hz
MOST_STRIP_TICKS = 3_000_000  # of a run that was ticked, whose images are kept one for a tick
MOST_CHANGES = 4_000_000  # of a trace that is made of them in memory
CHUNK_TICKS = 1 << 20  # of the image array at once, where the whole of it is gone through
STRETCH_TICKS = 1 << 17  # whose changes are put together at once
WORD = (1 << WIDEST_BITS) - 1


@dataclass(frozen=True, eq=False)
class Segments:
    """A whole run. ``rest`` is the trace without its outputs; ``signals`` are all, in their order.

    pool    images, shape (k,), uint32 or uint64: card n's word in bits 32 n and up
    tapes   slices of the pool, each ``rest.end`` ticks long; what was put out is the OR of them
    """

    rest: Trace
    signals: tuple[Signal, ...]
    pool: Images
    tapes: tuple[Tape, ...]

    @classmethod
    def of_trace(cls, trace: Trace) -> "Segments":
        """Returns any trace in this form, its outputs as one long strip: exact, and as large as the run is long."""
        words = [signal for signal in trace.signals if OUTPUT.fullmatch(signal.name)]
        dtype: type[np.unsignedinteger] = np.uint32 if len(words) == 1 else np.uint64
        pool: Images = np.zeros(trace.end, dtype)
        for signal in words:
            card = int(signal.name.partition(".")[2])
            pool = pool | dense(trace, signal.name).astype(dtype) << dtype(WIDEST_BITS * card)
        return cls(without_outputs(trace), trace.signals, pool, (Tape.whole(0, trace.end),))

    def like(self, other: "Segments") -> bool:
        """Returns whether both are the same run, whatever their slices and headers are."""
        same_rest = replace(self.rest, header=other.rest.header, trailer=other.rest.trailer) == other.rest
        alike = self.pool.dtype == other.pool.dtype and len(self.tapes) == len(other.tapes)
        same_slices = alike and np.array_equal(self.pool, other.pool) and all(map(Tape.same, self.tapes, other.tapes))
        return same_rest and (same_slices or self.checksum == other.checksum)

    @property
    def end(self) -> int:
        """How many ticks were run."""
        return self.rest.end

    def images(self, first: int, end: int) -> Images:
        """Returns the images of ticks first..end-1."""
        return images(self.pool, self.tapes, np.empty(end - first, self.pool.dtype), first)

    def images_at(self, ticks: Values) -> Images:
        """Returns the images of these ticks, (n,) each."""
        found: Images = np.bitwise_or.reduce([self.pool[tape.at(ticks)] for tape in self.tapes])
        return found

    @cached_property
    def checksum(self) -> int:
        """CRC-32 of the array of images, little-endian, one a tick."""
        found = 0
        for part in self._parts():
            found = zlib.crc32(np.ascontiguousarray(part, part.dtype.newbyteorder("<")).data, found)
        return found

    @cached_property
    def change_count(self) -> int:
        """How many changes ``trace`` has, counted without making them."""
        return len(self.rest.ticks) + sum(len(ticks) for _, ticks, _ in self._output_changes())

    def trace(self) -> Trace:
        """Returns every change of every signal, ``change_count`` of them: check first that there is room for them."""
        numbers = {signal.name: number for number, signal in enumerate(self.signals)}
        rows = [(ticks, np.full(len(ticks), numbers[name], np.int32), values)
                for name, ticks, values in self._output_changes()]  # fmt: skip
        own = np.array([numbers[signal.name] for signal in self.rest.signals], np.int32)
        rows.append((self.rest.ticks, own[self.rest.signal], self.rest.values))
        when, which, values = (np.concatenate(column) for column in zip(*rows, strict=True))
        order = np.lexsort((which, when))
        columns = when[order], which[order], values[order]
        return Trace(self.rest.header, self.signals, *columns, self.end, self.rest.trailer)

    def stretches(self) -> Iterator[Stretch]:
        """Yields every change of every signal, as ``trace`` has them, STRETCH_TICKS ticks at a time: by tick, then as
        the signals are declared.
        """
        numbers = {signal.name: number for number, signal in enumerate(self.signals)}
        own = np.array([numbers[signal.name] for signal in self.rest.signals], np.int32)
        outputs, begun = self._output_changes(STRETCH_TICKS), 0
        cards = len(self.signals) - len(self.rest.signals)
        for first in range(0, self.end, STRETCH_TICKS):
            end = min(first + STRETCH_TICKS, self.end)
            until = int(np.searchsorted(self.rest.ticks, end))
            part, begun = slice(begun, until), until
            rows = [(ticks, np.full(len(ticks), numbers[name], np.int32), values)
                    for name, ticks, values in islice(outputs, cards)]  # fmt: skip
            rows.append((self.rest.ticks[part], own[self.rest.signal[part]], self.rest.values[part]))
            when, which, values = (np.concatenate(column) for column in zip(*rows, strict=True))
            order = np.lexsort((which, when))
            yield Stretch(end, when[order], which[order], values[order])

    def up_to(self, end: int) -> "Segments":
        """Returns the first ``end`` ticks of the run."""
        if end >= self.end:
            return self
        rows = self.rest.ticks < end
        columns = self.rest.ticks[rows], self.rest.signal[rows], self.rest.values[rows]
        rest = Trace(self.rest.header, self.rest.signals, *columns, end, self.rest.trailer)
        return Segments(rest, self.signals, self.pool, tuple(tape.up_to(end) for tape in self.tapes))

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """Key and value of each header line of the trace, in the order of the file."""
        return self.rest.header

    def with_header(self, header: Header) -> "Segments":
        """Returns the same run with another header."""
        return replace(self, rest=self.rest.with_header(header))

    def _parts(self, ticks: int = CHUNK_TICKS) -> Iterator[Images]:
        for first in range(0, self.end, ticks):
            yield self.images(first, min(first + ticks, self.end))

    def _output_changes(self, chunk_ticks: int = CHUNK_TICKS) -> Iterator[tuple[str, Values, Values]]:
        """Yields outputs by name, each with the ticks at which it changes and its words from there on, a chunk at a
        time.
        """
        cards = {signal.name: int(match[1]) for signal in self.signals if (match := OUTPUT.fullmatch(signal.name))}
        first, before = 0, dict.fromkeys(cards, -1)
        for part in self._parts(chunk_ticks):
            for name, card in cards.items():
                word = (part >> np.array(WIDEST_BITS * card, part.dtype)) & np.array(WORD, part.dtype)
                changed = np.flatnonzero(word[1:] != word[:-1]) + 1
                if int(word[0]) != before[name]:
                    changed = np.append(0, changed)
                yield name, first + changed, word[changed].astype(np.int64)
                before[name] = int(word[-1])
            first += len(part)


def without_outputs(trace: Trace) -> Trace:
    """Returns the trace without its output signals."""
    return trace.only(lambda signal: not OUTPUT.fullmatch(signal.name))
