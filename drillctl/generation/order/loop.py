"""What each way costs in the loop that `improve` repairs: between two stops, to END, and from one tool to another.

Rule: costs are the same both ways. Small boards have all pairs beforehand, large ones work them out when asked:
for single pairs plain lists are several times quicker than numpy.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.order.stops import Stops
from drillctl.generation.order.travel import Ticks, TravelCost

START = 0
UNAFFORDABLE = -(10**15)  # ticks "saved" by keeping END before the start; no path is that long
CHANGE = 10**10  # ticks more for each tool between two stops; no path is that long, and no file has 100,000 tools

MATRIX_HOLES = 700  # up to so many all pairs are worked out beforehand: half a million numbers

Row = Sequence[int]  # of one stop: the ticks to each, and at last to END


def loop_rows(stops: Stops, travel: TravelCost) -> Sequence[Row]:
    """`rows[one][other]`: ticks between two rows of `stops` or END (number len(points)), as plain numbers."""
    end = len(stops.points)
    return _matrix(stops, travel) if end <= MATRIX_HOLES else rows_by_pair(stops, travel)


def _matrix(stops: Stops, travel: TravelCost) -> list[list[int]]:
    points, end = stops.points, len(stops.points)
    ticks = np.zeros((end + 1, end + 1), np.int64)
    ticks[:end, :end] = travel.between(points[:, None], points[None])
    ticks[:end, :end] += _changes(stops)
    ticks[:end, end] = ticks[end, :end] = _to_end(stops, travel)
    rows: list[list[int]] = ticks.tolist()
    return rows


def rows_by_pair(stops: Stops, travel: TravelCost) -> Sequence[Row]:
    """The same, each pair worked out when it is asked for."""
    x, y = stops.points[:, 0].tolist(), stops.points[:, 1].tolist()
    tables = travel.ticks_x.tolist(), travel.ticks_y.tolist()
    to_end = _to_end(stops, travel).tolist()
    rows: list[Row] = [PairByPair(here, x, y, *tables, free) for *here, free in zip(x, y, to_end, strict=True)]
    tools = _tool_numbers(stops).tolist()
    if tools[-1]:
        rows = [WithChanges(row, number, tools) for row, number in zip(rows, tools, strict=True)]
    return [*rows, [*to_end, 0]]


def _tool_numbers(stops: Stops) -> NDArray[np.int64]:
    """(n + 1,): of each stop, which tool it has, from 0 without those that have no hole; the start has the first."""
    first, *others = map(len, stops.tools)
    return np.repeat(np.arange(1 + len(others)), [1 + first, *others])


def _changes(stops: Stops) -> Ticks:
    number = _tool_numbers(stops)
    return CHANGE * np.abs(number[:, None] - number[None])


def _to_end(stops: Stops, travel: TravelCost) -> Ticks:
    """(n + 1,): to where the machine goes afterwards, which only the last tool may do without a change."""
    number = _tool_numbers(stops)
    ticks = CHANGE * (number[-1] - number)
    if stops.end is not None:
        ticks += travel.between(stops.points, stops.end)
    ticks[START] = UNAFFORDABLE
    return ticks


class WithChanges(Sequence[int]):
    """A row of ticks with what changes of the tool cost: `tool` has the stop itself, `tools` each of them."""

    __slots__ = ("_row", "_tool", "_tools")

    def __init__(self, row: Row, tool: int, tools: list[int]) -> None:
        self._row, self._tool, self._tools = row, tool, tools

    def __len__(self) -> int:
        """How many places it has: all stops and END."""
        return len(self._row)

    def __getitem__(self, other: int) -> int:  # type: ignore[override]  # never asked for a slice
        """Ticks to one of them."""
        ticks = self._row[other]
        if other < len(self._tools) and (tool := self._tools[other]) != self._tool:
            return ticks + CHANGE * abs(tool - self._tool)
        return ticks


class PairByPair(Sequence[int]):
    """The ticks from the hole `here` (x, y) to each, worked out when they are asked for; `to_end` to END."""

    __slots__ = ("_end", "_here_x", "_here_y", "_ticks_x", "_ticks_y", "_to_end", "_x", "_y")

    def __init__(
        self, here: list[int], x: list[int], y: list[int], ticks_x: list[int], ticks_y: list[int], to_end: int
    ) -> None:
        (self._here_x, self._here_y), self._x, self._y = here, x, y
        self._ticks_x, self._ticks_y, self._end, self._to_end = ticks_x, ticks_y, len(x), to_end

    def __len__(self) -> int:
        """How many places it has: all holes and END."""
        return self._end + 1

    def __getitem__(self, other: int) -> int:  # type: ignore[override]  # never asked for a slice
        """Ticks to one of them."""
        if other == self._end:
            return self._to_end
        in_x = self._ticks_x[abs(self._here_x - self._x[other])]
        in_y = self._ticks_y[abs(self._here_y - self._y[other])]
        return in_x if in_x > in_y else in_y
