"""A variable of a VCD file at work: what it shows of its signal's values, and the line that says so.

Rule: what is shown is a whole number, ``(value >> shift & mask) ^ invert``; only its line is text, formed by pyvcd.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from drillctl.trace.record import Signal
from drillctl.trace.stretches import Changes
from drillctl.trace.values import IDLE, OPCODES, Values
from drillctl.trace.vcd_layout import VcdVar

if TYPE_CHECKING:
    from vcd.writer import Variable as Registered

NOTHING = np.empty(0, np.int64)
ALL_BITS = -1
SEQ_SHIFT = OPCODES.bit_length() - 1
SHIFTS = {"seq": SEQ_SHIFT}
MASKS = {"opcode": OPCODES - 1, "running": OPCODES - 1}


class Variable:
    """A variable of the layout, of the signal at place ``number`` of a run, as pyvcd has registered it.

    words  what each number stands for where the variable is a string; None for a number, or where it can't be listed
    shown  what it shows now
    """

    def __init__(self, var: VcdVar, number: int, signal: Signal) -> None:
        if var.part and signal.kind != "command":
            raise ValueError(f"{var.scope}.{var.name}: signal {var.source} is a {signal.kind}, it has no {var.part}")
        self.var, self.number, self.invert, self.shown = var, number, int(var.invert), 0
        self._signal = signal
        self.words = var.labels or _words(var, signal)
        self.shift, self.mask = SHIFTS.get(var.part or "", 0), MASKS.get(var.part or "", ALL_BITS)
        if var.bit is not None:
            self.shift, self.mask = var.bit, (1 << (var.bits or 1)) - 1

    def register(self, registered: "Registered[Any]") -> None:
        """Takes what pyvcd has made of it."""
        self.registered = registered

    def of(self, values: Values) -> Values:
        """Returns what it shows of its signal's values, (n,)."""
        return (values >> self.shift & self.mask) ^ self.invert

    def begin(self, changes: Changes) -> None:
        """Takes what it shows in tick 0; a signal that has no value there is 0."""
        ticks, values = changes.get(self.number, (NOTHING, NOTHING))
        at_zero = values[:1] if len(ticks) and ticks[0] == 0 else np.zeros(1, np.int64)
        self.shown = int(self.of(at_zero)[0])

    def value(self, shown: int) -> int | str:
        """Returns what pyvcd formats. Raises ValueError for a number that no word stands for."""
        if self.var.kind != "string":
            return shown
        if self.words is None:
            return self._signal.show(shown)
        if not 0 <= shown < len(self.words):
            raise ValueError(
                f"{self.var.scope}.{self.var.name}: signal {self.var.source} has a value without a label"
            )
        return self.words[shown]

    def line(self, shown: int) -> str:
        """Returns the line that says so."""
        return f"{self.registered.format_value(self.value(shown))}\n"


def _words(var: VcdVar, signal: Signal) -> tuple[str, ...] | None:
    if var.part == "running":
        return (IDLE, *signal.names[1:])
    return signal.names if var.kind == "string" and signal.kind == "name" else None
