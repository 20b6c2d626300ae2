"""An order under repair: a list of holes in which pieces can be turned round, and turned back again.

Rule: turning a piece round is the only change there is. Moving a piece elsewhere is three turns, and
undoing is the same turns in opposite order. `improve` and `optimise` are its only users.
"""

from __future__ import annotations


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
