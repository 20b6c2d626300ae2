"""Shortening a path by small repairs, 2-opt and Or-opt, until no hole that was touched shows another.

Rule: a repair is made only if it saves ticks, so the path never gets longer, and the search ends.
Each repair takes out the way between a hole `a` and the hole `b` beside it and joins `a` to a near hole `c`
instead; only neighbours nearer than b can save anything (Lin and Kernighan's gain criterion, 1973).
Holes around which nothing can be saved sleep until a repair touches them (Bentley's "don't-look bits",
1992). `optimise` is the caller.

The path is treated as a loop: behind the last hole stands END, which is the place the machine goes to afterwards, or
costs nothing to reach; from END back to the start the loop is closed by a way that no repair can afford to take out.
Position -1 is END's, so "the hole before the start" needs no case of its own.

Where there are several tools, a way from one tool's hole to another's costs CHANGE more for each tool that it goes
on or back. A path that takes the tools in their order has the fewest such changes, so no repair that saves ticks
mixes them, and the holes at which a tool ends and the next begins are chosen like any others.
"""

from __future__ import annotations

from collections.abc import Iterable

from drillctl.generation.order.budget import Budget
from drillctl.generation.order.loop import loop_rows
from drillctl.generation.order.neighbours import Near
from drillctl.generation.order.path import Path
from drillctl.generation.order.stops import Stops
from drillctl.generation.order.travel import TravelCost

FORWARD, BACKWARD = 1, -1
LONGEST_PIECE = 8  # holes that Or-opt moves at once (Or 1976 has 3)


class Improver:
    """A path through `stops` (row 0 is the start), its costs, and the holes still worth looking at."""

    def __init__(self, stops: Stops, travel: TravelCost, near: list[list[Near]], order: Iterable[int]) -> None:
        self.end = len(stops.points)
        self.path = Path([*order, self.end])
        self.rows = loop_rows(stops, travel)
        self._near = near
        self._awake: dict[int, None] = {}  # a set that remembers in which order it was filled

    def settle(self, holes: Iterable[int], budget: Budget | None = None) -> int:
        """Repair around `holes`, and around whatever that touches, until nothing helps or the budget, a step for each
        hole looked at, is spent. Ticks saved.
        """
        self._wake(*holes)
        total = 0
        while self._awake and (budget is None or budget.allows()):
            hole, _ = self._awake.popitem()
            while saved := self._repair_at(hole):
                total += saved
        self._awake.clear()
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
        """Take out the piece a..e, up to LONGEST_PIECE holes leading away from b; put its end a next to c."""
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
