"""Simulated cards, whose wires end in a plant. 32 outputs and 32 inputs a card, as on a PCL-720."""

from drillctl.plant import Plant
from drillctl.ports import SAFE_IMAGE, Driver


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

    def safe(self) -> None:
        """Sets all outputs low: the coils are released."""
        self.plant.drive(SAFE_IMAGE)

    def close(self) -> None:
        """Sets all outputs low; there is nothing to release."""
        self.safe()


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

    def safe(self) -> None:
        """Makes the outputs safe on the other driver and on the plant."""
        self._card.safe()
        self._plant.drive(SAFE_IMAGE)

    def close(self) -> None:
        """Makes the outputs safe on both and closes the other driver."""
        self.safe()
        self._card.close()
