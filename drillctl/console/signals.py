"""The machine under a person's hands (viewmodel/signals.py): signals, outputs, single ticks.

Rule: what is shown comes from the status record, what is asked goes down as a request; execution decides again. Created
by the screen verb.
"""

from collections.abc import Iterator

from drillctl.console.machine_console import MachineConsole
from drillctl.machine import AxisTable, Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.signals import SignalView

MOST_TICKS = 1_000_000  # asked for at once


class MachineSignals:
    """A ManualControl over the station's machine: the one in use when it is asked."""

    def __init__(self, station: MachineConsole):
        self._station = station

    def signals(self) -> list[SignalView]:
        """Of the first two cards: the status record has no more."""
        status, machine = self._station.link.status(), self._station.machine
        return signals_of(machine, int(status["sensors"]), int(status["image"]))

    def real_port(self) -> str:
        """Where there is no plant to measure there is a real machine."""
        return "" if self._station.link.measured else self._station.used.running.port

    def set_output(self, bit: int, on: bool) -> Problems:
        """Looked at here for an answer to the operator; what counts is the tick that serves it."""
        if problems := self._station.busy():
            return problems
        if bit not in {signal.bit for signal in _outputs(self._station.machine, 0)}:
            return (f"bit {bit} is no output of this machine",)
        taken = self._station.link.set_output(bit, int(on))
        return () if taken else ("too many outputs at once; try again",)

    def run_paused(self, text: str) -> Problems:
        """The clock stops first, so that no tick of the queue is missed."""
        if problems := self._station.busy():
            return problems
        self._station.link.gate.grant(0)
        if problems := self._station.run_queue(text):
            self._station.link.gate.open()
        return problems

    def tick(self, ticks: int) -> Problems:
        """A machine that runs is paused after them."""
        if not self._station.at_work:
            return ("nothing runs that could be let on by ticks",)
        if not 1 <= ticks <= MOST_TICKS:
            return (f"from 1 to {MOST_TICKS} ticks can be asked for, not {ticks}",)
        self._station.link.gate.grant(ticks)
        return ()

    def go(self) -> Problems:
        """From where it stands."""
        if not self._station.link.gate.paused:
            return ("the clock is not stopped",)
        self._station.link.gate.open()
        return ()


def signals_of(machine: Machine, reached: int, image: int) -> list[SignalView]:
    """All signals of a machine: ``reached`` by input bit, ``image`` as put out."""
    return [*_inputs(machine, reached), *_outputs(machine, image)]


def _inputs(machine: Machine, reached: int) -> Iterator[SignalView]:
    for sensor in machine.sensors:
        on = reached >> sensor.bit & 1
        level = sensor.active_level if on else 1 - sensor.active_level
        yield SignalView("input", sensor.name, sensor.bit, level, sensor.active_level)


def _outputs(machine: Machine, image: int) -> Iterator[SignalView]:
    for name, bit in machine.outputs:
        yield SignalView("output", name, bit, image >> bit & 1)
    for axis in machine.axes:
        yield from _coils(axis, image)


def _coils(axis: AxisTable, image: int) -> Iterator[SignalView]:
    for wire, bit in zip(axis.phase.wires, axis.wire_bits, strict=True):
        name = f"{axis.name}.{wire.name}"
        yield SignalView("coil", name, bit, image >> bit & 1, forcing=wire.forcing)
