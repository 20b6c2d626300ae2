"""A run lane by lane, while it goes on: for each lane the ticks at which it changed, and its new values.

Rule: a lane is a signal or one bit of it. Rows are added at the end, the oldest are removed from all lanes at the same
tick, and every look-up is a binary search: it costs the same in a run of a minute as in one of a day.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.values import Values

FORWARDS, BACKWARDS = 1, -1


@dataclass(frozen=True, slots=True)
class Lane:
    """`signal`: its index in the record. `bit`: of a port word; None: the whole value. `invert`: 1 where it is 0."""

    signal: int
    bit: int | None = None
    invert: bool = False

    def of(self, values: Values) -> Values:
        """Returns the lane's values from the signal's values (n,)."""
        return values if self.bit is None else (values >> self.bit & 1) ^ int(self.invert)


class Column:
    """The changes of one lane, in arrays that grow by doubling; the first row is its value from the start."""

    def __init__(self) -> None:
        self._rows = np.zeros((2, 16), np.int64)
        self._count = 0

    def __len__(self) -> int:
        """How many rows there are."""
        return self._count

    @property
    def ticks(self) -> Values:
        """The ticks of the rows, int64 (n,), rising."""
        return self._rows[0, : self._count]

    @property
    def values(self) -> Values:
        """The values of the rows, int64 (n,), each different from the one before."""
        return self._rows[1, : self._count]

    def append(self, ticks: Values, values: Values) -> None:
        """Adds later rows (n,), n > 0, without those that repeat the value before."""
        news = np.empty(len(values), bool)
        news[0] = not self._count or values[0] != self._rows[1, self._count - 1]
        news[1:] = values[1:] != values[:-1]
        count = self._count + int(np.count_nonzero(news))
        if count > self._rows.shape[1]:
            grown = np.zeros((2, 2 * count), np.int64)
            grown[:, : self._count] = self._rows[:, : self._count]
            self._rows = grown
        self._rows[:, self._count : count] = ticks[news], values[news]
        self._count = count

    def cut(self, tick: int) -> None:
        """Removes the rows before `tick`; the value that held there becomes the first row."""
        first = self._row_at(tick)
        if first > 0:
            self._rows = self._rows[:, first : self._count].copy()
            self._count -= first
        if self._count:
            self._rows[0, 0] = max(tick, self._rows[0, 0])

    def at(self, tick: int) -> int | None:
        """Returns the value in a tick; None before the first row."""
        row = self._row_at(tick)
        return int(self.values[row]) if row >= 0 else None

    def window(self, from_tick: int, to_tick: int) -> tuple[Values, Values]:
        """Returns ticks and values of the rows in from_tick..to_tick-1, after the value that holds at from_tick, (n,)
        each.
        """
        low, high = max(self._row_at(from_tick), 0), self._row_at(to_tick - 1) + 1
        return np.maximum(self.ticks[low:high], from_tick), self.values[low:high]

    def strip(self, edges: Values) -> tuple[Values, Values]:
        """Returns, for rising `edges` (n+1,), the value at the end of each stretch between two of them, and its number
        of changes, (n,).

        However long a stretch is, every change in it is counted. The first row is no change.
        """
        if not self._count:
            return np.zeros(len(edges) - 1, np.int64), np.zeros(len(edges) - 1, np.int64)
        rows = np.maximum(self.ticks.searchsorted(edges), 1)
        return self.values[rows[1:] - 1], rows[1:] - rows[:-1]

    def find(self, tick: int, direction: int, onset: bool) -> int | None:
        """Returns the next change after `tick`, or the last one before it; None where there is none.

        onset  only a change to a value other than 0 counts, but then the first row too
        """
        low, high = (self._row_after(tick), self._count) if direction > 0 else (0, self._row_at(tick - 1) + 1)
        counts = self.values[low:high] != 0 if onset else np.arange(low, high) > 0
        found = np.flatnonzero(counts)
        return int(self.ticks[low + found[0 if direction > 0 else -1]]) if len(found) else None

    def _row_at(self, tick: int) -> int:
        return self._row_after(tick) - 1

    def _row_after(self, tick: int) -> int:
        return int(self.ticks.searchsorted(tick, side="right"))


class Lanes:
    """All lanes of a run. At most `most` rows are kept in all; when there are more, the older half of the run is
    removed.
    """

    def __init__(self, lanes: Sequence[Lane], most: int):
        self.columns = tuple(Column() for _ in lanes)
        self._most = max(most, 2 * len(lanes))
        self.first_tick = 0
        self._of_signal: dict[int, list[tuple[Lane, Column]]] = {}
        for lane, column in zip(lanes, self.columns, strict=True):
            self._of_signal.setdefault(lane.signal, []).append((lane, column))

    def __len__(self) -> int:
        """How many rows there are in all lanes."""
        return sum(map(len, self.columns))

    def append(self, ticks: Values, signal: NDArray[np.int32], values: Values) -> None:
        """Adds later changes (n,), by rising tick; those of signals that no lane shows are left out."""
        if not len(ticks):
            return
        for index, rows in _rows_by_signal(signal):
            for lane, column in self._of_signal.get(index, ()):
                column.append(ticks[rows], lane.of(values[rows]))
        while len(self) > self._most:
            self._cut((self.first_tick + int(ticks[-1]) + 1) // 2)

    def _cut(self, tick: int) -> None:
        self.first_tick = tick
        for column in self.columns:
            column.cut(tick)


def _rows_by_signal(signal: NDArray[np.int32]) -> Iterator[tuple[int, NDArray[np.int64]]]:
    """Yields each signal that occurs, and its rows in their order."""
    order = np.argsort(signal, kind="stable")
    present, starts = np.unique(signal[order], return_index=True)
    return zip(present.tolist(), np.split(order, starts[1:]), strict=True)
