"""The queue of commands between the layers, and the requests that overtake it.

Rule: neither grows nor waits. generation puts, execution alone takes; a full queue says so and takes nothing.
"""

from enum import IntEnum, IntFlag
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd.commands import RECORD, Command

CAPACITY = 256


class CommandQueue(Protocol):
    """A bounded FIFO of records, in one process or between two: one side puts, the other takes."""

    def __len__(self) -> int:
        """Records that wait."""

    @property
    def room(self) -> int:
        """How many records may be put now."""

    def put(self, records: NDArray[np.void]) -> int:
        """Takes as many of the records (shape (n,)) as there is room for; returns how many."""

    def take(self, command: Command) -> bool:
        """Overwrites ``command`` with the oldest record; False where there is none."""


class Mailbox(Protocol):
    """Requests on their way past the queue, in one process or between two."""

    def post(self, request: "Request") -> None:
        """Asks for something; asked twice before the next tick is asked once."""

    def take(self) -> int:
        """The requests asked since the last call, as bits."""


class Queue:
    """A ring of 256 records, allocated once. One side puts, the other takes."""

    __slots__ = ("_ring", "_taken", "_written")

    def __init__(self) -> None:
        self._ring = np.zeros(CAPACITY, dtype=RECORD)
        self._written = 0
        self._taken = 0

    def __len__(self) -> int:
        return self._written - self._taken

    @property
    def room(self) -> int:
        """How many records may be put now."""
        return CAPACITY - len(self)

    def put(self, records: NDArray[np.void]) -> int:
        """Takes as many of the records (shape (n,)) as there is room for; returns how many."""
        count = min(len(records), self.room)
        slots = (self._written + np.arange(count)) % CAPACITY
        self._ring[slots] = records[:count]
        self._written += count
        return count

    def take(self, command: Command) -> bool:
        """Overwrites ``command`` with the oldest record; False where there is none."""
        if self._taken == self._written:
            return False
        command.load(self._ring[self._taken % CAPACITY])
        self._taken += 1
        return True


class Request(IntEnum):
    """What overtakes the queue. The numbers are those of the trace's ``request`` signal."""

    NONE = 0
    ESTOP = 1
    STOP = 2
    HOLD = 3
    RESUME = 4
    ACK = 5


class RequestBit(IntFlag):
    """One bit a request, so that several may be waiting; they are served in the order of Request."""

    ESTOP = 1 << Request.ESTOP
    STOP = 1 << Request.STOP
    HOLD = 1 << Request.HOLD
    RESUME = 1 << Request.RESUME
    ACK = 1 << Request.ACK


class Requests:
    """The mailbox: ``post`` from above at any time, ``take`` by the tick alone."""

    __slots__ = ("pending",)

    def __init__(self) -> None:
        self.pending = 0

    def post(self, request: Request) -> None:
        """Asks for something; asked twice before the next tick is asked once."""
        self.pending |= 1 << request

    def take(self) -> int:
        """The requests asked since the last call, as bits."""
        pending, self.pending = self.pending, 0
        return pending
