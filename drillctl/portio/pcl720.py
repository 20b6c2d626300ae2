"""Advantech PCL-720 cards on an ISA bus, through the kernel's /dev/port: 32 outputs and 32 inputs a card.

Register map (Vixie Enterprises' pcl720.h, 1995): base+0 to base+3 carry bits 0-7, 8-15, 16-23 and 24-31; what is
written are the outputs, what is read the inputs. base+4 to base+7 are the counters, which are not used here.

Rule: outputs can't be read back, so every flush writes all of every card: a disturbed output is right again one tick
later.
"""

import os
from collections.abc import Sequence
from contextlib import suppress

from drillctl.files import system
from drillctl.language import Counted, Message, message_of
from drillctl.ports import SAFE_IMAGE, PortLayout, PortLost, PortRefused, word

DEVICE = "/dev/port"
REGISTERS = 8  # a card; the next one follows, unless ADDRESS says where it is
DATA_BYTES = 4
HIGHEST_BASE = 0x10000 - REGISTERS


class Pcl720:
    """A driver (ports.Driver) for one card or several.

    write_to, read_from  descriptors in which offset n is I/O port n: both /dev/port's, except in tests
    bases                the first register of each card
    """

    def __init__(self, write_to: int, read_from: int, bases: Sequence[int]):
        self._write_to, self._read_from = write_to, read_from
        self._bases = tuple(bases)
        self.safe()

    def facts(self) -> tuple[Message, ...]:
        """Returns where its cards are (ports.Telling)."""
        return tuple(Message("card at 0x{base:X}: 32 outputs, 32 inputs", base=base) for base in self._bases)

    def latch(self) -> int:
        """Returns all inputs of all cards. Raises OSError."""
        image = 0
        for base in reversed(self._bases):
            data = os.pread(self._read_from, DATA_BYTES, base)
            if len(data) < DATA_BYTES:
                raise PortLost(
                    "pcl720",
                    Message("no answer at 0x{base:x}; check the card's address, then initialise again", base=base),
                )
            image = image << 8 * DATA_BYTES | int.from_bytes(data, "little")
        return image

    def flush(self, image: int) -> None:
        """Writes all outputs of all cards. Raises OSError."""
        for card, base in enumerate(self._bases):
            data = word(image, card).to_bytes(DATA_BYTES, "little")
            if os.pwrite(self._write_to, data, base) < DATA_BYTES:
                raise PortLost(
                    "pcl720", Message("took no output at 0x{base:x}; check the card, then initialise again", base=base)
                )

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Puts the safe image out on all cards. Raises OSError."""
        self.flush(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Puts the safe image out, and closes the descriptors."""
        with suppress(OSError):
            self.safe(image)
        for descriptor in {self._write_to, self._read_from}:
            os.close(descriptor)


def open_pcl720(address: str, layout: PortLayout) -> Pcl720:
    """Opens the cards at ``ADDRESS[,ADDRESS..]``, by default the machine's and those after it. Raises PortRefused."""
    bases = card_bases(address, layout)
    if reason := missing():
        raise PortRefused("pcl720", reason)
    try:
        descriptor = os.open(DEVICE, os.O_RDWR)
    except OSError as error:
        reason = Message(
            "{device} can't be opened ({why}); be root, and the kernel not locked down",
            device=DEVICE,
            why=message_of(error),
        )
        raise PortRefused("pcl720", reason) from error
    lock(descriptor)
    return Pcl720(descriptor, descriptor, bases)


def lock(descriptor: int) -> None:
    """Locks the cards for this program and the processes that inherit the lock. Raises PortRefused."""
    try:
        system.lock(descriptor)
    except BlockingIOError as error:
        os.close(descriptor)
        raise PortRefused("pcl720", Message("another run is using the cards; end it first")) from error


def card_bases(address: str, layout: PortLayout) -> list[int]:
    """Returns the addresses of the machine's cards. Raises PortRefused for what is no address, or too few of them."""
    if not address:
        return [layout.card_address + REGISTERS * card for card in range(layout.cards)]
    try:
        bases = [int(base, 16) for base in address.split(",")]
    except ValueError as error:
        raise PortRefused(
            "pcl720", Message("{address!r} is no address; such as 2A0 or 2A0,2A8, in hexadecimal", address=address)
        ) from error
    if len(bases) != layout.cards or not all(0 <= base <= HIGHEST_BASE for base in bases):
        raise PortRefused(
            "pcl720",
            Counted(
                "the machine needs {count} address below 10000, not {address}",
                "the machine needs {count} addresses below 10000, not {address}",
                layout.cards,
                address=address,
            ),
        )
    return bases


def missing() -> Message | None:
    """Returns why there is no PCL-720 here; None where one can be."""
    if not os.path.exists(DEVICE):
        return Message("no {device}: this kernel was built without it, or this is no PC", device=DEVICE)
    return None if os.access(DEVICE, os.R_OK | os.W_OK) else Message("{device} is for root alone", device=DEVICE)
