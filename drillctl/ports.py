"""The door between execution and port I/O: the port image, and what a driver must do.

A *port image* is one integer: bit 32 n + b is bit b of card n, as on a PCL-720 (32 outputs, 32 inputs a card; the paper
uses 18 and 6 of one). Outputs and inputs are images of the same shape.

Rule: within a tick inputs are latched once, first, and outputs flushed once, last. Knows no layer.
"""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from drillctl.language import Message, Refusal

CARD_BITS = 32
CARD_MASK = (1 << CARD_BITS) - 1
SAFE_IMAGE = 0  # every output low: no phase, no forcing, no spindle
LONGEST_WAIT_S = 0.05  # that a driver may take to put an image out, or to make the outputs safe


def word(image: int, card: int) -> int:
    """Returns the 32 bits of one card."""
    return image >> CARD_BITS * card & CARD_MASK


def with_bits(image: int, bits: int, on: int) -> int:
    """Returns the image with these bits set, or cleared."""
    return image | bits if on else image & ~bits


def bits_of(image: int) -> list[int]:
    """Returns the numbers of the bits that are set, ascending."""
    return [bit for bit in range(image.bit_length()) if image >> bit & 1]


class PortError(Refusal, OSError):
    """A port that can't be used. ``str()`` is ``PORT: reason, and what to do``."""

    kind = "port"

    def __init__(self, port: str, reason: Message):
        super().__init__(reason.at(port))
        self.port, self.reason = port, reason


class PortRefused(PortError):
    """Refused before anything moves: no such port, no rights, a machine or a rate that the port can't carry."""


class PortLost(PortError):
    """The port failed in use: it is gone, or its board was reset. The state of its outputs is unknown."""


class PortSlow(PortLost):
    """The port takes images more slowly than ticks make them. The state of its outputs is unknown."""


@dataclass(frozen=True, slots=True)
class PortLayout:
    """What a driver must know of a machine, as port images with a bit set where something is connected.

    axis_outputs   by axis: the output bits of its wires
    other_outputs  the named outputs (spindle, lamps)
    inputs         the sensors and other inputs
    card_address   of the first card, from the machine's file
    """

    tick_hz: int
    card_address: int
    axis_outputs: tuple[int, ...]
    other_outputs: int
    inputs: int

    @property
    def outputs(self) -> int:
        """All output bits in use, as one image."""
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

    It is made before the processes fork, used in one of them, and kept by the others only to call ``safe``: so it has
    no thread and no lock. A new driver starts with the safe image.
    """

    def latch(self) -> int:
        """Returns the input image as it is now, without waiting. Once a tick, before anything else."""

    def flush(self, image: int) -> None:
        """Puts the output image out, within LONGEST_WAIT_S. Once a tick, after everything else, changed or not."""

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Puts the whole safe image out, whatever came before, within LONGEST_WAIT_S, from any process that inherited
        the driver. Called on every way out; more than once is allowed. A machine whose outputs are kept, or on, after
        an emergency stop has another ``image`` than SAFE_IMAGE.
        """

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Gives the port back. The outputs have the safe ``image`` afterwards, where the port still answers."""


def make_safe(port: Driver, image: int) -> None:
    """Puts the safe image out. A driver that knows no image but SAFE_IMAGE (one of another distribution may not) is
    not given that one. Raises OSError.
    """
    if image == SAFE_IMAGE:
        port.safe()
    else:
        port.safe(image)


def close_port(port: Driver, image: int) -> None:
    """Gives the port back with the safe image out, as ``make_safe``. Raises OSError."""
    if image == SAFE_IMAGE:
        port.close()
    else:
        port.close(image)


@runtime_checkable
class Answering(Protocol):
    """A driver that asks its board at a fixed beat whether it is still set up as it was. An image that the board has
    not answered for may have been lost in a reset that nobody has noticed yet.
    """

    @property
    def put(self) -> int:
        """How many images were put out so far."""

    @property
    def vouched(self) -> int:
        """How many of these, from the first on, the board has answered for. Catches up within a second while ``latch``
        is called; where it can't, ``latch`` raises PortLost.
        """


@runtime_checkable
class Telling(Protocol):
    """A driver that can describe its port."""

    def facts(self) -> tuple[Message, ...]:
        """Returns what it found when the port was opened, a line for each fact."""
