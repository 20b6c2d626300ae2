"""A run piece by piece, in the order of time, so that no reader of it needs all changes in memory.

Rule: a stretch holds the changes of some ticks in a row; the next one begins where it ends.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.record import Recorder, Signal, Trace
from drillctl.trace.values import Values

CHANGES_AT_ONCE = 1 << 18


# By signal, of those that have any: ticks that don't fall, and values. Of several of one tick the last counts.
Changes = Mapping[int, tuple[Values, Values]]


class Stretch(NamedTuple):
    """The changes (n,) of a part of a run, up to tick ``end``: ticks rise within each signal, and a value may repeat.

    signal  index into the signals of the run
    """

    end: int
    ticks: Values
    signal: NDArray[np.int32]
    values: Values


def stretches(trace: Trace) -> Iterator[Stretch]:
    """Yields a trace in stretches of about CHANGES_AT_ONCE changes; a tick is never divided."""
    first = 0
    while first < len(trace.ticks):
        end = min(first + CHANGES_AT_ONCE, len(trace.ticks))
        end = int(np.searchsorted(trace.ticks, trace.ticks[end - 1], side="right"))
        part = slice(first, end)
        yield Stretch(int(trace.ticks[end - 1]) + 1, trace.ticks[part], trace.signal[part], trace.values[part])
        first = end


def by_signal(stretch: Stretch) -> Changes:
    """Returns the changes of each signal that has any in a stretch."""
    order = np.argsort(stretch.signal.astype(np.int16), kind="stable")
    present, starts = np.unique(stretch.signal[order], return_index=True)
    found = {}
    for index, rows in zip(present.tolist(), np.split(order, starts[1:]), strict=True):
        found[index] = stretch.ticks[rows], stretch.values[rows]
    return found


class SignalRecorder(Recorder):
    """A Recorder that keeps each signal apart, for one who empties it often and wants ``Changes``."""

    def __init__(self, signals: Sequence[Signal]) -> None:
        super().__init__(signals)
        self._kept: dict[int, list[tuple[Values, Values]]] = {}

    def set(self, index: int, tick: int, value: int) -> None:
        """Notes a signal's value from this tick on, as a Recorder does."""
        if self._last[index] != value:
            self._last[index] = value
            self._kept.setdefault(index, []).append((np.array([tick]), np.array([value])))

    def extend(self, index: int, ticks: Values, values: Values) -> None:
        """Notes a signal's values from these ticks on, as a Recorder does."""
        if len(ticks):
            self._last[index] = int(values[-1])
            self._kept.setdefault(index, []).append((ticks, values))

    def taken(self) -> Changes:
        """Returns what was kept since the last call, and removes it."""
        kept, self._kept = self._kept, {}
        joined = {index: [np.concatenate(each) for each in zip(*parts, strict=True)] for index, parts in kept.items()}
        return {index: (ticks, values) for index, (ticks, values) in joined.items()}


def last_of_tick(ticks: Values, values: Values) -> tuple[Values, Values]:
    """Returns rows (n,) of one signal without those that a later one of the same tick replaces."""
    last = np.append(ticks[1:] != ticks[:-1], True)[: len(ticks)]
    return ticks[last], values[last]
