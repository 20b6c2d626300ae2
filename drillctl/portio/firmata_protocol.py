"""The Firmata protocol as bytes, and nothing else: messages out, messages in. No port, no clock, no waiting.

Rule: there is no checksum and no acknowledgement, so the decoder never raises: it skips what it can't understand, and
the next whole message is understood again. Source: protocol.md of the firmata/protocol project, version 2.5.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

DIGITAL_MESSAGE = 0x90  # | port, low seven bits, high bit: eight pins at once, either way
REPORT_DIGITAL = 0xD0  # | port, 0 or 1
SET_PIN_MODE = 0xF4
REPORT_VERSION = 0xF9  # major, minor
START_SYSEX, END_SYSEX = 0xF0, 0xF7
PIN_STATE_QUERY, PIN_STATE_RESPONSE = 0x6D, 0x6E
REPORT_FIRMWARE = 0x79
PORTS, PORT_PINS = 16, 8
MESSAGE_BYTES = 3
LONGEST_SYSEX_BYTES = 1024

RESET = b"\xff"
FIRMWARE_QUERY = bytes((START_SYSEX, REPORT_FIRMWARE, END_SYSEX))


class PinMode(IntEnum):
    """What a pin is used for."""

    INPUT = 0
    OUTPUT = 1


@dataclass(frozen=True, slots=True)
class DigitalReport:
    """The levels of the eight pins of a port; pins that are no inputs read 0."""

    port: int
    value: int


@dataclass(frozen=True, slots=True)
class Firmware:
    """Name and version of the program on the board; versions are compared as (major, minor)."""

    version: tuple[int, int]
    name: str


@dataclass(frozen=True, slots=True)
class Version:
    """The protocol's version: a board that starts sends it unasked, before its firmware."""

    major: int
    minor: int


@dataclass(frozen=True, slots=True)
class PinState:
    """A pin's mode, and what was last written to it: for an input, 1 where its pull-up is on."""

    pin: int
    mode: int
    state: int


BoardMessage = DigitalReport | Firmware | PinState | Version


def write_port(port: int, value: int) -> bytes:
    """Returns the message that sets the eight pins of a port; for inputs it switches the pull-ups."""
    return bytes((DIGITAL_MESSAGE | port, value & 0x7F, value >> 7 & 1))


def report_port(port: int) -> bytes:
    """Returns the message after which the board reports changes of this port's inputs."""
    return bytes((REPORT_DIGITAL | port, 1))


def set_pin_mode(pin: int, mode: PinMode) -> bytes:
    """Returns the message that makes a pin an input or an output; an output starts low."""
    return bytes((SET_PIN_MODE, pin, mode))


def query_pin(pin: int) -> bytes:
    """Returns the message that asks for a pin's PinState."""
    return bytes((START_SYSEX, PIN_STATE_QUERY, pin, END_SYSEX))


class Decoder:
    """Turns bytes from a board, in pieces of any size, into messages.

    State: the message begun. A byte of 0x80 and above begins a new one, whatever came before; the others are data.
    """

    def __init__(self) -> None:
        self._begun = bytearray()

    def feed(self, data: bytes) -> list[BoardMessage]:
        """Returns the messages that these bytes complete, in order. Never raises."""
        complete = (self._take(byte) for byte in data)
        return [message for message in complete if message is not None]

    def _take(self, byte: int) -> BoardMessage | None:
        """Takes one byte; returns the message that it completes, or None."""
        if byte >= 0x80 and byte != END_SYSEX:
            self._begun[:] = (byte,)
            return None
        self._begun.append(byte)
        if byte == END_SYSEX:
            return self._ended(_sysex)
        if len(self._begun) == MESSAGE_BYTES and (read := _short_message(self._begun[0])):
            return self._ended(read)
        if len(self._begun) > LONGEST_SYSEX_BYTES or self._begun[0] < 0x80:
            self._begun.clear()
        return None

    def _ended(self, read: Callable[[bytearray], BoardMessage | None]) -> BoardMessage | None:
        message = read(self._begun)
        self._begun.clear()
        return message


def _short_message(command: int) -> Callable[[bytearray], BoardMessage] | None:
    """Returns the reader of a message of three bytes, by its first byte; None for a longer or unknown message."""
    if command & 0xF0 == DIGITAL_MESSAGE:
        return _digital
    return _version if command == REPORT_VERSION else None


def _version(begun: bytearray) -> Version:
    return Version(begun[1], begun[2])


def _digital(begun: bytearray) -> DigitalReport:
    command, low, high = begun
    return DigitalReport(command & 0x0F, low | (high & 1) << 7)


def _sysex(begun: bytearray) -> BoardMessage | None:
    """Returns the message from START_SYSEX to END_SYSEX, or None for a cut or unknown one."""
    if len(begun) < 5 or begun[0] != START_SYSEX:
        return None
    kind, first, second, *data = begun[1:-1]
    if kind == REPORT_FIRMWARE:
        return Firmware((first, second), _text(data))
    if kind == PIN_STATE_RESPONSE and data:
        return PinState(first, second, _number(data))
    return None


def _text(data: list[int]) -> str:
    """Decodes a text of two bytes a character: low seven bits, high bit."""
    pairs = zip(data[::2], data[1::2], strict=False)
    return "".join(chr(low | (high & 1) << 7) for low, high in pairs)


def _number(data: list[int]) -> int:
    """Decodes a number of seven bits a byte, lowest first."""
    return sum(byte << 7 * place for place, byte in enumerate(data))
