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

from collections.abc import Callable, Iterable

from drillctl.generation.order.neighbours import Neighbours
from drillctl.generation.order.travel import Steps, TravelCost

START = 0
FORWARD, BACKWARD = 1, -1
LONGEST_PIECE = 3  # holes that Or-opt moves at once (Or 1976)
UNAFFORDABLE = -(10**15)  # ticks "saved" by keeping END before the start; no path is that long

PairTicks = Callable[[int, int], int]


class Improver:
    """A path through `points` (row 0 is the start), its costs, and the holes still worth looking at."""

    def __init__(self, points: Steps, travel: TravelCost, near: Neighbours, order: Iterable[int]) -> None:
        self.end = len(points)
        self.path = Path([*order, self.end])
        self.ticks = loop_ticks(points, travel)
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
        self._awake.update((hole, None) for hole in holes if hole != self.end)

    def _repair_at(self, a: int) -> int:
        """Make the first repair found at hole a. Ticks saved, 0 if there was none."""
        for side in (FORWARD, BACKWARD):
            b = self.path.order[self.path.place[a] + side]
            taken_out = self.ticks(a, b)
            for c, joined in self._near[a]:
                gain = taken_out - joined
                if gain <= 0:
                    break
                saved = self._two_opt(a, b, c, side, gain) or self._or_opt(a, b, c, side, gain)
                if saved:
                    return saved
        return 0

    def _two_opt(self, a: int, b: int, c: int, side: int, gain: int) -> int:
        """Join a to c and b to d, the hole beside c: what lies between is driven the other way round."""
        place = self.path.place
        d = self.path.order[place[c] + side]
        saved = gain + self.ticks(c, d) - self.ticks(b, d)
        if saved <= 0:
            return 0
        first, last = sorted((place[a], place[c]))
        if side == FORWARD:
            self.path.turn(first + 1, last)
        else:
            self.path.turn(first, last - 1)
        self._wake(a, b, c, d)
        return saved

    def _or_opt(self, a: int, b: int, c: int, side: int, gain: int) -> int:
        """Take out the piece a..e, one to three holes leading away from b; put its end a next to c."""
        order, place, ticks = self.path.order, self.path.place, self.ticks
        for far in range(place[a], place[a] - LONGEST_PIECE * side, -side):
            e = order[far]
            if e == c or e == self.end:
                break
            f = order[far - side]
            freed = gain + ticks(e, f) - ticks(b, f)
            if freed <= 0:
                continue
            for d in (order[place[c] + 1], order[place[c] - 1]):
                saved = freed + ticks(c, d) - ticks(e, d)
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


def loop_ticks(points: Steps, travel: TravelCost) -> PairTicks:
    """Ticks between two rows of `points` or END (number len(points)), one pair at a time.

    Plain lists: for single pairs they are several times quicker than numpy.
    """
    x, y = points[:, 0].tolist(), points[:, 1].tolist()
    ticks_x, ticks_y = travel.ticks_x.tolist(), travel.ticks_y.tolist()
    end = len(points)

    def ticks(one: int, other: int) -> int:
        if one == end or other == end:
            return UNAFFORDABLE if START in (one, other) else 0
        in_x = ticks_x[abs(x[one] - x[other])]
        in_y = ticks_y[abs(y[one] - y[other])]
        return in_x if in_x > in_y else in_y

    return ticks


class Path:
    """`order[position]` is a hole, `place[hole]` its position. The first stays first, the last stays last."""

    def __init__(self, order: list[int]) -> None:
        self.order = list(order)
        self.place = [0] * len(order)
        for position, hole in enumerate(order):
            self.place[hole] = position
        self._turned: list[tuple[int, int]] = []

    def turn(self, first: int, last: int) -> None:
        """Reverse the piece from position `first` to position `last`, both included."""
        piece = self.order[first : last + 1]
        piece.reverse()
        self.order[first : last + 1] = piece
        for position, hole in enumerate(piece, first):
            self.place[hole] = position
        self._turned.append((first, last))

    def swap(self, first: int, middle: int, end: int) -> None:
        """Exchange the pieces first..middle-1 and middle..end-1, each keeping its direction."""
        self.turn(first, end - 1)
        self.turn(first, first + end - middle - 1)
        self.turn(first + end - middle, end - 1)

    def move(self, first: int, last: int, after: int, *, turned: bool) -> None:
        """Put the piece first..last behind position `after`, outside it; `turned`: the other way round."""
        length = last - first + 1
        if after > last:
            self.swap(first, last + 1, after + 1)
            start = after + 1 - length
        else:
            self.swap(after + 1, first, last + 1)
            start = after + 1
        if turned:
            self.turn(start, start + length - 1)

    def keep(self) -> None:
        """What was changed so far is no longer undone by `undo`."""
        self._turned.clear()

    def undo(self) -> None:
        """Take back everything since `keep`."""
        for first, last in reversed(self._turned.copy()):
            self.turn(first, last)
        self.keep()
