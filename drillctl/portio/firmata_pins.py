"""Which pins of an Arduino carry which bits of the card, and how they are set up.

Rule: a board is a table; every pin and pull-up is set and then read back before anything else is sent. A switch closes
to ground, against a pull-up. docs/WIRING.md shows the pins.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from drillctl.language import Message
from drillctl.portio.firmata_protocol import (
    PORT_PINS,
    PORTS,
    RESET,
    DigitalReport,
    PinMode,
    PinState,
    query_pin,
    report_port,
    set_pin_mode,
    write_port,
)
from drillctl.ports import SAFE_IMAGE, PortLayout, PortRefused, bits_of

if TYPE_CHECKING:  # its serial library is loaded when such a board is opened
    from drillctl.portio.firmata_line import FirmataLine

SERIAL_PINS = (0, 1)
PORT_BYTE = (1 << PORT_PINS) - 1
ALL_CHANGED = -1


@dataclass(frozen=True)
class Board:
    """Where the card's bits are: entry n is the Firmata port (eight pins, D8p..) of card bits 8n..8n+7."""

    name: str
    outputs: tuple[int, ...]
    inputs: tuple[int, ...]

    def ports_of(self, image: int) -> list[int]:
        """Returns the ports in which an output image has bits."""
        return [port for n, port in enumerate(self.outputs) if image >> PORT_PINS * n & PORT_BYTE]


MEGA = Board("Mega", outputs=(2, 3, 4, 6), inputs=(5, 7))  # D16..D39, D48..D53, A0, A1; in D40..D47, A2..A9
UNO = Board("Uno", outputs=(0, 1, 2), inputs=(0, 1, 2))  # bit b is pin D b: D2..D13, and A0..A5 as D14..D19


class Pins:
    """The pins of one board that one machine uses. Raises PortRefused for bits that the board doesn't have."""

    def __init__(self, board: Board, layout: PortLayout, name: str):
        self._board, self._name = board, name
        self._outputs = [self._pin(board.outputs, bit) for bit in bits_of(layout.outputs)]
        self._inputs = [self._pin(board.inputs, bit) for bit in bits_of(layout.inputs)]
        if both := set(self._outputs) & set(self._inputs):
            raise PortRefused(
                name, Message("the machine's wiring has D{both} both as output and as input", both=min(both))
            )
        self._spare = [] if self._inputs else self._unused_input(board)
        used = {pin // PORT_PINS for pin in self._outputs}
        self._written = [(PORT_PINS * n, port) for n, port in enumerate(board.outputs) if port in used]
        self._pull_ups = [0] * PORTS
        for pin in self._inputs:
            self._pull_ups[pin // PORT_PINS] |= 1 << pin % PORT_PINS

    def _pin(self, ports: Sequence[int], bit: int) -> int:
        most = len(ports) * PORT_PINS
        if bit >= most:
            raise PortRefused(
                self._name,
                Message(
                    "the machine uses bit {bit}; a {name} has bits 0..{most}",
                    bit=bit,
                    name=self._board.name,
                    most=most - 1,
                ),
            )
        pin = ports[bit // PORT_PINS] * PORT_PINS + bit % PORT_PINS
        if pin in SERIAL_PINS:
            raise PortRefused(
                self._name, Message("the machine uses bit {bit}, and D{pin} is the serial line's own", bit=bit, pin=pin)
            )
        return pin

    def _unused_input(self, board: Board) -> list[int]:
        """Returns a pin that the machine leaves free, to be made an input without pull-up. A reset makes it an output,
        so it shows a reset of a board without sensors. Empty where all pins are in use.
        """
        first = PORT_PINS * board.inputs[0]
        free = set(range(first, first + PORT_PINS)) - {*self._outputs, *SERIAL_PINS}
        return sorted(free)[:1]

    def facts(self) -> tuple[Message, Message]:
        """Returns the pins that the machine uses, as text."""
        outputs, inputs = (" ".join(f"D{pin}" for pin in pins) for pins in (self._outputs, self._inputs))
        return (Message("outputs: {pins}", pins=outputs), Message("inputs with pull-up: {pins}", pins=inputs))

    def messages(self, image: int, changed: int = ALL_CHANGED) -> Iterator[bytes]:
        """Yields one message for each output port that has a changed bit.

        A port that has inputs too gets ones there: writing a zero to an input would switch its pull-up off.
        """
        for shift, port in self._written:
            if changed >> shift & PORT_BYTE:
                yield write_port(port, image >> shift & PORT_BYTE | self._pull_ups[port])

    def latched(self, inputs: int, report: DigitalReport) -> int:
        """Returns the input image with one port's report in it."""
        if report.port not in self._board.inputs:
            return inputs
        shift = PORT_PINS * self._board.inputs.index(report.port)
        value = report.value & self._pull_ups[report.port]
        return inputs & ~(PORT_BYTE << shift) | value << shift

    def prepare(self, line: "FirmataLine") -> None:
        """Sets outputs low, inputs with pull-ups and reports on, and reads every pin back. Raises PortError.

        The reset makes all digital pins outputs and low, so the inputs are set first. The board then takes all inputs
        for low: firmware 2.3 reports those that are not, newer ones report all. A report is sent in the round after the
        one that switched it on, and each pin is asked in a round of its own: with the last answer, the first reports
        have come.
        """
        ports = sorted({pin // PORT_PINS for pin in self._inputs})
        line.send(RESET)
        line.send(b"".join(set_pin_mode(pin, PinMode.INPUT) for pin in self._inputs))
        line.send(b"".join(write_port(port, self._pull_ups[port]) for port in ports))
        line.send(b"".join(set_pin_mode(pin, PinMode.OUTPUT) for pin in self._outputs))
        line.send(b"".join(self.messages(SAFE_IMAGE)))
        line.send(b"".join(map(report_port, ports)))
        line.send(b"".join(set_pin_mode(pin, PinMode.INPUT) for pin in self._spare))
        for pin in (*self._outputs, *self._inputs, *self._inputs[:1], *self._spare):
            self._check(pin, line.answer(query_pin(pin), PinState))
            line.forget_greetings()

    def witnesses(self) -> dict[int, PinState | None]:
        """Returns pins that a reset makes outputs, with what they answer until then. Where every pin is an output
        already: one of them, with None, since only its silence says anything.
        """
        inputs = (*self._inputs, *self._spare)
        return {pin: self._wanted(pin) for pin in inputs} or dict.fromkeys(self._outputs[:1])

    def _wanted(self, pin: int) -> PinState:
        mode = PinMode.OUTPUT if pin in self._outputs else PinMode.INPUT
        return PinState(pin, mode, state=int(pin in self._inputs))

    def _check(self, pin: int, answer: PinState) -> None:
        if answer != self._wanted(pin):
            pull_up = "with pull-up" if pin in self._inputs else "without pull-up"
            kind = "a low output" if pin in self._outputs else f"an input {pull_up}"
            raise PortRefused(
                self._name,
                Message("D{pin} did not become {kind}; is it StandardFirmata, unmodified?", pin=pin, kind=kind),
            )
