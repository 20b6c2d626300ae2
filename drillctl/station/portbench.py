"""Wiring: the port of the machine in use as the Port screen sees it (panel/ports.py). Created by the screen verb."""

from drillctl.panel.console import Problems
from drillctl.panel.ports import PortReport, PortView
from drillctl.station.inuse import InUse
from drillctl.station.station import Station
from drillctl.wiring.porttest import look_at_port


class PortBench:
    """A PortDesk over the station's machine."""

    def __init__(self, station: Station):
        self._station = station

    def port(self) -> PortView:
        """From the machine's file and the options."""
        return self._station.used.port

    def test(self) -> PortReport:
        """A port in use is open already, and only one can have it: what it says is in the status record."""
        machine, port = self._station.machine, self.port()
        if port.real:
            reached = int(self._station.link.status()["sensors"])
            inputs = tuple((sensor.name, bool(reached >> sensor.bit & 1)) for sensor in machine.sensors)
            return PortReport(port.in_use, ("this port is in use: the machine runs on it",), inputs)
        if problems := self._station.busy():
            return PortReport(port.configured, problem=problems[0])
        if not port.configured:
            known = f"no port drives the card {port.card!r}; name one in its place (drillctl ports)"
            return PortReport("", problem=known)
        return look_at_port(machine, port.configured)

    def go_real(self) -> Problems:
        """After which the position is unknown."""
        return self._station.go_real()

    def go_simulated(self) -> Problems:
        """After which the position is unknown."""
        return self._station.change(InUse.go_simulated)
