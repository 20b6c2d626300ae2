"""Shortening a path by small repairs, 2-opt and Or-opt, until no hole that was touched shows another.

Rule: a repair is made only if it saves ticks, so the path never gets longer, and the search ends.
Each repair takes out the way between a hole `a` and the hole `b` beside it and joins `a` to a near hole `c`
instead; only neighbours nearer than b can save anything (Lin and Kernighan's gain criterion, 1973).
Holes around which nothing can be saved sleep until a repair touches them (Bentley's "don't-look bits",
1992). `optimise` is the caller.

The path is treated as a loop: behind the last hole stands END, which every hole reaches for nothing, so
the end is free; from END back to the start the loop is closed by a way that no repair can afford to take out.
Position -1 is END's, so "the hole before the start" needs no case of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from drillctl.generation.order.neighbours import Neighbours
from drillctl.generation.order.path import Path
from drillctl.generation.order.travel import Steps, TravelCost

START = 0
FORWARD, BACKWARD = 1, -1
LONGEST_PIECE = 3  # holes that Or-opt moves at once (Or 1976)
UNAFFORDABLE = -(10**15)  # ticks "saved" by keeping END before the start; no path is that long

MATRIX_HOLES = 700  # up to so many all pairs are worked out beforehand: half a million numbers

Row = Sequence[int]  # of one hole: the ticks to each


class Improver:
    """A path through `points` (row 0 is the start), its costs, and the holes still worth looking at."""

    def __init__(self, points: Steps, travel: TravelCost, near: Neighbours, order: Iterable[int]) -> None:
        self.end = len(points)
        self.path = Path([*order, self.end])
        self.rows = loop_rows(points, travel)
        self._near = [
            list(zip(holes, ticks, strict=True))
            for holes, ticks in zip(near.index.tolist(), near.ticks.tolist(), strict=True)
        ]
        self._awake: dict[int, None] = {}  # a set that remembers in which order it was filled

    def settle(self, holes: Iterable[int]) -> int:
        """Repair around `holes`, and around whatever that touches, until nothing helps. Ticks saved."""
        self._wake(*holes)
        total = 0
        while self._awake:
            hole, _ = self._awake.popitem()
            while saved := self._repair_at(hole):
                total += saved
        return total

    def _wake(self, *holes: int) -> None:
        for hole in holes:
            if hole != self.end:
                self._awake[hole] = None

    def _repair_at(self, a: int) -> int:
        """Make the first repair found at hole a. Ticks saved, 0 if there was none."""
        order, place, rows = self.path.order, self.path.place, self.rows
        for side in (FORWARD, BACKWARD):
            b = order[place[a] + side]
            from_b, taken_out = rows[b], rows[a][b]
            for c, joined in self._near[a]:
                gain = taken_out - joined
                if gain <= 0:
                    break
                d = order[place[c] + side]
                saved = gain + rows[c][d] - from_b[d]
                if saved > 0:
                    self._two_opt(a, b, c, d, side)
                    return saved
                if saved := self._or_opt(a, b, c, side, gain):
                    return saved
        return 0

    def _two_opt(self, a: int, b: int, c: int, d: int, side: int) -> None:
        """Join a to c and b to d, the hole beside c: what lies between is driven the other way round."""
        place = self.path.place
        first, last = sorted((place[a], place[c]))
        if side == FORWARD:
            self.path.turn(first + 1, last)
        else:
            self.path.turn(first, last - 1)
        self._wake(a, b, c, d)

    def _or_opt(self, a: int, b: int, c: int, side: int, gain: int) -> int:
        """Take out the piece a..e, one to three holes leading away from b; put its end a next to c."""
        order, place, rows = self.path.order, self.path.place, self.rows
        far, beside_c, from_b = place[a], place[c], rows[b]
        for _ in range(LONGEST_PIECE):
            e = order[far]
            if e == c or e == self.end:
                break
            far -= side
            f = order[far]
            freed = gain + rows[e][f] - from_b[f]
            if freed <= 0:
                continue
            for d in (order[beside_c + 1], order[beside_c - 1]):
                saved = freed + rows[c][d] - rows[e][d]
                if saved > 0 and d != e:
                    self._move_piece(a, e, c, d)
                    self._wake(a, b, c, d, e, f)
                    return saved
        return 0

    def _move_piece(self, a: int, e: int, c: int, d: int) -> None:
        """Put the piece between a and e into the gap between c and d, so that a is next to c."""
        place = self.path.place
        first, last = sorted((place[a], place[e]))
        a_leads, c_leads = place[a] <= place[e], place[c] < place[d]
        self.path.move(first, last, min(place[c], place[d]), turned=a_leads != c_leads)


def loop_rows(points: Steps, travel: TravelCost) -> Sequence[Row]:
    """`rows[one][other]`: ticks between two rows of `points` or END (number len(points)), as plain numbers.

    For single pairs plain lists are several times quicker than numpy.
    """
    end = len(points)
    if end > MATRIX_HOLES:
        return _rows_by_axis(points, travel)
    ticks = np.zeros((end + 1, end + 1), np.int64)
    ticks[:end, :end] = travel.between(points[:, None], points[None])
    ticks[START, end] = ticks[end, START] = UNAFFORDABLE
    rows: list[list[int]] = ticks.tolist()
    return rows


def _rows_by_axis(points: Steps, travel: TravelCost) -> Sequence[Row]:
    x, y = points[:, 0].tolist(), points[:, 1].tolist()
    tables = travel.ticks_x.tolist(), travel.ticks_y.tolist()
    to_end = [UNAFFORDABLE, *[0] * (len(points) - 1)]
    return [*(PairByPair(here, x, y, *tables, free) for *here, free in zip(x, y, to_end, strict=True)), [*to_end, 0]]


class PairByPair(Sequence[int]):
    """The ticks from the hole `here` (x, y) to each, worked out when they are asked for; `to_end` to END."""

    __slots__ = ("_end", "_here_x", "_here_y", "_ticks_x", "_ticks_y", "_to_end", "_x", "_y")

    def __init__(
        self, here: list[int], x: list[int], y: list[int], ticks_x: list[int], ticks_y: list[int], to_end: int
    ) -> None:
        (self._here_x, self._here_y), self._x, self._y = here, x, y
        self._ticks_x, self._ticks_y, self._end, self._to_end = ticks_x, ticks_y, len(x), to_end

    def __len__(self) -> int:
        """All holes and END."""
        return self._end + 1

    def __getitem__(self, other: int) -> int:  # type: ignore[override]  # never asked for a slice
        """Ticks to one of them."""
        if other == self._end:
            return self._to_end
        in_x = self._ticks_x[abs(self._here_x - self._x[other])]
        in_y = self._ticks_y[abs(self._here_y - self._y[other])]
        return in_x if in_x > in_y else in_y
