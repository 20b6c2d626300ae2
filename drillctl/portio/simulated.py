"""The simulated card: its wires end in a plant. 32 outputs and 32 inputs a card, as on a PCL-720."""

from drillctl.plant import Plant
from drillctl.ports import SAFE_IMAGE


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
