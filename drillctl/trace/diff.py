"""Where two runs differ: the first tick at which a response differs, and the command it happened in.

Rule: values are compared, tick by tick, not lines; stimuli are what both runs were given and don't count. Since traces
are canonical, the first unequal change of a signal is its first unequal tick.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.record import TICK_LIMIT, Trace
from drillctl.trace.values import IDLE, Values

CONTEXT_CHANGES = 3  # shown before and after the difference, of each trace
ABSENT = "(not recorded)"
END = "end"  # stands for a signal where one run is longer than the other


@dataclass(frozen=True)
class Nearby:
    """One change near the difference. `side`: "-" in the expected trace alone, "+" in the actual one, " " in both."""

    tick: int
    signal: str
    shown: str
    side: str


@dataclass(frozen=True)
class Difference:
    """The first tick at which a response differs, with both values as text.

    `signal` is `end` where the runs agree until one of them is over. `command` is the one that was current in the
    expected run (`-`: none). `bits`: numbers of the bits that differ, for port words. `around`: changes before and
    after.
    """

    tick: int
    signal: str
    expected: str
    actual: str
    command: str
    bits: tuple[int, ...]
    around: tuple[Nearby, ...]


def first_difference(
    expected: Trace, actual: Trace, signals: Sequence[str] | None = None, from_tick: int = 0
) -> Difference | None:
    """Returns the first difference of the named signals from a tick on, or None where both runs are the same to the
    end.

    Without `signals`: all responses of either trace that are not derived. Of several signals that differ in the same
    tick, the first named (declared) counts. Raises KeyError for a signal that neither trace has.
    """
    names = list(signals) if signals is not None else _responses(expected, actual)
    found = [(tick, name) for name in names if (tick := _first_tick(expected, actual, name, from_tick)) is not None]
    if found:
        tick, name = min(found, key=lambda each: each[0])
        return _difference(expected, actual, tick, name)
    if expected.end != actual.end:
        return _unequal_ends(expected, actual, names)
    return None


def render(difference: Difference, bit_names: Mapping[str, Sequence[str]] | None = None) -> str:
    """Returns the difference as a dozen lines of plain ASCII. `bit_names`: a signal's bits by name, from bit 0."""
    lines = [
        f"first difference at tick {difference.tick}: {difference.signal}",
        f"  expected  {difference.expected}",
        f"  actual    {difference.actual}",
        *_bit_lines(difference, (bit_names or {}).get(difference.signal, ())),
        f"  command   {difference.command}",
        f"  changes around it (- expected only, + actual only, {CONTEXT_CHANGES} before and after):",
        *(f"  {near.side} {near.tick:>8} {near.signal} {near.shown}" for near in difference.around),
    ]
    return "\n".join(lines).encode("ascii", "backslashreplace").decode()


def _responses(*traces: Trace) -> list[str]:
    signals = (signal for trace in traces for signal in trace.signals)
    return list(dict.fromkeys(signal.name for signal in signals if not (signal.stimulus or signal.derived)))


def _first_tick(expected: Trace, actual: Trace, name: str, from_tick: int) -> int | None:
    """Returns the first tick from there on in which the signal differs while both runs went on, or None."""
    if expected.has(name) != actual.has(name):
        return from_tick if from_tick < min(expected.end, actual.end) else None
    both_runs = _comparable(expected, actual, name)
    (ticks, values), (other_ticks, other_values) = (_from(from_tick, *changes) for changes in both_runs)
    both = min(len(ticks), len(other_ticks))
    unequal = (ticks[:both] != other_ticks[:both]) | (values[:both] != other_values[:both])
    row = int(np.argmax(unequal)) if unequal.any() else both
    tick = min((int(each[row]) for each in (ticks, other_ticks) if row < len(each)), default=expected.end)
    return tick if tick < min(expected.end, actual.end) else None


def _comparable(expected: Trace, actual: Trace, name: str) -> Iterator[tuple[Values, NDArray[Any]]]:
    """Yields ticks and values of both traces, made equal where the words are: traces may number words differently."""
    signals = [trace.signals[trace.index_of(name)] for trace in (expected, actual)]
    alike = signals[0].kind == signals[1].kind and signals[0].names == signals[1].names
    for trace, signal in zip((expected, actual), signals, strict=True):
        ticks, values = trace.changes_of(name)
        yield ticks, values if alike else signal.words(values)


