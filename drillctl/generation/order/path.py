"""A path that is changed piece by piece, and taken back to what it last was.

Rule: only the stretch that was changed is copied, so a change at one end of a long path costs nothing at the other.
"""

from __future__ import annotations


class Path:
    """`order[position]` is a hole, `place[hole]` its position. The first stays first, the last stays last."""

    def __init__(self, order: list[int]) -> None:
        self.order = list(order)
        self.place = [0] * len(order)
        for position, hole in enumerate(order):
            self.place[hole] = position
        self._kept = list(order)
        self._low, self._high = len(order), 0  # positions changed since `keep`: from the one up to the other

    def turn(self, first: int, last: int) -> None:
        """Reverse the piece from position `first` to position `last`, both included."""
        piece = self.order[first : last + 1]
        piece.reverse()
        self._put(first, piece)

    def swap(self, first: int, middle: int, end: int) -> None:
        """Exchange the pieces first..middle-1 and middle..end-1, each keeping its direction."""
        self._put(first, self.order[middle:end] + self.order[first:middle])

    def move(self, first: int, last: int, after: int, *, turned: bool) -> None:
        """Put the piece first..last behind position `after`, outside it; `turned`: the other way round."""
        piece = self.order[first : last + 1]
        if turned:
            piece.reverse()
        if after > last:
            self._put(first, self.order[last + 1 : after + 1] + piece)
        else:
            self._put(after + 1, piece + self.order[after + 1 : first])

    def keep(self) -> None:
        """What was changed so far is no longer undone by `undo`."""
        self._kept[self._low : self._high] = self.order[self._low : self._high]
        self._low, self._high = len(self.order), 0

    def undo(self) -> None:
        """Take back everything since `keep`."""
        if self._low < self._high:
            self._put(self._low, self._kept[self._low : self._high])
            self._low, self._high = len(self.order), 0

    def _put(self, first: int, piece: list[int]) -> None:
        order, place, position = self.order, self.place, first
        order[first : first + len(piece)] = piece
        for hole in piece:
            place[hole] = position
            position += 1
        self._low, self._high = min(self._low, first), max(self._high, position)
