"""What the Port screen may see and ask: the port in use, the one that the machine's file asks for, and a test of it.

Rule: as console.py has it: nothing raises for what a person did. A test moves nothing.
"""

from dataclasses import dataclass
from typing import Protocol

from drillctl.viewmodel.console import Problems


@dataclass(frozen=True, slots=True)
class PortReport:
    """What a test found: facts, a line each; the sensors as they answer now; or why the port can't be used."""

    port: str
    facts: tuple[str, ...] = ()
    inputs: tuple[tuple[str, bool], ...] = ()
    problem: str = ""


@dataclass(frozen=True, slots=True)
class PortView:
    """``mode`` and ``card`` as the machine's file has them, the port of that card, and whether an option overrides it.

    configured  NAME[:ADDRESS]; empty where no port drives this card
    """

    in_use: str
    real: bool
    mode: str
    card: str
    configured: str
    overridden: bool


class PortControl(Protocol):
    """The port of the machine in use."""

    def port(self) -> PortView:
        """Which is in use, which is configured."""

    def test(self) -> PortReport:
        """Opens the configured port, asks it, gives it back; the one in use is asked as it stands. Takes its time."""

    def go_real(self) -> Problems:
        """Drives the machine on the configured port. Refused while something moves; then nothing changes."""

    def go_simulated(self) -> Problems:
        """Back to the simulated machine."""