def _from(tick: int, ticks: Values, values: NDArray[Any]) -> tuple[Values, NDArray[Any]]:
    """Returns the changes from a tick on, after the value that holds there."""
    first = max(int(np.searchsorted(ticks, tick, side="right")) - 1, 0)
    return np.maximum(ticks[first:], tick), values[first:]


def _difference(expected: Trace, actual: Trace, tick: int, name: str) -> Difference:
    values = [trace.shown_at(name, tick) if trace.has(name) else ABSENT for trace in (expected, actual)]
    return Difference(
        tick=tick,
        signal=name,
        expected=values[0],
        actual=values[1],
        command=_command(expected, tick),
        bits=_differing_bits(expected, actual, tick, name),
        around=_around(expected, actual, [name], tick),
    )


def _unequal_ends(expected: Trace, actual: Trace, names: Sequence[str]) -> Difference:
    tick = min(expected.end, actual.end)
    return Difference(
        tick=tick,
        signal=END,
        expected=f"{expected.end} ticks",
        actual=f"{actual.end} ticks",
        command=_command(expected, min(tick, expected.end - 1)),
        bits=(),
        around=_around(expected, actual, names, tick),
    )


def _command(trace: Trace, tick: int) -> str:
    return trace.shown_at("kmd", tick) if trace.has("kmd") and tick >= 0 else IDLE


def _differing_bits(expected: Trace, actual: Trace, tick: int, name: str) -> tuple[int, ...]:
    traces = (expected, actual)
    if not all(trace.has(name) and trace.signals[trace.index_of(name)].kind == "word" for trace in traces):
        return ()
    unequal = expected.value_at(name, tick) ^ actual.value_at(name, tick)
    return tuple(bit for bit in range(unequal.bit_length()) if unequal >> bit & 1)


def _bit_lines(difference: Difference, names: Sequence[str]) -> list[str]:
    """Returns a line with the bits that differ, by name or number, and what each should be."""
    if not difference.bits:
        return []
    expected = int(difference.expected, 16)
    labels = [names[bit] if bit < len(names) and names[bit] else f"bit {bit}" for bit in difference.bits]
    wanted = ["on" if expected >> bit & 1 else "off" for bit in difference.bits]
    bits = ", ".join(f"{label} should be {value}" for label, value in zip(labels, wanted, strict=True))
    return [f"  bits      {bits}"]


def _around(expected: Trace, actual: Trace, names: Sequence[str], tick: int) -> tuple[Nearby, ...]:
    """Returns the changes of both traces near `tick`, as far as the one that changes more often was looked at."""
    (mine, mine_until), (theirs, theirs_until) = (_near(trace, names, tick) for trace in (expected, actual))
    until = min(mine_until, theirs_until)
    sides = {(True, True): " ", (True, False): "-", (False, True): "+"}
    changes = sorted({change for change in mine | theirs if change[0] < until})
    return tuple(Nearby(*change, sides[change in mine, change in theirs]) for change in changes)


def _near(trace: Trace, names: Sequence[str], tick: int) -> tuple[set[tuple[int, str, str]], int]:
    """Returns changes (tick, signal, shown) around `tick`, and the tick of the first one after them."""
    wanted = [index for index, signal in enumerate(trace.signals) if signal.name in names]
    rows = np.flatnonzero(np.isin(trace.signal, wanted))
    here = int(np.searchsorted(trace.ticks[rows], tick))
    near = rows[max(here - CONTEXT_CHANGES, 0) : here + CONTEXT_CHANGES]
    beyond = rows[here + CONTEXT_CHANGES : here + CONTEXT_CHANGES + 1]
    until = int(trace.ticks[beyond[0]]) if len(beyond) else TICK_LIMIT
    signals = [trace.signals[index] for index in trace.signal[near].tolist()]
    ticks, values = trace.ticks[near].tolist(), trace.values[near].tolist()
    rows_near = zip(ticks, signals, values, strict=True)
    return {(tick, signal.name, signal.show(value)) for tick, signal, value in rows_near}, until
