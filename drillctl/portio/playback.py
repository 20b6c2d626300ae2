"""A card whose inputs are a recording's: what replay puts under the tick code, without plant or clock.

Rule: the n-th latch is tick n; outputs are kept for whoever samples them and go nowhere.
"""

from collections.abc import Sequence

from drillctl.ports import SAFE_IMAGE


class PlaybackCard:
    """A driver (ports.Driver) over recorded input changes.

    ticks, images   the input image from each tick on, ascending, the first at tick 0
    """

    def __init__(self, ticks: Sequence[int], images: Sequence[int]):
        self._changes = iter(zip(ticks, images, strict=True))
        self._next_tick, self._next_image = next(self._changes, (-1, 0))
        self._now = 0
        self.tick = 0
        self.image = SAFE_IMAGE

    def latch(self) -> int:
        """The recorded inputs of this tick."""
        if self.tick == self._next_tick:
            self._now = self._next_image
            self._next_tick, self._next_image = next(self._changes, (-1, 0))
        return self._now

    def flush(self, image: int) -> None:
        """The tick is over."""
        self.image = image
        self.tick += 1

    def safe(self) -> None:
        """All outputs low."""
        self.image = SAFE_IMAGE

    def close(self) -> None:
        """Nothing to give back."""
        self.safe()
