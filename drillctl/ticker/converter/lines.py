"""A serial line to a frequency converter: one that speaks Modbus RTU, and what every kind of it does.

Rule: each call is one or some exchanges, each bounded by ANSWER_S; whatever goes wrong is a ConverterError that says
what. Nothing is sent twice here.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from drillctl.files.system import TERMINAL_ERRORS
from drillctl.language import Message, Refusal, verbatim
from drillctl.machine.converter import Converter, Frequency, Write

if TYPE_CHECKING:
    import serial

LINE_ERRORS: tuple[type[Exception], ...] = (*TERMINAL_ERRORS, ValueError, TypeError)
MOST_DRAINS = 5
LONGEST_ANSWER = 256
ANSWER_S = 0.2  # a wire of 9600 baud takes 10 ms for an exchange, a converter up to 100 ms to answer


class ConverterError(Refusal, OSError):
    """An exchange that failed. ``str()`` says what went wrong."""

    kind = "converter"


@dataclass(frozen=True, slots=True)
class Reading:
    """What a converter says: the frequency that it puts out, the one that it holds as set (None where it can't tell),
    and the code of its fault, 0 for none.
    """

    output_hz: float
    set_hz: float | None = None
    tripped: int = 0


class Line(Protocol):
    """A line to one converter. All methods raise ConverterError."""

    def run(self, hz: float) -> None:
        """Sets the frequency, then starts the motor forward."""

    def stop(self) -> None:
        """Tells the converter to stop; the motor takes its ramp, so ``read`` says when it stands."""

    def read(self) -> Reading:
        """Asks what it does."""

    def reopen(self) -> None:
        """Opens the device anew, after it was pulled out."""

    def close(self) -> None:
        """Gives the device back."""


def open_serial(device: str, kind: Converter, again: bool = False) -> "serial.Serial":
    """Opens a converter's device for this process and those forked off it. Raises ConverterError.

    again  the other processes of this run still have it open, and with that its lock
    """
    import serial  # pyserial: only whoever opens a line pays for it

    try:
        return serial.Serial(
            device, kind.baud, parity=kind.parity, stopbits=kind.stop_bits, timeout=ANSWER_S,
            write_timeout=ANSWER_S, exclusive=not again,
        )  # fmt: skip
    except (OSError, ValueError) as error:
        reason = Message(
            "{device} can't be opened ({why}); see that it is there, that nobody else has it, and your rights",
            device=device,
            why=verbatim(str(error)),
        )
        raise ConverterError(reason) from error


class ModbusLine:
    """A Line to a converter that is described by registers."""

    def __init__(self, kind: Converter, device: str):
        """Opens the device. Raises ConverterError, also where minimalmodbus is not installed."""
        try:
            import minimalmodbus
        except ImportError as error:
            reason = Message("Modbus needs minimalmodbus; install it: pip install 'drillctl[modbus]'")
            raise ConverterError(reason) from error
        self._minimalmodbus, self._kind, self._device = minimalmodbus, kind, device
        self._serial = open_serial(device, kind)
        self._instrument = self._made()
        self._failed = False

    def _made(self) -> "object":
        instrument = self._minimalmodbus.Instrument(self._serial, self._kind.address)
        instrument.clear_buffers_before_each_transaction = True  # an answer that came too late is not the next one's
        return instrument

    def run(self, hz: float) -> None:
        """Writes the frequency, then what starts the motor."""
        assert self._kind.speed is not None
        self._call("write_register", self._kind.speed.register, round(hz * self._kind.speed.per_hz), functioncode=6)
        self._write(self._kind.run)

    def stop(self) -> None:
        """Writes what stops the motor."""
        self._write(self._kind.stop)

    def read(self) -> Reading:
        """Reads the output frequency, and the set one and the fault where there are registers for them."""
        kind = self._kind
        assert kind.output is not None
        tripped = 0
        if kind.tripped is not None:
            answer = self._call("read_register", kind.tripped.register, functioncode=kind.tripped.function)
            tripped = int(answer) & kind.tripped.mask
        set_hz = None if kind.set is None else self._frequency(kind.set)
        return Reading(self._frequency(kind.output), set_hz, tripped)

    def reopen(self) -> None:
        """Opens the device anew."""
        self.close()
        self._serial = open_serial(self._device, self._kind, again=True)
        self._instrument = self._made()

    def close(self) -> None:
        """Closes the serial device; the converter goes on with what it was told last."""
        self._serial.close()

    def _frequency(self, place: Frequency) -> float:
        return int(self._call("read_register", place.register, functioncode=place.function)) / place.per_hz

    def _write(self, writes: tuple[Write, ...]) -> None:
        for each in writes:
            name = "write_bit" if each.function == 5 else "write_register"
            self._call(name, each.register, each.value, functioncode=each.function)

    def _call(self, name: str, *values: int, functioncode: int) -> int:
        """One exchange. minimalmodbus raises OSError for no and for wrong answers, ValueError for numbers that a
        register can't hold; pyserial a terminal's error for a device that is gone, TypeError for one that was closed.
        """
        try:
            if self._failed:
                self._let_it_fall_silent()
            answer = getattr(self._instrument, name)(*values, functioncode=functioncode)
        except LINE_ERRORS as error:
            self._failed = True
            raise ConverterError(verbatim(str(error) or type(error).__name__)) from error
        return 0 if answer is None else int(answer)

    def _let_it_fall_silent(self) -> None:
        """Reads what still comes after a failure: Modbus doesn't say which question an answer belongs to, and one that
        is late would be taken for that of the next.
        """
        for _ in range(MOST_DRAINS):
            if not self._serial.read(LONGEST_ANSWER):
                self._failed = False
                return
