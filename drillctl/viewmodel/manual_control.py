"""What is done by hand on a running machine: every signal seen live, outputs set one by one, ticks let through singly.

Rule: as console.py has it: nothing raises for what a person did, and asking never blocks. What changes the machine goes
down as a request.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from drillctl.viewmodel.console import Problems

Kind = Literal["input", "output", "coil"]


@dataclass(frozen=True, slots=True)
class SignalView:
    """One wire of the port at this moment.

    name          as in the machine's file; a coil's is ``AXIS.WIRE``
    bit           of the port image: 32 a card
    level         1 where the wire is high
    active_level  the level that means on: of an input, its sensor reached
    forcing       a coil's wire that must not stay on for long: the winding would burn
    """

    kind: Kind
    name: str
    bit: int
    level: int
    active_level: int = 1
    forcing: bool = False

    @property
    def on(self) -> bool:
        """Whether it is active."""
        return self.level == self.active_level


class ManualControl(Protocol):
    """The machine under a person's hands."""

    def signals(self) -> Sequence[SignalView]:
        """All of them: inputs, then outputs, then the coils axis by axis."""

    def real_port(self) -> str:
        """The port, where a real machine hangs on it; empty for a simulated one."""

    def set_output(self, bit: int, on: bool) -> Problems:
        """An output or a coil's wire, at rest and outside a job. A coil's costs the position."""

    def run_paused(self, text: str) -> Problems:
        """Begins a queue of commands with the clock stopped: its ticks come as they are asked for."""

    def tick(self, ticks: int) -> Problems:
        """So many ticks of what runs, then the clock waits. Refused where nothing runs."""

    def go(self) -> Problems:
        """The clock goes on by itself. Refused where it does."""
