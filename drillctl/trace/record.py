"""One run as three columns: tick, signal, value; changes only, stimuli and responses marked.

Rule: a trace is complete and canonical. Every signal has a value at tick 0, rows rise by tick and then by declaration,
no row repeats the value before it; so two runs that behave alike have the same columns. A sampler (ticker/sampler.py)
fills a Recorder after each tick; everything else only reads the Trace made from it.
"""

from array import array
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.trace.values import KINDS, WIDEST_BITS, Values, is_word

TICK_LIMIT = 10**12  # 63 years at 500 Hz; keeps tick x 10^6 us exact in 64 bits
Header = Iterable[tuple[str, str]]


@dataclass(frozen=True)
class Signal:
    """One thing that is recorded.

    `kind` is a row of `values.KINDS`; `names` the words behind a `name` or `command`. A stimulus is what came
    from outside (commands, inputs, requests, late gaps), a response what the machine made of it. A `derived`
    signal can be had again by replay and stands in a text file only on request. An `optional` one is left out
    of a trace in which it is 0 throughout. Raises ValueError when it could not be recorded.
    """

    name: str
    kind: str
    stimulus: bool
    derived: bool = False
    width_bits: int = WIDEST_BITS
    names: tuple[str, ...] = ()
    optional: bool = False

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"signal {self.name}: no kind {self.kind!r}; there are {', '.join(KINDS)}")
        if not 1 <= self.width_bits <= WIDEST_BITS:
            raise ValueError(f"signal {self.name}: {self.width_bits} bits; 1..{WIDEST_BITS} can be kept")
        if not all(map(is_word, (self.name, *self.names))) or len(set(self.names)) < len(self.names):
            raise ValueError(f"signal {self.name!r}: names must be different printable words without blanks")

    def show(self, value: int) -> str:
        """Returns the value as people read it and text files have it."""
        return KINDS[self.kind].show(value, self.names)

    def words(self, values: Values) -> NDArray[np.object_]:
        """Returns `show` of many values: shape (n,) to strings (n,). Each different value is formatted once only."""
        distinct, where = np.unique(values, return_inverse=True)
        shown = np.array([self.show(value) for value in distinct.tolist()], dtype=object)
        return shown[where]


