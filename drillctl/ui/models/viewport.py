"""Which ticks and which signals of a run are on the screen, at what zoom, and where cursor and bar are.

Rule: both values never change; every operation gives another one, within the run.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Zoom(NamedTuple):
    """So many ticks on so many columns; one of the two is 1."""

    ticks: int
    columns: int


# From eight columns a tick, where every number can be read, in steps of 1, 2, 5.
ZOOMS = (
    Zoom(1, 8), Zoom(1, 4), Zoom(1, 2), *(Zoom(digit * 10**power, 1) for power in range(12) for digit in (1, 2, 5)),
)  # fmt: skip
TICK_A_COLUMN = ZOOMS.index(Zoom(1, 1))


@dataclass(frozen=True, slots=True)
class Viewport:
    """Ticks first..last of a run on so many columns. ``left``: the tick of the first column; ``level``: in ZOOMS."""

    first: int = 0
    last: int = -1
    columns: int = 1
    left: int = 0
    cursor: int = 0
    level: int = TICK_A_COLUMN

    @property
    def zoom(self) -> Zoom:
        """How many ticks a column: as the level has it, but never more than the whole run needs."""
        ticks, columns = ZOOMS[self.level]
        return Zoom(min(ticks, max(1, -(-(self.last + 1 - self.first) // self.columns))), columns)

    @property
    def span(self) -> int:
        """How many ticks the columns have room for."""
        return max(1, self.columns * self.zoom.ticks // self.zoom.columns)

    @property
    def shown(self) -> int:
        """How many columns lie within the run; the ones beyond it stay empty."""
        return min(self.columns, max(0, -((self.left - self.last - 1) * self.zoom.columns // self.zoom.ticks)))

    def edges(self) -> NDArray[np.int64]:
        """The ticks between which the shown columns lie, (shown + 1,). Where a tick has several, the first has it."""
        numbers = np.arange(self.shown + 1)
        edges: NDArray[np.int64] = self.left - numbers * self.zoom.ticks // -self.zoom.columns
        return np.minimum(edges, self.last + 1)

    def column_of(self, tick: int) -> int:
        """The column in which a tick begins; it may lie beyond the screen."""
        return (tick - self.left) * self.zoom.columns // self.zoom.ticks

    def tick_at(self, column: int) -> int:
        """The first tick that is seen in a column."""
        return self.left + column * self.zoom.ticks // self.zoom.columns

    def of_run(self, first: int, last: int) -> "Viewport":
        """The viewport of a run that has grown, or has lost its oldest part."""
        return replace(self, first=first, last=last)._within()

    def sized(self, columns: int) -> "Viewport":
        """The viewport in another width; the left edge stays where it can."""
        return replace(self, columns=max(1, columns))._within()

    def go(self, tick: int) -> "Viewport":
        """The cursor at a tick; what is shown moves along only where it must, and then the tick comes to the middle."""
        there = replace(self, cursor=tick)._within()
        if 0 <= there.column_of(there.cursor) < there.columns:
            return there
        return replace(there, left=there.cursor - there.span // 2)._within()

    def step(self, columns: int) -> "Viewport":
        """The cursor moved by so many columns, at least by a tick."""
        return self.go(self.cursor + columns * max(1, self.zoom.ticks))

    def pan(self, by: int) -> "Viewport":
        """Cursor and left edge moved by half a screen; negative ``by`` moves to the left."""
        half = by * max(1, self.span // 2)
        return replace(self, left=self.left + half, cursor=self.cursor + half)._within()

    def zoomed(self, by: int) -> "Viewport":
        """Closer for negative ``by``, as far as eight columns a tick or the whole run; the cursor keeps its column."""
        level = min(max(self.level + by, 0), self._widest())
        column = min(max(self.column_of(self.cursor), 0), self.columns - 1)
        other = replace(self, level=level)
        return replace(other, left=self.cursor - column * other.zoom.ticks // other.zoom.columns)._within()

    def whole(self) -> "Viewport":
        """The viewport that shows the whole run."""
        return replace(self, level=self._widest(), left=self.first)._within()

    def _widest(self) -> int:
        """The closest level that shows the whole run."""
        ticks = self.last + 1 - self.first
        fits = (level for level, zoom in enumerate(ZOOMS) if self.columns * zoom.ticks >= ticks * zoom.columns)
        return next(fits, len(ZOOMS) - 1)

    def _within(self) -> "Viewport":
        """Cursor and left edge moved back into the run."""
        last = max(self.first, self.last)
        left = max(self.first, min(self.left, last + 1 - self.span))
        return replace(self, left=left, cursor=max(self.first, min(self.cursor, last)))


@dataclass(frozen=True, slots=True)
class SignalRows:
    """Rows 0..count-1, less those ``hidden``; the bar is ``at`` one that is shown. One row always stays.

    heights  the lines of those rows that have more than one
    """

    count: int
    hidden: frozenset[int] = frozenset()
    at: int = 0
    heights: Mapping[int, int] = field(default_factory=dict)

    @property
    def shown(self) -> list[int]:
        """The rows that are not hidden, from top to bottom."""
        return [row for row in range(self.count) if row not in self.hidden]

    def move(self, by: int) -> "SignalRows":
        """The bar moved over the rows that are shown; it stops at the ends."""
        shown = self.shown
        if not shown:
            return self
        return replace(self, at=shown[max(0, min(shown.index(self.at) + by, len(shown) - 1))])

    def hide(self) -> "SignalRows":
        """The row under the bar hidden; the bar goes to the row below, at the end to the one above."""
        if len(self.shown) < 2:
            return self
        below = self.move(1)
        next_at = below.at if below.at != self.at else self.move(-1).at
        return replace(self, hidden=self.hidden | {self.at}, at=next_at)

    def only(self, rows: Iterable[int]) -> "SignalRows":
        """All rows hidden but these and the one under the bar."""
        return replace(self, hidden=frozenset(range(self.count)) - {*rows, self.at})

    def all(self) -> "SignalRows":
        """The same rows with every hidden one shown again."""
        return replace(self, hidden=frozenset())

    def with_heights(self, heights: Mapping[int, int]) -> "SignalRows":
        """The rows with other heights, in place of those they had."""
        return replace(self, heights=dict(heights))

    def put(self, line: int, room: int) -> "SignalRows":
        """The bar on a line of the window of ``room`` lines; a line without a row changes nothing."""
        window = self.window(room)
        return replace(self, at=window[line][0]) if 0 <= line < len(window) else self

    def window(self, room: int) -> list[tuple[int, int]]:
        """The lines that are drawn, as (row, line of the row from 0): as many as there is room for, the bar in the
        middle where it can be.
        """
        lines = [(row, part) for row in self.shown for part in range(self.heights.get(row, 1))]
        place = lines.index((self.at, 0)) if lines else 0
        top = max(0, min(place - room // 2, len(lines) - room))
        return lines[top : top + room]
