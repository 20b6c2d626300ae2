"""Queue, requests, gate and status in one mapped file, shared by the desk's process, the ticker's and the guard.

Rule: each field has one writer, named beside it, and nobody waits: counters only rise, and the status is copied under a
sequence lock and read again when the copy was torn. The file is made before the processes part and outlives them, so
that the last status can be read after a crash; it stays locked while a process of its run has it mapped. A run in one
process uses the plain Queue, Requests and Gate instead.
"""

import mmap
import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.files import system
from drillctl.files.scratch import make_file
from drillctl.kmd.commands import RECORD, Command
from drillctl.kmd.queue import CAPACITY, MOST_HANDS, Request, Requests, hand_of, pace_of, request_of
from drillctl.kmd.status import STATUS
from drillctl.language import Message

MAGIC = 0x4C54434C4C495244  # "DRILLCTL", little-endian
MOST_READS = 1000
NOTHING = -1  # no value of the lock
EXISTING = system.flags("O_RDWR", "O_NOFOLLOW", "O_CLOEXEC")

CHANNEL = np.dtype(
    [
        ("magic", "<u8"),
        ("desk_beat_ns", "<i8"),  # monotonic; written by desk
        ("written", "<u8"),  # records put; desk
        ("asked", "<u4", (len(Request),)),  # how often each request was made; desk
        ("hands", "<i4", (MOST_HANDS,)),  # outputs and rates to be set by hand, a ring; desk
        ("hands_asked", "<u4"),  # how many were put there; desk
        ("hands_taken", "<u4"),  # how many were taken; ticker
        ("paused", "<u4"),  # 1: only ticks that are granted; desk
        ("granted", "<u8"),  # desk
        ("passed", "<u8"),  # ticks of those granted that were run; ticker
        ("leave", "<u4"),  # 1: the desk is done and the ticker may end; desk
        ("ticker_pid", "<i8"),  # desk
        ("ticker_beat_ns", "<i8"),  # ticker
        ("taken", "<u8"),  # records taken; ticker
        ("ticks", "<i8"),  # run so far, in a traced run each in the ring; ticker
        ("tick_ns", "<i8"),  # length of a tick: the beat may be silent for so long; ticker, before the fork desk
        ("safe_image", "<u8"),  # what makes the outputs safe now, of the first two cards; ticker, before the fork desk
        ("ended", "<u4"),  # 1 when the ticker is leaving, its outputs safe; ticker
        ("guard_beat_ns", "<i8"),  # guard
        ("guarded", "<u4"),  # 1 when the guard has to make the outputs safe; guard
        ("lock", "<u8"),  # odd while the status is being written; ticker
        ("status", STATUS),  # ticker
        ("ring", RECORD, (CAPACITY,)),  # desk
    ]
)

PLACES: Mapping[str, Any] = CHANNEL.fields or {}
NUMBERS = tuple(name for name, (kind, *_) in PLACES.items() if kind.kind in "iu")
STATUS_AT, ASKED_AT = PLACES["status"][1], PLACES["asked"][1]


class Channel:
    """One mapped file of dtype CHANNEL. Raises OSError where it can't be made, or where the file is
    not of this kind.
    """

    def __init__(self, file: Path, create: bool):
        # A new file is written whole under another name and then renamed: a reader finds a whole one, and a process
        # that has an old one mapped keeps it.
        handle, place = make_file(file) if create else (os.open(file, EXISTING), file)
        try:
            if create:
                _fill(handle, file)
            elif os.fstat(handle).st_size != CHANNEL.itemsize:
                raise OSError(Message("not a channel of this program").at(file))
            self.file = file
            self.memory = mmap.mmap(handle, CHANNEL.itemsize)
        except OSError:
            if create:
                place.unlink(missing_ok=True)
            raise
        finally:
            os.close(handle)
        self.fields: NDArray[np.void] = np.frombuffer(self.memory, dtype=CHANNEL, count=1)
        self._numbers = {name: self.fields[name] for name in NUMBERS}  # views: looked up at every tick
        self._copied, self._copy = NOTHING, self.fields["status"][0]  # the lock at the newest copy, and the copy
        if create:
            self.fields["magic"] = MAGIC
            place.replace(file)
        elif int(self.fields["magic"][0]) != MAGIC:
            raise OSError(Message("not a channel of this program").at(file))

    def status(self) -> np.void:
        """Returns a whole copy of the newest status record, to be read only: the same one until another is published.
        Raises OSError if the ticker died while it wrote one.
        """
        for _ in range(MOST_READS):
            before = self["lock"]
            if before == self._copied:
                return self._copy
            copy = self.fields["status"][0].copy()
            if before % 2 == 0 and self["lock"] == before:
                self._copy, self._copied = copy, before
                return copy
        raise OSError(Message("the status record was left half written").at(self.file))

    def publish(self, status: np.void) -> None:
        """Makes this the newest status record. For the ticker only."""
        lock = self._numbers["lock"]
        lock[0] += 1
        self.memory[STATUS_AT : STATUS_AT + STATUS.itemsize] = status.tobytes()
        lock[0] += 1

    def __getitem__(self, name: str) -> int:
        value: int = self._numbers[name].item()
        return value

    def __setitem__(self, name: str, value: int) -> None:
        self._numbers[name][0] = value


