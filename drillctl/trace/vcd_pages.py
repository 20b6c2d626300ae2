"""The changes of many VCD variables as text: by time, and within a time in the variables' order.

Rule: a page is a table with a row for each tick in which something changes, two columns for the time stamp and one for
each variable. Read row by row it is the text, so nothing has to be sorted, and no line is formatted twice. A time is
put together of its last digits and those before them, as formatting each by itself would take most of the time.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from drillctl.trace.stretches import Changes, last_of_tick
from drillctl.trace.values import Values
from drillctl.trace.vcd_variables import NOTHING, Variable

PAGE_TICKS = 1 << 16
LINES_REMEMBERED = 1 << 16  # of each variable
EMPTY = -1
TAIL = 10_000  # a time's last digits: its rest by this
TAILS = tuple(f"{rest:04}\n" for rest in range(TAIL))

Column = tuple[Values, Values]  # rising ticks, and what a variable shows from each on
Times = Callable[[Values], Values]  # from rising ticks (n,) to the times of the file


class PageWriter:
    """Writes the changes of variables to an open file."""

    def __init__(self, file: TextIO, times: Times, variables: Sequence[Variable]) -> None:
        self._file, self._times, self._variables = file, times, variables
        self._lines = [lru_cache(LINES_REMEMBERED)(variable.line) for variable in variables]
        self.time = 0  # of the last time stamp

    def write(self, changes: Changes) -> None:
        """Writes the changes of all variables; their ticks are later than all those written before."""
        columns = [_news(variable, changes) for variable in self._variables]
        while any(len(ticks) for ticks, _ in columns):
            first = min(int(ticks[0]) for ticks, _ in columns if len(ticks))
            cuts = [int(np.searchsorted(ticks, first + PAGE_TICKS)) for ticks, _ in columns]
            page = [(ticks[:cut] - first, shown[:cut]) for (ticks, shown), cut in zip(columns, cuts, strict=True)]
            self._file.write(self._page(first, page))
            columns = [(ticks[cut:], shown[cut:]) for (ticks, shown), cut in zip(columns, cuts, strict=True)]

    def _page(self, first: int, columns: Sequence[Column]) -> str:
        touched = np.zeros(PAGE_TICKS, bool)
        for ticks, _ in columns:
            touched[ticks] = True
        row = np.cumsum(touched) - 1
        cells = np.full((row[-1] + 1, 2 + len(columns)), EMPTY, np.int32)
        lines = self._stamp(first + np.flatnonzero(touched), cells)
        for number, (ticks, shown) in enumerate(columns):
            distinct, where = _distinct(shown)
            cells[row[ticks], 2 + number] = where + len(lines)
            lines += map(self._lines[number], distinct)
        return "".join(np.array(lines, object)[cells[cells != EMPTY]].tolist())

    def _stamp(self, ticks: Values, cells: NDArray[np.int32]) -> list[str]:
        """Puts the time stamps of the ticks (n,) into ``cells`` (n, 2 or more), but where the time is that of the tick
        before; returns the texts that the cells mean.
        """
        times = self._times(ticks)
        news = np.diff(times, prepend=self.time) != 0
        self.time = int(times[-1])
        heads, where = _distinct(times // TAIL)
        cells[news, 0] = where[news] + TAIL
        cells[news, 1] = times[news] % TAIL
        texts = [*TAILS, *(f"#{head}" for head in heads)]
        if heads[0] == 0:  # no zeros stand before a short time
            short = np.flatnonzero(times < TAIL)
            cells[short, 0] = np.where(news[short], len(texts) + np.arange(len(short)), EMPTY)
            cells[short, 1] = EMPTY
            texts += [f"#{time}\n" for time in times[short].tolist()]
        return texts


def _news(variable: Variable, changes: Changes) -> Column:
    """Returns where a variable changes in a stretch, and what it shows then."""
    ticks, values = last_of_tick(*changes.get(variable.number, (NOTHING, NOTHING)))
    shown = variable.of(values)
    news = np.append(variable.shown, shown)[:-1] != shown
    variable.shown = int(shown[-1]) if len(shown) else variable.shown
    return ticks[news], shown[news]


def _distinct(values: Values) -> tuple[list[int], NDArray[np.intp]]:
    """Returns the different values, and the index among them of each value (n,)."""
    if len(values):
        low = int(values.min())
        span = int(values.max()) - low + 1
        if span <= PAGE_TICKS:  # counting them takes no sorting
            present = np.zeros(span, bool)
            present[values - low] = True
            return (np.flatnonzero(present) + low).tolist(), (np.cumsum(present) - 1)[values - low]
    distinct, where = np.unique(values, return_inverse=True)
    return distinct.tolist(), where
