"""The changes of VCD variables as text by the compiled loop of vcd_lines.py, where it was built.

Rule: the same bytes as vcd_pages.py. A variable whose words can't be listed (a count as a string) is written there.
"""

from collections.abc import Sequence
from itertools import accumulate, chain
from types import ModuleType
from typing import Protocol, TextIO

import numpy as np

from drillctl.files.compiled import compiled_form
from drillctl.trace import vcd_lines
from drillctl.trace.stretches import Changes
from drillctl.trace.values import WIDEST_BITS, Values
from drillctl.trace.vcd_lines import FULL, NO_TEXT, NUMBER_BYTES, STAMP_BYTES, TIME, WHICH, WHY
from drillctl.trace.vcd_pages import PAGE_TICKS, PageWriter, Times
from drillctl.trace.vcd_variables import NOTHING, Variable

OUT_BYTES = 1 << 20
BITS = ("0", "1")
NUMBER_MASK = (1 << WIDEST_BITS) - 1


class ChangeWriter(Protocol):
    """Writes the changes of a run to a file, stretch after stretch; ``time`` is that of its last time stamp."""

    time: int

    def write(self, changes: Changes) -> None:
        """Writes the changes of all variables; their ticks are later than all those written before."""


def change_writer(file: TextIO, times: Times, variables: Sequence[Variable]) -> ChangeWriter:
    """Returns what writes the changes of these variables, which begin with what they show now, the quickest."""
    loop = compiled_form(vcd_lines)
    if loop is None or not variables or any(each.words is None for each in variables if each.var.kind == "string"):
        return PageWriter(file, times, variables)
    return LineWriter(file, times, variables, loop)


class LineWriter:
    """Writes changes to an open file by ``loop``, which is vcd_lines, compiled or not."""

    def __init__(self, file: TextIO, times: Times, variables: Sequence[Variable], loop: ModuleType) -> None:
        self._file, self._times, self._variables, self._loop = file, times, variables, loop
        self._signals = sorted({variable.number for variable in variables})
        self._coming, self._present, self._changed = np.zeros((3, len(self._signals)), np.int64)
        self._shown = np.array([each.shown & self._mask(each) for each in variables], np.int64)
        texts = [_texts(variable) for variable in variables]
        firsts = accumulate(map(len, texts), initial=0)
        rows = [self._row(*each) for each in zip(variables, firsts, texts)]  # noqa: B905  firsts has the end too
        self._rows = np.array(rows, np.int64).ravel()
        self._texts = np.frombuffer(b"".join(chain(*texts)), np.uint8)
        self._begins = np.array([*accumulate(map(len, chain(*texts)), initial=0)], np.int64)
        self._room = STAMP_BYTES + sum(NUMBER_BYTES + max(map(len, each)) for each in texts)
        self._out = np.empty(OUT_BYTES + self._room, np.uint8)
        self._state = np.zeros(3, np.int64)
        self.time = 0

    def write(self, changes: Changes) -> None:
        """Writes the changes of all variables; their ticks are later than all those written before."""
        parts = [changes.get(signal, (NOTHING, NOTHING)) for signal in self._signals]
        ticks, values = (np.concatenate([NOTHING, *each]) for each in zip(*parts, strict=True))
        ends = np.cumsum([len(each) for each, _ in parts])
        at = ends - [len(each) for each, _ in parts]
        while len(left := ticks[at[at < ends]]):
            self._page(ticks, values, at, ends, int(left.min()))
        self.time = int(self._state[TIME])

    def _page(self, ticks: Values, values: Values, at: Values, ends: Values, first: int) -> None:
        """Writes what changes in the PAGE_TICKS from ``first`` on."""
        times = self._times(first + np.arange(PAGE_TICKS))
        self._state[WHY] = FULL
        while self._state[WHY] == FULL:
            used = self._loop.lines(
                ticks, values, at, ends, self._coming, self._present, self._changed, self._rows, self._shown,
                self._texts, self._begins, first, times, self._out, self._room, self._state,
            )  # fmt: skip
            self._file.write(self._out[:used].tobytes().decode())
        if self._state[WHY] == NO_TEXT:
            which = int(self._state[WHICH])
            self._variables[which].value(int(self._shown[which]))

    def _row(self, variable: Variable, first: int, texts: Sequence[bytes]) -> list[int]:
        source = self._signals.index(variable.number)
        count = 0 if variable.var.kind == "integer" else len(texts)
        mask = self._mask(variable)
        return [source, variable.shift, mask, variable.invert, first, count, mask << variable.shift]

    @staticmethod
    def _mask(variable: Variable) -> int:
        """Returns the bits that count: of a number 32, the sign among them."""
        return variable.mask & NUMBER_MASK if variable.var.kind == "integer" else variable.mask


def _texts(variable: Variable) -> list[bytes]:
    """Returns the lines of all that a variable may show; of a number what stands behind it."""
    if variable.var.kind == "integer":
        return [variable.line(0).removeprefix("b0").encode()]
    count = len(variable.words) if variable.words is not None else len(BITS)
    return [variable.line(shown).encode() for shown in range(count)]
