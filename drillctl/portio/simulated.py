"""Simulated cards, whose wires end in a plant. 32 outputs and 32 inputs a card, as on a PCL-720."""

import mmap

from drillctl.plant import Plant
from drillctl.ports import SAFE_IMAGE, Driver

HELD_BYTES = 64  # input bits of 16 cards


class SimulatedCard:
    """A driver (ports.Driver) that can't fail: a flush drives the plant, a latch returns the plant's sensors."""

    def __init__(self, plant: Plant):
        self.plant = plant

    def latch(self) -> int:
        """Returns the sensors as the plant has them since the last flush."""
        return self.plant.inputs

    def flush(self, image: int) -> None:
        """Drives the plant with the image."""
        self.plant.drive(image)

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Drives the plant with the safe image: the coils are released."""
        self.plant.drive(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Drives the plant with the safe image; there is nothing to release."""
        self.safe(image)


class SwitchedCard(SimulatedCard):
    """A simulated card whose input lines a person can hold at a level, from this process and from those that were
    forked off it: what is held lies in memory that they share. A held line reads so whatever the plant says.
    """

    def __init__(self, plant: Plant):
        super().__init__(plant)
        self._held = mmap.mmap(-1, 1 + 2 * HELD_BYTES)  # whether any is held; the lines held high; those held low

    def hold(self, bit: int, level: int | None) -> None:
        """Holds the line of an input bit high (1) or low (0), or lets it go (None)."""
        place, mask = 1 + bit // 8, 1 << bit % 8
        for start, held_at in ((place, 1), (place + HELD_BYTES, 0)):
            self._held[start] = self._held[start] | mask if level == held_at else self._held[start] & ~mask
        self._held[0] = any(self._held[1:])

    @property
    def held(self) -> int:
        """The input bits that are held."""
        high, low = self._masks()
        return high | low

    def latch(self) -> int:
        """Returns the plant's inputs, and those that are held as they are held."""
        if not self._held[0]:
            return self.plant.inputs
        high, low = self._masks()
        return (self.plant.inputs | high) & ~low

    def _masks(self) -> tuple[int, int]:
        low_at = 1 + HELD_BYTES
        return int.from_bytes(self._held[1:low_at], "little"), int.from_bytes(self._held[low_at:], "little")


class WatchedCard:
    """A driver (ports.Driver) that passes everything to another one, and drives a plant with the same outputs. The
    inputs are the other driver's; the plant's sensors are not used.
    """

    def __init__(self, card: Driver, plant: Plant):
        self._card, self._plant = card, plant

    def latch(self) -> int:
        """Returns the other driver's inputs."""
        return self._card.latch()

    def flush(self, image: int) -> None:
        """Puts the image out on the other driver, then drives the plant with it."""
        self._card.flush(image)
        self._plant.drive(image)

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Makes the outputs safe on the other driver and on the plant."""
        self._card.safe(image)
        self._plant.drive(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Makes the outputs safe on both and closes the other driver."""
        self.safe(image)
        self._card.close(image)
