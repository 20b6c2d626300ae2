"""The VCD form of a trace, for GTKWave, Surfer and PulseView: wires, columns, positions, states, commands.

Rule: the same trace and layout give the same bytes, without date or path; a value at a tick is that after its
flush. This room knows no machine, so the caller hands in the layout: which variable, in which scope, shows
what of which signal. pyvcd writes the head and forms the values; the changes are put together a page at a time.

A value of the signal `pace` is the tick rate that holds from the tick after (docs/SPEC.md, 1.20).

PulseView with libsigrok 0.5.2 (Debian 12) stops reading at the first integer change; it shows a layout of
wires alone in full. GTKWave shows all.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.record import Signal, Trace
from drillctl.trace.stretches import Changes, by_signal, stretches
from drillctl.trace.target import Target, opened
from drillctl.trace.values import IDLE, OPCODES, WIDEST_BITS, Values, is_word
from drillctl.trace.vcd_pages import Column, PageWriter

if TYPE_CHECKING:
    from vcd.writer import Variable

# Units in us, coarsest first: sigrok expands a file to one sample a unit, so a fine one costs it dearly.
TIMESCALES = ((1000, "1 ms"), (100, "100 us"), (10, "10 us"), (1, "1 us"))
US_PER_SECOND = 10**6
NOTHING = np.empty(0, np.int64)
SIZES_BITS = {"wire": 1, "integer": 32, "string": 1}


@dataclass(frozen=True)
class VcdVar:
    """One variable of the file.

    `kind`: `wire` (bit `bit` of the value), `integer` (the value, signed 32 bits) or `string` (its word, or
    `labels[value]`). `source`: name of the signal. `part`, of a command signal only: `seq` or `opcode`
    (integers), `running` (a string). `invert`: the wire is 1 where the bit is 0. A scope `a.b` is b within a.
    Raises ValueError for a combination that does not exist.
    """

    scope: str
    name: str
    kind: str
    source: str
    bit: int | None = None
    part: str | None = None
    invert: bool = False
    labels: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        if (self.kind, self.part) not in _CONVERSIONS:
            raise ValueError(f"{self.scope}.{self.name}: no {self.kind} can show part {self.part}")
        if self.kind == "wire" and (self.bit is None or not 0 <= self.bit < WIDEST_BITS):
            raise ValueError(f"{self.scope}.{self.name}: a wire needs a bit, 0..{WIDEST_BITS - 1}, not {self.bit}")
        if not is_word(self.scope) or not is_word(self.name):
            raise ValueError(f"{self.scope!r} {self.name!r}: scopes and names are printable words without blanks")


VcdLayout = Sequence[VcdVar]


def write_vcd(trace: Trace, target: Target, layout: VcdLayout) -> None:
    """Writes the trace to a path or an open text file.

    All variables are dumped at time 0, and a last time stamp marks the end, so viewers show the full length. The header
    must have `machine`, `tick_hz` and `digest`, and the sources must have been recorded (KeyError). Raises ValueError
    for a tick rate that is no whole number in 1..10^6, a part of a signal that is no command, or a value without a
    label; OSError as `open`. A refused trace leaves the target alone.
    """
    for var in layout:
        if var.labels is not None:
            _string(trace.changes_of(var.source)[1], trace.signals[trace.index_of(var.source)], var)
    write_vcd_run(trace, trace.signals, map(by_signal, stretches(trace)), target, layout)


def write_vcd_run(
    frame: Trace, signals: Sequence[Signal], run: Iterable[Changes], target: Target, layout: VcdLayout
) -> None:
    """Writes a run that comes in stretches, as changes of these signals, without keeping it; otherwise as `write_vcd`.

    `frame` has the run's header, its end and its changes of rate. A value without a label is found on the way.
    """
    from vcd import VCDWriter

    comment, clock = _comment(frame), _Clock(_rates(frame))
    numbers = {signal.name: number for number, signal in enumerate(signals)}
    variables = [_Variable(var, numbers[var.source], signals[numbers[var.source]]) for var in layout]
    with opened(target, "w") as file:
        writer = VCDWriter(file, timescale=clock.timescale, date="", comment=comment)
        dumped = [writer.register_var(var.scope, var.name, var.kind, SIZES_BITS[var.kind]) for var in layout]
        pages = PageWriter(file, clock.times, [_line_of(each) for each in dumped])
        for number, changes in enumerate(run):
            columns = [variable.news(changes) for variable in variables]
            if number == 0:
                for registered, (_, shown) in zip(dumped, columns, strict=True):
                    writer.change(registered, 0, shown[:1].tolist()[0])
                writer.flush()
                columns = [(ticks[1:], shown[1:]) for ticks, shown in columns]
            pages.write(columns)
        writer.flush()
        end_time = int(clock.times(np.array([frame.end]))[0])
        if end_time != pages.time:
            file.write(f"#{end_time}\n")


class _Variable:
    """A variable of the file, which remembers its last value from stretch to stretch."""

    def __init__(self, var: VcdVar, number: int, signal: Signal) -> None:
        if var.part and signal.kind != "command":
            raise ValueError(f"{var.scope}.{var.name}: signal {var.source} is a {signal.kind}, it has no {var.part}")
        self._var, self._number, self._signal = var, number, signal
        self._last: NDArray[Any] | None = None

    def news(self, changes: Changes) -> Column:
        """Returns where it changes in a stretch, and its new values; in the first one also tick 0, where a signal that
        has no value there is 0.
        """
        ticks, values = changes.get(self._number, (NOTHING, NOTHING))
        if self._last is None and not (len(ticks) and ticks[0] == 0):
            ticks, values = np.append(0, ticks), np.append(0, values)
        shown = _CONVERSIONS[self._var.kind, self._var.part](values, self._signal, self._var)
        begin = shown[:1] if self._last is None else self._last
        news = np.append(begin, shown)[:-1] != shown
        news[:1] |= self._last is None
        self._last = shown[-1:] if len(shown) else self._last
        return ticks[news], shown[news]


def _line_of(registered: "Variable[Any]") -> Callable[[Any], str]:
    return lambda value: registered.format_value(value) + "\n"


Rate = tuple[int, int]  # the first tick that follows at it, and ticks a second


class _Clock:
    """Converts ticks to times: in the largest unit that divides the length of every tick, else in us, rounded."""

    def __init__(self, rates: Sequence[Rate]) -> None:
        exact = (row for row in TIMESCALES if all(US_PER_SECOND % (hz * row[0]) == 0 for _, hz in rates))
        unit_us, self.timescale = next(exact, TIMESCALES[-1])
        self._stretches: list[tuple[int, Fraction, Fraction]] = []  # first tick, its time, ticks in a unit of time
        time, since, ticks_per_unit = Fraction(0), 0, Fraction(1)
        for tick, hz in rates:
            time += (tick - since) / ticks_per_unit
            since, ticks_per_unit = tick, Fraction(hz * unit_us, US_PER_SECOND)
            self._stretches.append((tick, time, ticks_per_unit))

    def times(self, ticks: Values) -> Values:
        """Returns the nearest whole times of rising ticks (n,), halves to even as Python's round(); in integers, hence
        exact.
        """
        firsts = np.array([first for first, _, _ in self._stretches])
        parts = zip(self._stretches, np.split(ticks, np.searchsorted(ticks, firsts[1:])), strict=True)
        return np.concatenate([_nearest(begun, per_unit, part - first) for (first, begun, per_unit), part in parts])


def _nearest(begun: Fraction, per_unit: Fraction, ticks: Values) -> Values:
    """Returns the whole times nearest to ``begun`` and so many ticks. Python's integers where 64 bits would not hold
    them.
    """
    unit = begun.denominator * per_unit.numerator
    wide = object if begun else np.int64  # the first stretch, mostly the only one, begins at 0
    numerators = ticks.astype(wide) * (per_unit.denominator * begun.denominator) + begun.numerator * per_unit.numerator
    times = numerators // unit
    half = 2 * (numerators - times * unit) - unit
    rounded = times + ((half > 0) | ((half == 0) & (times % 2 == 1)))
    return rounded.astype(np.int64)


def _rates(trace: Trace) -> list[Rate]:
    """Returns the rates of a run: that of its header, and each requested one, from the tick after."""
    found = [(0, _rate(trace.header_value("tick_hz"), "the trace's header has tick_hz"))]
    ticks, rates = trace.changes_of("pace") if trace.has("pace") else ((), ())
    for tick, hz in zip(ticks, rates, strict=True):
        if hz:
            found.append((int(tick) + 1, _rate(str(hz), "the trace has a pace of")))
    return found


def _rate(word: str, whose: str) -> int:
    if not (word.isascii() and word.isdecimal() and len(word) < 8 and 1 <= int(word) <= US_PER_SECOND):
        raise ValueError(f"{whose} {word!r}: a whole number in 1..{US_PER_SECOND} is needed")
    return int(word)


def _comment(trace: Trace) -> str:
    """Returns one line of words. Blanks and `$`, which could end the comment, become `_`."""
    pairs = [f"{key}={trace.header_value(key)}" for key in ("machine", "tick_hz", "digest")]
    pairs += [f"tick_hz={hz}@{tick}" for tick, hz in _rates(trace)[1:]]
    return " ".join(["drillctl", *(pair.translate({ord(" "): "_", ord("$"): "_"}) for pair in pairs)])


def _wire(values: Values, _: Signal, var: VcdVar) -> NDArray[Any]:
    assert var.bit is not None  # VcdVar refuses such a wire
    return ((values >> var.bit) & 1) ^ int(var.invert)


def _string(values: Values, signal: Signal, var: VcdVar) -> NDArray[Any]:
    if var.labels is None:
        return signal.words(values)
    if len(values) and not 0 <= values.min() <= values.max() < len(var.labels):
        raise ValueError(f"{var.scope}.{var.name}: signal {var.source} has a value without a label")
    return np.array(var.labels, dtype=object)[values]


def _running(values: Values, signal: Signal, _: VcdVar) -> NDArray[Any]:
    return np.array([IDLE, *signal.names[1:]], dtype=object)[values % OPCODES]


# (kind, part) of a variable: how a signal's values become what the writer takes
_CONVERSIONS: dict[tuple[str, str | None], Callable[[Values, Signal, VcdVar], NDArray[Any]]] = {
    ("wire", None): _wire,
    ("integer", None): lambda values, signal, var: values,
    ("integer", "seq"): lambda values, signal, var: values // OPCODES,
    ("integer", "opcode"): lambda values, signal, var: values % OPCODES,
    ("string", None): _string,
    ("string", "running"): _running,
}
