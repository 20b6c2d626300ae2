"""The VCD form of a trace, for GTKWave, Surfer and PulseView: wires, columns, positions, states, commands.

Rule: the same trace and layout give the same bytes, without date or path; a value at a tick is that after its
flush. This room knows no machine, so the caller hands in the layout: which variable, in which scope, shows
what of which signal. pyvcd writes the head and forms the values; the changes are put together by vcd_compiled.py, or
a page at a time by vcd_pages.py.

A value of the signal `pace` is the tick rate that holds from the tick after (docs/SPEC.md, 1.20).

PulseView with libsigrok 0.5.2 (Debian 12) stops reading at the first integer change; it shows a layout of
wires alone in full. GTKWave shows all.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, TextIO

import numpy as np

from drillctl.trace.record import Signal, Trace
from drillctl.trace.stretches import Changes, by_signal, stretches
from drillctl.trace.target import Target, opened
from drillctl.trace.values import Values
from drillctl.trace.vcd_compiled import ChangeWriter, change_writer
from drillctl.trace.vcd_layout import VcdLayout
from drillctl.trace.vcd_variables import Variable

if TYPE_CHECKING:
    from vcd import VCDWriter

# Units in us, coarsest first: sigrok expands a file to one sample a unit, so a fine one costs it dearly.
TIMESCALES = ((1000, "1 ms"), (100, "100 us"), (10, "10 us"), (1, "1 us"))
US_PER_SECOND = 10**6
SIZES_BITS = {"wire": 1, "integer": 32, "string": 1}


def write_vcd(trace: Trace, target: Target, layout: VcdLayout) -> None:
    """Writes the trace to a path or an open text file.

    All variables are dumped at time 0, and a last time stamp marks the end, so viewers show the full length. The header
    must have `machine`, `tick_hz` and `digest`, and the sources must have been recorded (KeyError). Raises ValueError
    for a tick rate that is no whole number in 1..10^6, a part of a signal that is no command, or a value without a
    label; OSError as `open`. A refused trace leaves the target alone.
    """
    names = {signal.name: number for number, signal in enumerate(trace.signals)}
    for var in layout:
        if var.labels is not None:
            variable = Variable(var, names[var.source], trace.signals[names[var.source]])
            for shown in np.unique(trace.changes_of(var.source)[1]).tolist():
                variable.value(shown)
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
    variables = [Variable(var, numbers[var.source], signals[numbers[var.source]]) for var in layout]
    with opened(target, "w") as file:
        head = VCDWriter(file, timescale=clock.timescale, date="", comment=comment)
        for variable in variables:
            var = variable.var
            variable.register(head.register_var(var.scope, var.name, var.kind, SIZES_BITS[var.kind]))
        writer = None
        for changes in run:
            writer = writer or _begun(file, head, clock, variables, changes)
            writer.write(changes)
        head.flush()
        end_time = int(clock.times(np.array([frame.end]))[0])
        if end_time != (0 if writer is None else writer.time):
            file.write(f"#{end_time}\n")


def _begun(
    file: TextIO, head: "VCDWriter", clock: "_Clock", variables: Sequence[Variable], changes: Changes
) -> ChangeWriter:
    """Writes what every variable shows at time 0, and returns what writes the changes after it."""
    for variable in variables:
        variable.begin(changes)
        head.change(variable.registered, 0, variable.value(variable.shown))
    head.flush()
    return change_writer(file, clock.times, variables)


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
    if not begun and unit == 1:
        return ticks * per_unit.denominator
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
