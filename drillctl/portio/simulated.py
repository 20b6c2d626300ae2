"""The simulated card: its wires end in a plant. 32 outputs and 32 inputs a card, as on a PCL-720."""

from drillctl.plant import Plant
from drillctl.ports import SAFE_IMAGE, Driver


class SimulatedCard:
    """A driver (ports.Driver) that can't fail: what is flushed moves the plant, what is latched is the plant's."""

    def __init__(self, plant: Plant):
        self.plant = plant

    def latch(self) -> int:
        """The sensors as the plant has them since the last flush."""
        return self.plant.inputs

    def flush(self, image: int) -> None:
        """The outputs act at once."""
        self.plant.drive(image)

    def safe(self) -> None:
        """All outputs low: the coils are released."""
        self.plant.drive(SAFE_IMAGE)

    def close(self) -> None:
        """The outputs are safe afterwards."""
        self.safe()


class WatchedCard:
    """A driver (ports.Driver) before another, whose outputs drive a plant too. The plant's sensors are not asked."""

    def __init__(self, card: Driver, plant: Plant):
        self._card, self._plant = card, plant

    def latch(self) -> int:
        """The other card's inputs."""
        return self._card.latch()

    def flush(self, image: int) -> None:
        """To both."""
        self._card.flush(image)
        self._plant.drive(image)

    def safe(self) -> None:
        """Both."""
        self._card.safe()
        self._plant.drive(SAFE_IMAGE)

    def close(self) -> None:
        """The other card's end."""
        self.safe()
        self._card.close()
