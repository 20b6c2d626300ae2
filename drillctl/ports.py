"""The door between execution and port I/O: the port image, and what a driver must do.

A *port image* is one integer: bit 32 n + b is bit b of card n, as on a PCL-720 (32 outputs, 32 inputs a card;
the paper uses 18 and 6 of one). Outputs and inputs are images of the same shape.

Rule: within a tick inputs are latched once, first, and outputs flushed once, last. Imports nothing of ours.
"""

from typing import Protocol

CARD_BITS = 32
CARD_MASK = (1 << CARD_BITS) - 1
SAFE_IMAGE = 0  # every output low: no phase, no forcing, no spindle


def word(image: int, card: int) -> int:
    """The 32 bits of one card."""
    return image >> CARD_BITS * card & CARD_MASK


class Driver(Protocol):
    """One card or several, real or simulated. Errors of the port are OSError; a driver never retries by itself."""

    def latch(self) -> int:
        """The input image as it stands now. Called once a tick, before anything else."""

    def flush(self, image: int) -> None:
        """Puts the output image out. Called once a tick, after everything else, changed or not."""

    def safe(self) -> None:
        """Puts the safe image out, whatever came before. Called on every way out."""

    def close(self) -> None:
        """Gives the port back; the outputs are safe afterwards."""
