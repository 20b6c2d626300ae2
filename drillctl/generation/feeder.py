"""Puts a program into the queue as room is made, as far as it has been released.

Rule: never waits, never loses a record. Without a journal everything is released at once; with one, hole by hole.
Where the operator changes the tools, each change is a gate that opens when it has been made.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.generation import sequences
from drillctl.kmd import CommandQueue


class Feeder:
    """A program on its way down. ``put`` counts the records handed over."""

    def __init__(self, program: NDArray[np.void], queue: CommandQueue):
        self.program = program
        self.queue = queue
        self.put = 0
        self.released_holes = 0
        self._begins, self._ends = sequences.holes(program)
        self._limit = len(program)
        self._gates: list[int] = []
        self._barriers: list[int] = []

    @property
    def holes(self) -> int:
        """How often the program drills a hole that has a number."""
        return len(self._ends)

    def hold_back(self) -> None:
        """No hole is drilled before it is released."""
        self.release(0)

    def release(self, holes: int) -> None:
        """So many holes may be drilled, with all that stands before each, and the way to the next; after the last
        the rest too.
        """
        self.released_holes = holes
        self._limit = int(self._begins[holes]) if holes < self.holes else len(self.program)

    def holes_ended(self, done: int) -> int:
        """How many holes are drilled, with the head up again, once so many commands of the program are done."""
        return int(np.searchsorted(self._ends, done, side="right"))

    def gate_tools(self) -> None:
        """Nothing passes a tool change before it is opened."""
        self._gates = sequences.asked_changes(self.program).tolist()

    def awaited_tool(self) -> int | None:
        """The tool at whose closed gate the program stands, or None."""
        if not self._gates or self.put < self._gates[0]:
            return None
        return int(self.program["args"][self._gates[0], 0])

    def gated(self, hole: int) -> bool:
        """Whether a tool is to be changed before the program's hole of this number, from 1, can be drilled."""
        return bool(self._gates) and self._gates[0] < self._begins[hole - 1]

    def open_gate(self) -> None:
        """The tool has been changed."""
        self._gates.pop(0)

    def stop_before(self, rows: list[int]) -> None:
        """Nothing passes these commands, by index, before each is let through."""
        self._barriers = rows

    @property
    def at_barrier(self) -> bool:
        """Whether the next command waits to be let through."""
        return bool(self._barriers) and self.put == self._barriers[0]

    def let_through(self) -> None:
        """The command that waits may be sent."""
        self._barriers = self._barriers[1:]

    def feed(self) -> None:
        """Hands over as much of what is released, and not behind a gate or a barrier, as the queue takes."""
        limit = min([self._limit, *self._gates[:1], *self._barriers[:1]])
        self.put += self.queue.put(self.program[self.put : limit][: self.queue.room])