def _fill(handle: int, file: Path) -> None:
    """Writes the file full of zeros, so that the disk has room for it: a mapped page without room is a bus error."""
    try:
        with open(handle, "wb", closefd=False) as whole:
            whole.write(bytes(CHANNEL.itemsize))
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(file)) from error


class SharedQueue:
    """The command queue of a channel: the desk puts records, the ticker takes them."""

    def __init__(self, channel: Channel):
        self._ring = channel.fields["ring"][0]
        self._written = channel.fields["written"]
        self._taken = channel.fields["taken"]
        self._beat_ns = channel.fields["desk_beat_ns"]

    def __len__(self) -> int:
        return int(self._written[0]) - int(self._taken[0])

    @property
    def room(self) -> int:
        """How many records can be put now."""
        return CAPACITY - len(self)

    def put(self, records: NDArray[np.void]) -> int:
        """Puts as many of the records as there is room for, and returns how many. They count once they are whole.

        Beats the desk's heartbeat first: a desk that was silent at rest, since it planned a board, is not lost in the
        tick that takes the first command.
        """
        self._beat_ns[0] = time.monotonic_ns()
        count = min(len(records), self.room)
        written = int(self._written[0])
        self._ring[(written + np.arange(count)) % CAPACITY] = records[:count]
        self._written[0] = written + count
        return count

    def take(self, command: Command) -> bool:
        """Loads the oldest record into ``command``; returns False where the queue is empty."""
        taken = int(self._taken[0])
        if taken == int(self._written[0]):
            return False
        command.load(self._ring[taken % CAPACITY])
        self._taken[0] = taken + 1
        return True


class SharedRequests:
    """The requests of a channel: the desk counts each up, the ticker sees which counts have risen.

    own   requests that the ticker's process makes itself, beside the desk's
    hand  the value of the OUTPUT or PACE taken last (``hand_of``, ``pace_of``)
    """

    def __init__(self, channel: Channel):
        self.own = Requests()
        self.hand = 0
        self._channel = channel
        self._hands = channel.fields["hands"][0]
        self._asked = channel.fields["asked"][0]
        self._seen = self._asked.tobytes()

    @property
    def waiting(self) -> bool:
        """Whether a request waits to be taken."""
        asked = self._channel.memory[ASKED_AT : ASKED_AT + len(self._seen)]
        return self.own.waiting or asked != self._seen or self._hands_waiting > 0

    def post(self, request: Request) -> None:
        """Makes a request. For the desk only."""
        self._asked[request] += 1

    def take(self) -> int:
        """Returns the requests made since the last call, as bits of RequestBit. For the ticker only."""
        if not self.waiting:
            return 0
        asked = self._asked.copy()
        risen = np.flatnonzero(asked != np.frombuffer(self._seen, asked.dtype)).tolist()
        self._seen = asked.tobytes()
        return self.own.take() | sum(1 << request for request in risen) | self._take_hand()

    def set_output(self, bit: int, value: int) -> bool:
        """Requests OUTPUT. Returns False, and requests nothing, where too many wait already. For the desk only."""
        return self._line_up(hand_of(bit, value))

    def set_rate(self, tick_hz: int) -> bool:
        """Requests PACE, as ``set_output``. For the desk only."""
        return self._line_up(pace_of(tick_hz))

    def _line_up(self, hand: int) -> bool:
        if self._hands_waiting == MOST_HANDS:
            return False
        asked = self._channel["hands_asked"]
        self._hands[asked % MOST_HANDS] = hand
        self._channel["hands_asked"] = asked + 1
        return True

    @property
    def _hands_waiting(self) -> int:
        return self._channel["hands_asked"] - self._channel["hands_taken"]

    def _take_hand(self) -> int:
        if not self._hands_waiting:
            return 0
        taken = self._channel["hands_taken"]
        self.hand = int(self._hands[taken % MOST_HANDS])
        self._channel["hands_taken"] = taken + 1
        return request_of(self.hand)


class SharedGate:
    """The gate of a channel: the desk shuts it and grants ticks, the ticker counts those that it ran."""

    def __init__(self, channel: Channel):
        self._channel = channel

    @property
    def paused(self) -> bool:
        """Whether the gate is shut: only granted ticks are run."""
        return self._channel["paused"] != 0

    @property
    def left(self) -> int:
        """How many granted ticks have not been run yet."""
        return max(0, self._channel["granted"] - self._channel["passed"]) if self.paused else 0

    def grant(self, ticks: int) -> None:
        """Shuts the gate, and lets so many more ticks through. For the desk only."""
        before = self._channel["granted"] if self.paused else self._channel["passed"]
        self._channel["granted"] = before + ticks
        self._channel["paused"] = 1

    def open(self) -> None:
        """Opens the gate: all ticks are run. For the desk only."""
        self._channel["paused"] = 0

    def passed(self, ticks: int) -> None:
        """Counts so many granted ticks as run. For the ticker only."""
        self._channel["passed"] += ticks
