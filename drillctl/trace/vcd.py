"""The VCD form of a trace, for GTKWave, Surfer and PulseView: wires, columns, positions, states, commands.

Rule: the same trace and layout give the same bytes, without date or path; a value at a tick is that after its
flush. This room knows no machine, so the caller hands in the layout: which variable, in which scope, shows
what of which signal. pyvcd does the writing. Called by `drillctl trace` and replay.

PulseView with libsigrok 0.5.2 (Debian 12) stops reading at the first integer change; it shows a layout of
wires alone in full. GTKWave shows all.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.record import Signal, Trace
from drillctl.trace.target import Target, opened
from drillctl.trace.values import IDLE, OPCODES, WIDEST_BITS, Values, is_word

# Units in us, coarsest first: sigrok expands a file to one sample a unit, so a fine one costs it dearly.
TIMESCALES = ((1000, "1 ms"), (100, "100 us"), (10, "10 us"), (1, "1 us"))
US_PER_SECOND = 10**6
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
            raise ValueError(
                f"{self.scope}.{self.name}: a wire needs a bit, 0..{WIDEST_BITS - 1}, not {self.bit}"
            )
        if not is_word(self.scope) or not is_word(self.name):
            raise ValueError(
                f"{self.scope!r} {self.name!r}: scopes and names are printable words without blanks"
            )


VcdLayout = Sequence[VcdVar]


def write_vcd(trace: Trace, target: Target, layout: VcdLayout) -> None:
    """Writes the trace to a path or an open text file.

    All variables are dumped at time 0, and a last time stamp marks the end, so viewers show the full length.
    The header must have `machine`, `tick_hz` and `digest`, and the sources must have been recorded
    (KeyError). Raises ValueError for a tick rate that is no whole number in 1..10^6, a part of what is no
    command, or a value without a label; OSError as `open`. A refused trace leaves the target alone.
    """
    from vcd import VCDWriter

    comment, clock = _comment(trace), _Clock(_tick_hz(trace))
    ticks, variable, values = _merged([_changes(trace, var) for var in layout])
    times = clock.times(np.append(ticks, trace.end)).tolist()
    with opened(target, "w") as file:
        writer = VCDWriter(file, timescale=clock.timescale, date="", comment=comment)
        variables = [
            writer.register_var(var.scope, var.name, var.kind, SIZES_BITS[var.kind]) for var in layout
        ]
        for time, index, value in zip(times, variable.tolist(), values.tolist(), strict=False):
            writer.change(variables[index], time, value)
        writer.close(times[-1])


class _Clock:
    """Ticks to times: in the largest unit that divides a tick's length, else in us, rounded."""

    def __init__(self, tick_hz: int) -> None:
        exact = (row for row in TIMESCALES if US_PER_SECOND % (tick_hz * row[0]) == 0)
        unit_us, self.timescale = next(exact, TIMESCALES[-1])
        self._ticks_per_time = tick_hz * unit_us  # x 10^-6

    def times(self, ticks: Values) -> Values:
        """Nearest whole times, halves to even as Python's round(); in integers, hence exact."""
        times, rests = np.divmod(ticks * US_PER_SECOND, self._ticks_per_time)
        half = 2 * rests - self._ticks_per_time
        rounded: Values = times + ((half > 0) | ((half == 0) & (times % 2 == 1)))
        return rounded


def _tick_hz(trace: Trace) -> int:
    word = trace.header_value("tick_hz")
    if not (word.isascii() and word.isdecimal() and len(word) < 8 and 1 <= int(word) <= US_PER_SECOND):
        raise ValueError(
            f"the trace's header has tick_hz {word!r}: a whole number in 1..{US_PER_SECOND} is needed"
        )
    return int(word)


def _comment(trace: Trace) -> str:
    """One line of words. Blanks and `$`, which could end the comment, become `_`."""
    pairs = (f"{key}={trace.header_value(key)}" for key in ("machine", "tick_hz", "digest"))
    return " ".join(["drillctl", *(pair.translate({ord(" "): "_", ord("$"): "_"}) for pair in pairs)])


Column = tuple[Values, NDArray[Any]]  # ticks, and what the writer takes at each


def _changes(trace: Trace, var: VcdVar) -> Column:
    """Where the variable changes, and to what."""
    ticks, values = trace.changes_of(var.source)
    signal = trace.signals[trace.index_of(var.source)]
    if var.part and signal.kind != "command":
        raise ValueError(
            f"{var.scope}.{var.name}: signal {var.source} is a {signal.kind}, it has no {var.part}"
        )
    shown = _CONVERSIONS[var.kind, var.part](values, signal, var)
    changes = np.append(True, shown[1:] != shown[:-1])[: len(shown)]
    return ticks[changes], shown[changes]


def _merged(columns: Sequence[Column]) -> tuple[Values, Values, NDArray[Any]]:
    """All changes by tick, then in the layout's order: ticks, indexes into the layout, values."""
    none = np.empty(0, dtype=np.int64)
    ticks = np.concatenate([none, *(column[0] for column in columns)])
    variable = np.repeat(np.arange(len(columns)), [len(column[0]) for column in columns])
    values = np.concatenate([none.astype(object), *(column[1].astype(object) for column in columns)])
    order = np.lexsort((variable, ticks))
    return ticks[order], variable[order], values[order]


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
