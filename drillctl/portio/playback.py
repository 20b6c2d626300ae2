"""A card whose inputs come from a recorded trace. Replay runs the ticks on it, without plant or clock.

Rule: the n-th latch is tick n; outputs go nowhere and can be read as ``image``.
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
        """Returns the recorded inputs of this tick."""
        if self.tick == self._next_tick:
            self._now = self._next_image
            self._next_tick, self._next_image = next(self._changes, (-1, 0))
        return self._now

    def flush(self, image: int) -> None:
        """Keeps the image and goes on to the next tick's inputs."""
        self.image = image
        self.tick += 1

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Keeps the safe image."""
        self.image = image

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Keeps the safe image; there is nothing to give back."""
        self.safe(image)
