"""What can be done by hand on a running machine: signals seen live, outputs set singly, single ticks; its port tested.

Rule: as console.py has it: nothing raises for what a person did, and asking never blocks, but for a test of the port,
which takes seconds and moves nothing. What changes the machine goes down as a request.
"""

from collections.abc import Sequence
from typing import Literal, Protocol

import msgspec

from drillctl.language import Message
from drillctl.ports import CARD_BITS
from drillctl.viewmodel.console import Problems

SignalKind = Literal["input", "output", "coil"]


class SignalView(msgspec.Struct, frozen=True):
    """One wire of the port at this moment.

    name          as in the machine's file; a coil's is ``AXIS.WIRE``
    bit           of the port image: 32 a card
    level         1 where the wire is high
    active_level  the level that means on: of an input, its sensor reached
    forcing       a coil's wire that must not stay on for long: the winding would burn
    held          an input that a person holds at its active level
    """

    kind: SignalKind
    name: str
    bit: int
    level: int
    active_level: int = 1
    forcing: bool = False
    held: bool = False

    @property
    def on(self) -> bool:
        """Whether the signal is active."""
        return self.level == self.active_level

    @property
    def card_and_bit(self) -> tuple[int, int]:
        """The card that the wire is on, and the bit within it."""
        return divmod(self.bit, CARD_BITS)


class ManualControl(Protocol):
    """Control of a running machine by hand: signals, single outputs, single ticks."""

    def signals(self) -> Sequence[SignalView]:
        """All signals: inputs, then outputs, then the coils axis by axis."""

    def real_port(self) -> str:
        """The name of the port if a real machine is on it; empty for a simulated one."""

    def set_output(self, bit: int, on: bool) -> Problems:
        """Switches an output or a coil's wire, at rest and outside a job. A coil's costs the position."""

    def press_input(self, bit: int, on: bool) -> Problems:
        """Holds an input of a simulated machine at its active level, as a finger on the switch does, or lets it go;
        at any time. Refused on a real port.
        """

    def run_paused(self, text: str) -> Problems:
        """Begins a queue of commands with the clock stopped; ``tick`` and ``go`` let it run."""

    def tick(self, ticks: int) -> Problems:
        """Runs so many ticks, then stops the clock. Refused where nothing runs."""

    def go(self) -> Problems:
        """Starts the clock again. Refused where it runs."""


class PortReport(msgspec.Struct, frozen=True):
    """What a test found: facts, a line each; the sensors as they answer now; or why the port can't be used."""

    port: str
    facts: tuple[Message, ...] = ()
    inputs: tuple[tuple[str, bool], ...] = ()
    problem: Message | None = None


class PortView(msgspec.Struct, frozen=True):
    """``mode`` and ``card`` as the machine's file has them, the port of that card, and whether an option overrides it.

    configured  NAME[:ADDRESS]; empty where no port drives this card
    """

    in_use: str
    real: bool
    mode: str
    card: str
    configured: str
    overridden: bool


class PortWord(msgspec.Struct, frozen=True):
    """A port that a machine's file can name: what it is, what it needs, and why it can't be used here, if it can't."""

    name: str
    summary: Message
    needs: Message
    missing: Message | None


class PortControl(Protocol):
    """The port of the machine in use, and the change to another one."""

    def ports(self) -> Sequence[PortWord]:
        """The ports that this program drives, and whether they can be used here now."""

    def port(self) -> PortView:
        """The port in use, and the configured one."""

    def test(self) -> PortReport:
        """Opens the configured port, asks it and closes it; a port in use is asked as it is. Takes seconds."""

    def go_real(self) -> Problems:
        """Drives the machine on the configured port. Refused while something moves; then nothing changes."""

    def go_simulated(self) -> Problems:
        """Changes back to the simulated machine."""
