"""Puts a program into the queue as room is made, as far as it has been released.

Rule: never waits, never loses a record. Without a journal everything is released at once; with one, hole by hole.
Called by desk and replay.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import CommandQueue, Op


class Feeder:
    """A program on its way down. ``put`` counts the records handed over, ``holes`` those that it drills."""

    def __init__(self, program: NDArray[np.void], queue: CommandQueue):
        self.program = program
        self.queue = queue
        self.put = 0
        self.released_holes = 0
        self._ends = _hole_ends(program)
        self._limit = len(program)

    @property
    def holes(self) -> int:
        """How often the program drills a hole that has a number."""
        return len(self._ends)

    def hold_back(self) -> None:
        """Nothing goes before it is released."""
        self._limit = self.put

    def release(self, holes: int) -> None:
        """So many holes may be drilled, with all that stands before each; after the last one the rest too."""
        self.released_holes = holes
        self._limit = len(self.program) if holes >= self.holes else int(self._ends[holes - 1])

    def feed(self) -> None:
        """Hands over as much of what is released as the queue takes."""
        self.put += self.queue.put(self.program[self.put : self._limit][: self.queue.room])


def _hole_ends(program: NDArray[np.void]) -> NDArray[np.intp]:
    """For each stroke down that drills a numbered hole, in order: the index behind the stroke up that follows."""
    ups = np.flatnonzero(program["opcode"] == Op.WIERTLO_GORA)
    downs = np.flatnonzero((program["opcode"] == Op.WIERTLO_DOL) & (program["tag"] > 0))
    return ups[np.searchsorted(ups, downs)] + 1 if len(downs) else np.zeros(0, np.intp)
