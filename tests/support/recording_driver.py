"""A driver around another one that keeps what went through it, tick by tick.

Rule: memory is taken once, at the start; when it is full the port goes on working and ``missed`` counts what was not
kept. For tests, and for looking at a real port's first runs.
"""

import numpy as np
import numpy.typing as npt

from drillctl.ports import Driver, word

Words = npt.NDArray[np.uint32]


class RecordingDriver:
    """A driver (ports.Driver). Row n is the n-th flush with the inputs latched before it; column c is card c.

    ticks    rows kept so far
    missed   ticks that came when all rows were taken
    """

    def __init__(self, inner: Driver, capacity_ticks: int, cards: int = 1):
        self.inner = inner
        self.ticks = self.missed = 0
        self._capacity, self._cards = capacity_ticks, range(cards)
        self._latched = np.zeros((capacity_ticks, cards), np.uint32)
        self._flushed = np.zeros((capacity_ticks, cards), np.uint32)
        self._inputs = 0

    @property
    def full(self) -> bool:
        """No further tick will be kept."""
        return self.ticks == self._capacity

    @property
    def latched(self) -> Words:
        """The inputs, shape (ticks, cards): a view."""
        return self._latched[: self.ticks]

    @property
    def flushed(self) -> Words:
        """The outputs, shape (ticks, cards): a view."""
        return self._flushed[: self.ticks]

    def latch(self) -> int:
        """The inner driver's."""
        self._inputs = self.inner.latch()
        return self._inputs

    def flush(self, image: int) -> None:
        """Puts the image out, then keeps it: what was not put out is not kept."""
        self.inner.flush(image)
        if self.full:
            self.missed += 1
            return
        for card in self._cards:
            self._latched[self.ticks, card] = word(self._inputs, card)
            self._flushed[self.ticks, card] = word(image, card)
        self.ticks += 1

    def safe(self) -> None:
        """The inner driver's; not a tick, so not kept."""
        self.inner.safe()

    def close(self) -> None:
        """Closes the inner driver; what was kept stays."""
        self.inner.close()
