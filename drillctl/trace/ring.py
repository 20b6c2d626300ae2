"""A recorder in shared memory: one process writes changes as they happen, another reads them out.

Rule: of fixed size; it never waits and never grows. When its reader falls behind it is marked as overrun, since a trace
with a hole must not be taken for a whole one.
"""

import mmap

import numpy as np
from numpy.typing import NDArray

CAPACITY = 1 << 17  # changes: more than ten seconds of the fastest machine
CHANGE = np.dtype([("tick", "<i8"), ("signal", "<i4"), ("value", "<i8")])
STATE = np.dtype([("written", "<u8"), ("taken", "<u8"), ("overrun", "<u4")])


class RingRecorder:
    """``set`` as a Recorder's, for the writing process; ``drain`` for the reading one. Made before the fork."""

    def __init__(self, signals: int):
        self._memory = mmap.mmap(-1, STATE.itemsize + CAPACITY * CHANGE.itemsize)
        self._state = np.frombuffer(self._memory, STATE, 1)
        self._ring = np.frombuffer(self._memory, CHANGE, CAPACITY, STATE.itemsize)
        self._last: list[int | None] = [None] * signals
        self._written = 0

    def set(self, index: int, tick: int, value: int) -> None:
        """Signal ``index`` has ``value`` in ``tick``: kept if that is a change and there is room."""
        if self._last[index] == value:
            return
        self._last[index] = value
        if self._written - int(self._state["taken"][0]) >= CAPACITY:
            self._state["overrun"] = 1
            return
        self._ring[self._written % CAPACITY] = (tick, index, value)
        self._written += 1
        self._state["written"] = self._written

    def drain(self) -> NDArray[np.void]:
        """Returns all changes written since the last call, dtype CHANGE, oldest first."""
        taken, written = int(self._state["taken"][0]), int(self._state["written"][0])
        changes: NDArray[np.void] = self._ring[np.arange(taken, written) % CAPACITY].copy()
        self._state["taken"] = written
        return changes

    @property
    def overrun(self) -> bool:
        """Whether a change was lost, so that the trace is not whole."""
        return bool(self._state["overrun"][0])
