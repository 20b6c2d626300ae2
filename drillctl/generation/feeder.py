"""Puts a program into the queue as room is made. Rule: never waits, never loses a record; called by the wiring."""

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import Queue


class Feeder:
    """A program on its way down. ``put`` counts the records handed over."""

    def __init__(self, program: NDArray[np.void], queue: Queue):
        self.program = program
        self.queue = queue
        self.put = 0

    def feed(self) -> None:
        """Hands over as much as the queue takes."""
        self.put += self.queue.put(self.program[self.put :][: self.queue.room])