@dataclass(frozen=True, eq=False)
class Trace:
    """A finished record. Ticks are 0-based and `end` is the number of ticks run.

    `header`: (key, value) pairs in order, keys may repeat. `ticks` int64 (n,), `signal` int32 (n,) index into
    `signals`, `values` int64 (n,). `trailer`: remarks about the run that replay ignores. The columns are
    read-only. Traces are equal when they say the same: words are compared, not the indexes behind them.
    """

    header: tuple[tuple[str, str], ...]
    signals: tuple[Signal, ...]
    ticks: Values
    signal: NDArray[np.int32]
    values: Values
    end: int
    trailer: tuple[str, ...] = ()

    @classmethod
    def of_changes(
        cls,
        header: Header,
        signals: Sequence[Signal],
        ticks: ArrayLike,
        signal: ArrayLike,
        values: ArrayLike,
        end: int,
        trailer: Iterable[str] = (),
    ) -> "Trace":
        """Returns a canonical trace from rows (n,) in any order.

        Of several rows for one signal and tick the last counts; a signal without a row at tick 0 was 0 until its first
        one. Raises ValueError for a tick outside 0..end-1, or a value that has no meaning for its signal: mistakes of
        the program that recorded, not of a file.
        """
        rows = _canonical(_with_tick_zero(len(signals), end, ticks, signal, values))
        recorded, (tick, index, value) = _without_silent(signals, rows)
        trace = cls(tuple(header), recorded, tick, index.astype(np.int32), value, end, tuple(trailer))
        _check(trace)
        return trace

    def __post_init__(self) -> None:
        for column in (self.ticks, self.signal, self.values):
            column.setflags(write=False)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Trace):
            return NotImplemented
        return self._frame() == other._frame() and all(
            _same_changes(mine, theirs) for mine, theirs in zip(self._worded(), other._worded(), strict=True)
        )

    __hash__ = None  # type: ignore[assignment]  # holds arrays, and equality looks through them

    def has(self, name: str) -> bool:
        """Returns whether a signal of this name was recorded."""
        return name in self._index

    def index_of(self, name: str) -> int:
        """Returns the index of the signal `name` in `signals`. Raises KeyError naming it."""
        return self._index[name]

    def changes_of(self, name: str) -> tuple[Values, Values]:
        """Returns ticks and values, both int64 (k,), at which the signal took a new value; the first is tick 0."""
        return self._by_signal[self.index_of(name)]

    def value_at(self, name: str, tick: int) -> int:
        """Returns the signal's value in `tick`, after its flush. Raises IndexError outside 0..end-1."""
        if not 0 <= tick < self.end:
            raise IndexError(f"tick {tick} is outside this trace's 0..{self.end - 1}")
        ticks, values = self.changes_of(name)
        return int(values[np.searchsorted(ticks, tick, side="right") - 1])

    def shown_at(self, name: str, tick: int) -> str:
        """Returns the signal's value in `tick` as text. Raises as `value_at`."""
        return self.signals[self.index_of(name)].show(self.value_at(name, tick))

    def with_header(self, header: Header) -> "Trace":
        """Returns the same run with another header."""
        return replace(self, header=tuple(header))

    def only(self, wanted: Callable[[Signal], bool]) -> "Trace":
        """Returns the same run with the signals that are wanted."""
        kept = [number for number, signal in enumerate(self.signals) if wanted(signal)]
        rows = np.isin(self.signal, kept)
        renumbered = np.searchsorted(kept, self.signal[rows]).astype(np.int32)
        signals = tuple(self.signals[number] for number in kept)
        columns = self.ticks[rows], renumbered, self.values[rows]
        return Trace(self.header, signals, *columns, self.end, self.trailer)

    def header_values(self, key: str) -> tuple[str, ...]:
        """Returns all values of a header key, in order; none if it is absent."""
        return tuple(value for name, value in self.header if name == key)

    def header_value(self, key: str) -> str:
        """Returns the first value of a header key. Raises KeyError when it is absent."""
        values = self.header_values(key)
        if not values:
            raise KeyError(f"the trace's header has no {key!r}")
        return values[0]

    @cached_property
    def _index(self) -> dict[str, int]:
        return {signal.name: index for index, signal in enumerate(self.signals)}

    @cached_property
    def _by_signal(self) -> tuple[tuple[Values, Values], ...]:
        rows = (np.flatnonzero(self.signal == index) for index in range(len(self.signals)))
        return tuple((self.ticks[where], self.values[where]) for where in rows)

    def _frame(self) -> tuple[object, ...]:
        return self.header, [(each.name, each.stimulus) for each in self.signals], self.end, self.trailer

    def _worded(self) -> Iterable[tuple[Signal, Values, Values]]:
        return ((signal, *self.changes_of(signal.name)) for signal in self.signals)


class Recorder:
    """Collects a run, change by change, 20 bytes each; its user sets a limit and checks `len()`."""

    def __init__(self, signals: Sequence[Signal]) -> None:
        self.signals = tuple(signals)
        self._last: list[int | None] = [None] * len(self.signals)
        self._ticks, self._signal, self._values = array("q"), array("i"), array("q")

    def __len__(self) -> int:
        """How many changes are kept so far."""
        return len(self._ticks)

    def set(self, index: int, tick: int, value: int) -> None:
        """Signal `index` has `value` in `tick`: kept if that is a change. Ticks must not fall."""
        if self._last[index] != value:
            self._last[index] = value
            self._ticks.append(tick)
            self._signal.append(index)
            self._values.append(value)

    def extend(self, index: int, ticks: Values, values: Values) -> None:
        """Signal `index` has these values (n,) from these rising ticks on, none before the last one `set`."""
        if len(ticks):
            self._last[index] = int(values[-1])
            self._ticks.frombytes(ticks.astype(np.int64).tobytes())
            self._signal.frombytes(np.full(len(ticks), index, np.intc).tobytes())
            self._values.frombytes(values.astype(np.int64).tobytes())

    def add(self, ticks: Values, signal: NDArray[np.int32], values: Values) -> None:
        """Adds rows (n,) as ``drain`` returns them. Only ``finish`` may follow: a later ``set`` is not compared with
        them.
        """
        self._ticks.frombytes(ticks.tobytes())
        self._signal.frombytes(signal.tobytes())
        self._values.frombytes(values.tobytes())

    def drain(self) -> tuple[Values, NDArray[np.int32], Values]:
        """Returns ticks, signals and values (n,) kept since the last call, and removes them."""
        columns = np.array(self._ticks), np.array(self._signal, np.int32), np.array(self._values)
        for column in (self._ticks, self._signal, self._values):
            del column[:]
        return columns

    def finish(self, end_tick: int, header: Header = (), trailer: Iterable[str] = ()) -> Trace:
        """Returns the trace of the ticks 0..end_tick-1. Raises as `Trace.of_changes`."""
        rows = (self._ticks, self._signal, self._values)
        return Trace.of_changes(header, self.signals, *rows, end_tick, trailer)


