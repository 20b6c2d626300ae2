"""Which status record may go up to the desk, where the board at the port must answer for what was done.

For execution a command is done once its last image is put out. A board that was reset has not acted on it, and that is
known a moment later. So a record by which one more command is done, or a fault is new, waits until the board has
answered for the images before it: what the desk journals as done was done, and a position reported as kept was kept.

Rule: records go up whole and in order. The last one, of a ticker that must end, waits for nothing, and leaves out
what was not answered for.
"""

import numpy as np

from drillctl.ports import Answering, Driver

AWAITED = ("done", "holes_done", "fault")
COUNTS = AWAITED[:2]


class ConfirmedStatus:
    """The status records of one ticker on one port. On a port that answers no questions each goes up at once."""

    def __init__(self, port: Driver):
        self._port = port if isinstance(port, Answering) else None
        self._published = dict.fromkeys(AWAITED, 0)  # the values that went up last
        self._waiting: np.void | None = None
        self._needs = 0  # images that the board must have answered for before

    def newest(self, status: np.void) -> np.void | None:
        """The record that may go up now, given the newest one, which is copied where it must wait; None for none."""
        if self._port is None:
            return status
        if self._waiting is None:
            if _awaited(status) == self._published:
                return status
            self._waiting, self._needs = status.copy(), self._port.put
        if self._port.vouched < self._needs:
            return None
        freed, self._waiting = self._waiting, None
        self._published = _awaited(freed)
        return freed

    def last(self, status: np.void) -> np.void:
        """The record of a ticker that ends now by a fault, given the newest one."""
        self.newest(status)
        last = status.copy()
        if self._port is not None:
            for name in COUNTS:
                last[name] = self._published[name]
        return last


def _awaited(status: np.void) -> dict[str, int]:
    return {name: int(status[name]) for name in AWAITED}
