"""Manual control of the machine (viewmodel/signals.py): signals, outputs, single ticks.

Rule: what is shown comes from the status record; what is asked goes down as a request, and execution checks it again.
"""

from collections.abc import Iterator

from drillctl.console.machine_console import MachineConsole
from drillctl.language import Message
from drillctl.machine import AxisTable, Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.signals import SignalView

MOST_TICKS = 1_000_000  # asked for at once


class MachineSignals:
    """A ManualControl over the machine in use."""

    def __init__(self, console: MachineConsole):
        self._console = console

    def signals(self) -> list[SignalView]:
        """Every signal of the first two cards (the status record has no more), as it is now."""
        status, machine = self._console.link.status(), self._console.machine
        return signals_of(machine, int(status["sensors"]), int(status["image"]), self._console.link.held_inputs)

    def real_port(self) -> str:
        """The real port that the machine runs on; empty where it is simulated."""
        return "" if self._console.link.measured else self._console.used.running.port

    def set_output(self, bit: int, on: bool) -> Problems:
        """Asks for an output to be switched. Checked here for an answer at once, and by the tick that serves it."""
        if problems := self._console.busy():
            return problems
        if bit not in {signal.bit for signal in _outputs(self._console.machine, 0)}:
            return (Message("bit {bit} is no output of this machine", bit=bit),)
        taken = self._console.link.set_output(bit, int(on))
        return () if taken else (Message("too many outputs at once; try again"),)

    def press_input(self, bit: int, on: bool) -> Problems:
        """Holds an input at its active level, or lets it go: what the machine then does is decided by the tick."""
        line = next((line for line in self._console.machine.input_lines if line.bit == bit), None)
        if line is None:
            return (Message("bit {bit} is no input of this machine", bit=bit),)
        taken = self._console.link.hold_input(bit, line.active_level if on else None)
        return () if taken else (Message("only a simulated machine at real pace has inputs that can be pressed"),)

    def run_paused(self, text: str) -> Problems:
        """Runs a queue with the clock stopped before its first tick."""
        if problems := self._console.busy():
            return problems
        self._console.link.gate.grant(0)
        if problems := self._console.run_queue(text):
            self._console.link.gate.open()
        return problems

    def tick(self, ticks: int) -> Problems:
        """Lets so many ticks through, then stops the clock."""
        if not self._console.at_work:
            return (Message("nothing runs that could be let on by ticks"),)
        if not 1 <= ticks <= MOST_TICKS:
            return (
                Message(
                    "from 1 to {MOST_TICKS} ticks can be asked for, not {ticks}", MOST_TICKS=MOST_TICKS, ticks=ticks
                ),
            )
        self._console.link.gate.grant(ticks)
        return ()

    def go(self) -> Problems:
        """Starts a clock that was stopped."""
        if not self._console.link.gate.paused:
            return (Message("the clock is not stopped"),)
        self._console.link.gate.open()
        return ()


def signals_of(machine: Machine, reached: int, image: int, held: int = 0) -> list[SignalView]:
    """All signals of a machine: inputs by ``reached`` (a bit each, 1 where reached) and ``held``, outputs by the
    image.
    """
    return [*_inputs(machine, reached, held), *_outputs(machine, image)]


def _inputs(machine: Machine, reached: int, held: int) -> Iterator[SignalView]:
    for line in machine.input_lines:
        on = reached >> line.bit & 1
        level = line.active_level if on else 1 - line.active_level
        yield SignalView("input", line.name, line.bit, level, line.active_level, held=bool(held >> line.bit & 1))


def _outputs(machine: Machine, image: int) -> Iterator[SignalView]:
    for name, bit in machine.outputs:
        yield SignalView("output", name, bit, image >> bit & 1)
    for axis in machine.axes:
        yield from _coils(axis, image)


def _coils(axis: AxisTable, image: int) -> Iterator[SignalView]:
    for wire, bit in zip(axis.phase.wires, axis.wire_bits, strict=True):
        name = f"{axis.name}.{wire.name}"
        yield SignalView("coil", name, bit, image >> bit & 1, forcing=wire.forcing)
