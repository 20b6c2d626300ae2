"""Edited tables on their way into a running ticker (LOAD), as text, in memory that two processes share.

Rule: checked by machine/ in the process that ticks, taken at rest and whole, or refused with nothing changed.
"""

import mmap
from dataclasses import replace

import numpy as np

from drillctl.language import Message
from drillctl.machine import Machine, TableError
from drillctl.machine.bundle import unbundle
from drillctl.ticker.message_text import LONGEST_BYTES, message_read, message_text
from drillctl.ticker.ticker import Ticker

MOST_BYTES = 1024 * 1024
SLOT = np.dtype(
    [
        ("offered", "<u4"),  # how many texts were put there; desk
        ("length", "<u4"),  # of the newest; desk
        ("answered", "<u4"),  # how many were answered; ticker
        ("reply_length", "<u4"),  # of the newest answer; ticker
        ("reply", "u1", (LONGEST_BYTES,)),  # empty: taken; ticker
        ("text", "u1", (MOST_BYTES,)),  # desk
    ]
)
OTHER_MACHINE = Message("more than phase and ramp tables has changed")
AT_WORK = Message("the machine is at work; tables are taken at rest")


class TableSlot:
    """Shared memory for one text and its answer, inherited over a fork: the desk offers, the ticker answers."""

    def __init__(self) -> None:
        self._fields = np.frombuffer(mmap.mmap(-1, SLOT.itemsize), SLOT, 1)
        # Views: they are looked up at every wake.
        self._offered, self._answered = self._fields["offered"], self._fields["answered"]

    def offer(self, text: str) -> bool:
        """Offers a text to the ticker; False, and nothing offered, where it is too long."""
        data = text.encode()
        if len(data) > MOST_BYTES:
            return False
        self._fields["text"][0, : len(data)] = np.frombuffer(data, np.uint8)
        self._fields["length"] = len(data)
        self._offered += 1
        return True

    @property
    def waiting(self) -> bool:
        """Whether a text was offered and not answered yet."""
        return self._offered.item() != self._answered.item()

    def text(self) -> str:
        """The text that was offered last."""
        return bytes(self._fields["text"][0, : int(self._fields["length"][0])]).decode()

    def answer(self, reason: Message | None) -> None:
        """Answers the text: the reason why it was refused; None where it was taken."""
        data = message_text(reason).encode() if reason is not None else b""
        self._fields["reply"][0, : len(data)] = np.frombuffer(data, np.uint8)
        self._fields["reply_length"] = len(data)
        self._answered[:] = self._offered

    def reply(self) -> Message | None:
        """The answer to the last text: why it was refused; None where it was taken."""
        data = bytes(self._fields["reply"][0, : int(self._fields["reply_length"][0])])
        return message_read(data) if data else None


def take_tables(ticker: Ticker, text: str) -> Message | None:
    """Loads the machine of a bundle in place of the one that runs; returns why not, or None."""
    try:
        machine = unbundle(text).at_rate(ticker.machine.tick_hz)
    except TableError as error:
        return error.message
    if not differs_in_tables_alone(machine, ticker.machine):
        return OTHER_MACHINE
    if not ticker.resting:
        return AT_WORK
    ticker.load(machine)
    return None


def differs_in_tables_alone(machine: Machine, other: Machine) -> bool:
    """Whether two machines differ in phase tables and ramps alone: the same wires on the same bits, the same rate."""
    wires = [axis.phase.wire_names() for axis in other.axes]
    if [axis.phase.wire_names() for axis in machine.axes] != wires:
        return False
    pairs = zip(machine.axes, other.axes, strict=True)
    axes = tuple(replace(axis, phase=like.phase, ramp=like.ramp) for axis, like in pairs)
    return _without_source(replace(machine, axes=axes)) == _without_source(other)


def _without_source(machine: Machine) -> Machine:
    """The machine without what says where it was read from."""
    return replace(machine, files=(), shipped=False, description="")
