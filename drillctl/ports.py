"""The door between execution and port I/O: the port image, and what a driver must do.

A *port image* is one integer: bit 32 n + b is bit b of card n, as on a PCL-720 (32 outputs, 32 inputs a card;
the paper uses 18 and 6 of one). Outputs and inputs are images of the same shape.

Rule: within a tick inputs are latched once, first, and outputs flushed once, last. Imports nothing of ours.
"""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

CARD_BITS = 32
CARD_MASK = (1 << CARD_BITS) - 1
SAFE_IMAGE = 0  # every output low: no phase, no forcing, no spindle
LONGEST_WAIT_S = 0.05  # for the port, while an image is put out or the outputs are made safe


def word(image: int, card: int) -> int:
    """The 32 bits of one card."""
    return image >> CARD_BITS * card & CARD_MASK


def with_bits(image: int, bits: int, on: int) -> int:
    """The image with these bits set, or cleared."""
    return image | bits if on else image & ~bits


def bits_of(image: int) -> list[int]:
    """The numbers of the bits that are set, ascending."""
    return [bit for bit in range(image.bit_length()) if image >> bit & 1]


class PortError(OSError):
    """A port that can't be used. ``str()`` is ``PORT: reason, and what to do``."""

    def __init__(self, port: str, reason: str):
        super().__init__(f"{port}: {reason}")
        self.port, self.reason = port, reason


class PortRefused(PortError):
    """Before anything moves: no such port, no rights, a machine or a rate that it can't carry."""


class PortLost(PortError):
    """While it was in use: the port is gone, or its board was reset. What its outputs are now is unknown."""


class PortSlow(PortLost):
    """It is there, and takes images more slowly than ticks make them. What its outputs are now is unknown too."""


@dataclass(frozen=True, slots=True)
class PortLayout:
    """What a driver must know of a machine, in port images: bits set where something is connected.

    axis_outputs   by axis: the output bits of its wires
    other_outputs  the named outputs (spindle, lamps)
    inputs         the sensors
    card_address   of the first card, as the machine's file has it
    """

    tick_hz: int
    card_address: int
    axis_outputs: tuple[int, ...]
    other_outputs: int
    inputs: int

    @property
    def outputs(self) -> int:
        """All output bits in use."""
        image = self.other_outputs
        for bits in self.axis_outputs:
            image |= bits
        return image

    @property
    def cards(self) -> int:
        """How many cards of 32 outputs and 32 inputs that takes."""
        return max(1, -(-(self.outputs | self.inputs).bit_length() // CARD_BITS))


class Driver(Protocol):
    """One card or several, real or simulated. Errors of the port are OSError; a driver never retries by itself.

    Made before the processes part and used in one of them, while another keeps it only to call ``safe``: so it has
    no thread and no lock, and a new one begins with the safe image.
    """

    def latch(self) -> int:
        """The input image as it stands now. Never waits. Called once a tick, before anything else."""

    def flush(self, image: int) -> None:
        """Puts the output image out, within LONGEST_WAIT_S. Called once a tick, after everything else, changed
        or not."""

    def safe(self) -> None:
        """Puts the whole safe image out, whatever came before, within LONGEST_WAIT_S and from any process that
        inherited the driver. Called on every way out, and as often as anybody likes."""

    def close(self) -> None:
        """Gives the port back; the outputs are safe afterwards, where the port still answers."""


@runtime_checkable
class Answering(Protocol):
    """A driver whose board is asked now and then whether it is still as it was made ready. What was done by images that
    it has not vouched for may not have been done: the board may have been reset, and nothing says so yet.
    """

    @property
    def put(self) -> int:
        """How many images were put out so far."""

    @property
    def vouched(self) -> int:
        """How many of these, from the first on, the board has answered for. Catches up within a second while ``latch``
        is called; where it can't, ``latch`` raises PortLost."""


@runtime_checkable
class Telling(Protocol):
    """A driver that has more to say of its port than what it was opened with."""

    def facts(self) -> tuple[str, ...]:
        """What it found there when it was opened, a line each."""
