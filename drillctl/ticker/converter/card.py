"""A card around a port: the spindle's speed goes to a converter, and not to wires.

Rule: it is a driver as any other (ports.Driver), so the ticks, the trace and a replay know nothing of the converter.
What it shares with the converter's process lies in memory that all processes of a run have.
"""

import mmap
import time
from dataclasses import dataclass, replace
from typing import NamedTuple

from drillctl.language import Message, known_words
from drillctl.machine import Library, Machine
from drillctl.machine.converter import HUANYANG, Converter, parse_converter
from drillctl.machine.levels import SPEED_ACTUAL, SPEED_WANTED, Word
from drillctl.machine.source import Source
from drillctl.ports import SAFE_IMAGE, Driver, PortLayout, PortRefused, with_bits
from drillctl.ticker.converter.huanyang import HuanyangLine
from drillctl.ticker.converter.lines import ConverterError, Line, ModbusLine

FAULT_INPUT = "converter_fault"
BEAT_NS = 2_000_000_000  # of the converter's process; without one its speed is not known
FIRST_TRIES = 3
WANTED, ACTUAL, WRONG, LEAVE, STOPPED, BEAT = range(6)  # places in the shared memory


@dataclass(frozen=True, slots=True)
class ConverterChoice:
    """A kind of converter, the serial device that it hangs on, and the name by which its table was found."""

    kind: Converter
    device: str
    table: str = ""

    @property
    def text(self) -> str:
        """As ``choice_of`` takes it, ``TABLE:DEVICE``."""
        return f"{self.table}:{self.device}"


class _Wiring(NamedTuple):
    """Where a machine has the spindle: its two words, its switch (0 for none) and the input of its converter."""

    wanted: Word
    actual: Word
    switch: int
    fault_bit: int
    fault_level: int

    @property
    def outputs(self) -> int:
        return self.wanted.mask

    @property
    def inputs(self) -> int:
        return self.actual.mask | self.fault_bit


class ConverterCard:
    """A driver around ``inner``, which has everything but the spindle's words and the input ``converter_fault``.

    line     the line to the converter, opened before the processes part
    shared   eight-byte numbers: the places above
    """

    def __init__(self, inner: Driver, machine: Machine, choice: ConverterChoice):
        """Opens the line and asks the converter once. Raises PortRefused."""
        assert machine.spindle is not None
        self.inner, self.spindle = inner, machine.spindle
        self.greatest_hz = choice.kind.greatest_hz
        self._wiring = _wiring(machine, choice.device)
        self.shared = memoryview(mmap.mmap(-1, mmap.PAGESIZE)).cast("Q")
        self.shared[BEAT] = time.monotonic_ns()
        self.line: Line = _opened(choice)

    def latch(self) -> int:
        """Returns the port's inputs with the speed that the converter said last, and whether something is wrong."""
        shared, wiring = self.shared, self._wiring
        wrong = shared[WRONG] or time.monotonic_ns() - shared[BEAT] > BEAT_NS
        image = wiring.actual.put(self.inner.latch(), min(shared[ACTUAL], wiring.actual.greatest))
        return with_bits(image, wiring.fault_bit, wiring.fault_level if wrong else 1 - wiring.fault_level)

    def flush(self, image: int) -> None:
        """Hands the speed over, then puts the image out."""
        self._want(image)
        self.inner.flush(image)

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Hands the speed of the safe image over, then makes the port safe."""
        self._want(image)
        self.inner.safe(image)

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Closes the port; the line stays open until the motor was told to stop (process.py)."""
        self._want(image)
        self.inner.close(image)

    def _want(self, image: int) -> None:
        on = not self._wiring.switch or image & self._wiring.switch
        self.shared[WANTED] = self._wiring.wanted.value(image) if on else 0


def choice_of(text: str, library: Library) -> ConverterChoice:
    """Returns the converter that ``TABLE:DEVICE`` names. Raises PortRefused, TableError for its table."""
    name, _, device = text.partition(":")
    file = library.find("converter", name)
    if file is None or not device:
        words = known_words(name, library.names("converter"))
        reason = Message("a converter is TABLE:DEVICE, such as delta-gs20:/dev/ttyUSB0; {words}", words=words)
        raise PortRefused(f"converter:{text}", reason)
    return ConverterChoice(parse_converter(Source.read(file)), device, name)


def carried(port: Driver) -> Driver:
    """Returns the driver of the port itself, without the converter's card around it."""
    return port.inner if isinstance(port, ConverterCard) else port


def layout_without_words(layout: PortLayout, machine: Machine, choice: ConverterChoice) -> PortLayout:
    """Returns what is left for the port. Raises PortRefused for a machine whose spindle has no converter."""
    wiring = _wiring(machine, choice.device)
    return replace(
        layout, other_outputs=layout.other_outputs & ~wiring.outputs, inputs=layout.inputs & ~wiring.inputs
    )


def _wiring(machine: Machine, device: str) -> _Wiring:
    wanted, actual = machine.output_word(SPEED_WANTED), machine.input_word(SPEED_ACTUAL)
    fault = next((line for line in machine.inputs if line.name == FAULT_INPUT), None)
    if machine.spindle is None or wanted is None or actual is None or fault is None:
        fields = {"machine": machine.name, "input": FAULT_INPUT}
        reason = Message("{machine} has no converter: that takes [spindle], its words and an input {input}", **fields)
        raise PortRefused(f"converter:{device}", reason)
    switch = sum(1 << bit for name, bit in machine.outputs if name == "spindle")
    return _Wiring(wanted, actual, switch, 1 << fault.bit, fault.active_level)


def _opened(choice: ConverterChoice) -> Line:
    """Returns the line to a converter that has answered."""
    name = f"converter:{choice.device}"
    try:
        line: Line = (HuanyangLine if choice.kind.protocol == HUANYANG else ModbusLine)(choice.kind, choice.device)
    except ConverterError as error:
        raise PortRefused(name, error.message) from error
    for tried in range(FIRST_TRIES):
        try:
            line.read()
            break
        except ConverterError as error:
            if tried + 1 == FIRST_TRIES:
                line.close()
                fields = {"kind": choice.kind.name, "why": error.message, "baud": choice.kind.baud}
                reason = Message(
                    "no {kind} answers ({why}); check its power, the line, its address and {baud} baud", **fields
                )
                raise PortRefused(name, reason) from error
    return line
