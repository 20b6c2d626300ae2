"""The queue of commands between generation and execution, and the requests that overtake it.

Rule: neither grows nor waits. Generation puts commands, execution takes them; a full queue takes no more and says how
many it took.
"""

from collections import deque
from enum import IntEnum, IntFlag
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd.commands import RECORD, Command

CAPACITY = 256
MOST_HANDS = 16  # outputs and rates set by hand that may wait: one is served a tick


class CommandQueue(Protocol):
    """A bounded FIFO of command records, in one process or between two: generation puts, execution takes."""

    def __len__(self) -> int:
        """How many records wait in the queue."""

    @property
    def room(self) -> int:
        """How many records can be put now."""

    def put(self, records: NDArray[np.void]) -> int:
        """Puts as many of the records (shape (n,)) as there is room for, and returns how many."""

    def take(self, command: Command) -> bool:
        """Loads the oldest record into ``command``; returns False where the queue is empty."""


class Mailbox(Protocol):
    """Requests on their way past the queue, in one process or between two.

    hand  the value of the OUTPUT or PACE taken last (``hand_of``, ``pace_of``)
    """

    hand: int

    @property
    def waiting(self) -> bool:
        """Whether a request waits to be taken."""

    def post(self, request: "Request") -> None:
        """Makes a request. Made twice before the next tick, it is served once."""

    def set_output(self, bit: int, value: int) -> bool:
        """Requests OUTPUT; several wait in line. Returns False, and requests nothing, where too many wait already."""

    def set_rate(self, tick_hz: int) -> bool:
        """Requests PACE, in the same line and with the same answer as ``set_output``."""

    def take(self) -> int:
        """Returns the requests made since the last call, as bits of RequestBit; of OUTPUT and PACE only the oldest, its
        value in ``hand``.
        """


class Queue:
    """A ring of records, allocated once: 256 of them where a machine is run. One side puts, the other takes."""

    __slots__ = ("_ring", "_taken", "_written")

    def __init__(self, capacity: int = CAPACITY) -> None:
        self._ring = np.zeros(capacity, dtype=RECORD)
        self._written = 0
        self._taken = 0

    def __len__(self) -> int:
        return self._written - self._taken

    @property
    def room(self) -> int:
        """How many records can be put now."""
        return len(self._ring) - len(self)

    def put(self, records: NDArray[np.void]) -> int:
        """Puts as many of the records (shape (n,)) as there is room for, and returns how many."""
        count = min(len(records), self.room)
        slots = (self._written + np.arange(count)) % len(self._ring)
        self._ring[slots] = records[:count]
        self._written += count
        return count

    def take(self, command: Command) -> bool:
        """Loads the oldest record into ``command``; returns False where the queue is empty."""
        if self._taken == self._written:
            return False
        command.load(self._ring[self._taken % len(self._ring)])
        self._taken += 1
        return True

    def waiting(self) -> NDArray[np.void]:
        """Returns a copy of all records that wait, the oldest first."""
        return self._ring[np.arange(self._taken, self._written) % len(self._ring)]

    def drop(self, count: int) -> None:
        """Removes the oldest ``count`` records: they were carried out in another way."""
        self._taken += count


class Request(IntEnum):
    """What overtakes the queue. The numbers are those of the trace's ``request`` signal."""

    NONE = 0
    ESTOP = 1
    STOP = 2
    HOLD = 3
    RESUME = 4
    ACK = 5
    OUTPUT = 6  # one output set by hand; which one and how: ``hand_of``
    PAUSE = 7  # a real machine's clock stood still (kmd/gate.py) and goes on; requested by the ticker itself
    LOAD = 8  # edited tables were taken before this tick; requested by the ticker itself
    PACE = 9  # another tick rate, at rest; which one: ``pace_of``


class RequestBit(IntFlag):
    """One bit for each request, so that several can wait; they are served in the order of Request."""

    ESTOP = 1 << Request.ESTOP
    STOP = 1 << Request.STOP
    HOLD = 1 << Request.HOLD
    RESUME = 1 << Request.RESUME
    ACK = 1 << Request.ACK
    OUTPUT = 1 << Request.OUTPUT
    PAUSE = 1 << Request.PAUSE
    LOAD = 1 << Request.LOAD
    PACE = 1 << Request.PACE


def hand_of(bit: int, value: int) -> int:
    """Returns an output set by hand as one number above 0; its trace signal is ``hand``."""
    return 1 + 2 * bit + value


def bit_and_value(hand: int) -> tuple[int, int]:
    """The inverse of ``hand_of``: the output's bit and its value."""
    return divmod(hand - 1, 2)


def pace_of(tick_hz: int) -> int:
    """Returns a requested tick rate as one number, below 0 to differ from an output; its trace signal is ``pace``. Its
    own inverse.
    """
    return -tick_hz


def request_of(hand: int) -> int:
    """Returns the bit of the request that a number of ``hand_of`` or ``pace_of`` belongs to."""
    return RequestBit.PACE.value if hand < 0 else RequestBit.OUTPUT.value


class Requests:
    """The mailbox within one process: ``post`` from above at any time, ``take`` in the tick."""

    __slots__ = ("_hands", "hand", "pending")

    def __init__(self) -> None:
        self.pending = self.hand = 0
        self._hands: deque[int] = deque(maxlen=MOST_HANDS)

    @property
    def waiting(self) -> bool:
        """Whether a request waits to be taken."""
        return self.pending != 0 or len(self._hands) > 0

    def post(self, request: Request) -> None:
        """Makes a request. Made twice before the next tick, it is served once."""
        self.pending |= 1 << request

    def set_output(self, bit: int, value: int) -> bool:
        """Requests OUTPUT. Returns False, and requests nothing, where too many wait already."""
        return self._line_up(hand_of(bit, value))

    def set_rate(self, tick_hz: int) -> bool:
        """Requests this tick rate (PACE), in Hz, as ``set_output`` requests an output."""
        return self._line_up(pace_of(tick_hz))

    def take(self) -> int:
        """Returns the requests made since the last call, as bits of RequestBit; of OUTPUT and PACE only the oldest, its
        value in ``hand``.
        """
        pending, self.pending = self.pending, 0
        if self._hands:
            self.hand = self._hands.popleft()
            pending |= request_of(self.hand)
        return pending

    def _line_up(self, hand: int) -> bool:
        if len(self._hands) == MOST_HANDS:
            return False
        self._hands.append(hand)
        return True
