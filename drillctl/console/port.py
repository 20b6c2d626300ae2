"""Tests a port before anything is driven on it: who answers, which tick rate it carries, what its inputs say.

Rule: the outputs are safe from the first to the last moment, and nothing moves.
"""

import time
from collections.abc import Sequence

from drillctl.console.machine_console import MachineConsole
from drillctl.console.machine_in_use import MachineInUse
from drillctl.language import Message, message_of
from drillctl.machine import Machine
from drillctl.portio.registry import PORTS, open_port, rate_of, select
from drillctl.ports import Driver, PortError, Telling
from drillctl.ticker.launch import port_layout
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.signals import PortReport, PortView, PortWord

LISTEN_S = 0.3  # a board reports its inputs when it comes round to them
LOOK_EVERY_S = 0.01


def look_at_port(machine: Machine, spec: str) -> PortReport:
    """Opens a real port ``NAME[:ADDRESS]``, asks it and closes it. What went wrong stands in the report."""
    try:
        port, address = select(spec)
        if not address and (reason := port.missing()):
            return PortReport(spec, problem=Message("{reason}; it needs {what}", reason=reason, what=port.needs))
        driver = open_port(spec, port_layout(machine))
        try:
            facts = (port.summary, *(driver.facts() if isinstance(driver, Telling) else ()), _rate(machine, spec))
            return PortReport(spec, facts, sensors_of(machine, _listened(driver)))
        finally:
            driver.close()
    except PortError as error:
        return PortReport(spec, problem=error.message)
    except OSError as error:
        return PortReport(spec, problem=Message("{why}; check cable, power and rights", why=message_of(error)).at(spec))


def sensors_of(machine: Machine, inputs: int) -> tuple[tuple[str, bool], ...]:
    """Each sensor by name, True where it is reached, from an input image."""
    return tuple((s.name, inputs >> s.bit & 1 == s.active_level) for s in machine.input_lines)


def _listened(driver: Driver) -> int:
    """The input image, after a time in which a board has reported all its inputs."""
    until_s = time.monotonic() + LISTEN_S
    while time.monotonic() < until_s:
        driver.latch()
        time.sleep(LOOK_EVERY_S)
    return driver.latch()


def _rate(machine: Machine, spec: str) -> Message:
    most_hz = rate_of(spec, port_layout(machine))
    if most_hz is None:
        return Message("carries any rate of this program; the machine wants {hz} Hz", hz=machine.tick_hz)
    return Message(
        "carries up to {most} Hz with all axes moving; the machine wants {hz} Hz", most=most_hz, hz=machine.tick_hz
    )


class MachinePort:
    """A PortControl (viewmodel/ports.py) over the machine in use."""

    def __init__(self, console: MachineConsole):
        self._console = console

    def port(self) -> PortView:
        """The port in use, and the one that the machine's file configures."""
        return self._console.used.port

    def ports(self) -> Sequence[PortWord]:
        """The ports of the table; those of other distributions are found by their names only."""
        return [PortWord(port.name, port.summary, port.needs, port.missing()) for port in PORTS.values()]

    def test(self) -> PortReport:
        """Tests the configured port. One in use can't be opened twice: its inputs come from the status record."""
        machine, port = self._console.machine, self.port()
        if port.real:
            reached = int(self._console.link.status()["sensors"])
            inputs = tuple((sensor.name, bool(reached >> sensor.bit & 1)) for sensor in machine.input_lines)
            return PortReport(port.in_use, (Message("this port is in use: the machine runs on it"),), inputs)
        if problems := self._console.busy():
            return PortReport(port.configured, problem=problems[0])
        if not port.configured:
            problem = Message(
                "no port drives the card {card!r}; name one in its place (drillctl ports)", card=port.card
            )
            return PortReport("", problem=problem)
        return look_at_port(machine, port.configured)

    def go_real(self) -> Problems:
        """Changes to the configured port; the position is unknown afterwards."""
        return self._console.go_real()

    def go_simulated(self) -> Problems:
        """Changes to a simulated card; the position is unknown afterwards."""
        return self._console.change(MachineInUse.go_simulated)