def _with_tick_zero(count: int, end: int, *columns: ArrayLike) -> Values:
    """Returns rows as int64 (3, n): tick, signal, value; a 0 at tick 0 for each of `count` signals comes first."""
    given = np.array([np.asarray(column, dtype=np.int64) for column in columns])
    zeros = np.zeros((3, count if end else 0), dtype=np.int64)
    zeros[1] = np.arange(zeros.shape[1])
    return np.concatenate((zeros, given), axis=1)


def _canonical(rows: Values) -> Values:
    """Returns rows (3, n) by tick, then signal: the last of each signal and tick, if it changes the value."""
    tick_signal, signal_tick, signal_value = slice(0, 2), slice(1, None, -1), slice(1, 3)
    rows = rows[:, np.lexsort(rows[tick_signal])]  # by signal, then tick; stable, so later rows stay later
    rows = rows[:, np.append(_differs(rows[tick_signal]), True)[: rows.shape[1]]]
    rows = rows[:, np.append(True, _differs(rows[signal_value]))[: rows.shape[1]]]
    return rows[:, np.lexsort(rows[signal_tick])]  # by tick, then signal


def _without_silent(signals: Sequence[Signal], rows: Values) -> tuple[tuple[Signal, ...], Values]:
    """Returns the signals that the trace has, and rows (3, n) by their numbers: no optional signal that is 0
    throughout.
    """
    silent = [n for n, signal in enumerate(signals) if signal.optional and not rows[2, rows[1] == n].any()]
    recorded = tuple(signal for n, signal in enumerate(signals) if n not in silent)
    rows = rows[:, ~np.isin(rows[1], silent)]
    rows[1] -= np.searchsorted(silent, rows[1])
    return recorded, rows


def _differs(rows: Values) -> NDArray[np.bool_]:
    """Returns whether each column (2, n) differs from the next: (n-1,)."""
    differs: NDArray[np.bool_] = np.any(rows[:, 1:] != rows[:, :-1], axis=0)
    return differs


def _check(trace: Trace) -> None:
    if len(trace._index) != len(trace.signals):
        raise ValueError("two signals have the same name")
    if not 0 <= trace.end <= TICK_LIMIT:
        raise ValueError(f"end {trace.end} is outside 0..{TICK_LIMIT}")
    if not np.isin(trace.signal, np.arange(len(trace.signals))).all():
        raise ValueError(f"a row is of no signal: there are only {len(trace.signals)}")
    if len(trace.ticks) and not 0 <= trace.ticks[0] <= trace.ticks[-1] < trace.end:
        raise ValueError(f"changes at ticks {trace.ticks[0]}..{trace.ticks[-1]}, but ticks 0..{trace.end - 1} were run")
    for signal, ticks, values in trace._worded():
        bad = np.flatnonzero(~KINDS[signal.kind].valid(values, signal.names, signal.width_bits))
        if len(bad):
            raise ValueError(f"signal {signal.name}: {values[bad[0]]} at tick {ticks[bad[0]]} is no {signal.kind}")


def _same_changes(mine: tuple[Signal, Values, Values], theirs: tuple[Signal, Values, Values]) -> bool:
    (signal, ticks, values), (other, other_ticks, other_values) = mine, theirs
    if not np.array_equal(ticks, other_ticks):
        return False
    if (signal.kind, signal.names) == (other.kind, other.names) and np.array_equal(values, other_values):
        return True  # what is the same number by the same names is the same word
    return np.array_equal(signal.words(values), other.words(other_values))
