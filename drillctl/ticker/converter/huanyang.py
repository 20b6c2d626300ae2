"""The frames of the classic Huanyang converter, which look like Modbus RTU and are not.

A frame is address, function, length of the data, data, CRC-16 as of Modbus (low byte first). Functions: 3 control
(1 run forward, 8 stop), 4 status (the number asked for and two bytes 0; the answer repeats the number before its
value), 5 set frequency in 0.01 Hz. Register facts: docs/CONVERTERS.md.
"""

import time

from drillctl.language import Message, verbatim
from drillctl.machine.converter import Converter
from drillctl.ticker.converter.lines import LINE_ERRORS, ConverterError, Reading, open_serial

CONTROL, STATUS, FREQUENCY = 3, 4, 5
RUN_FORWARD, STOP = 0x01, 0x08
SET_HZ, OUTPUT_HZ = 0, 1  # numbers of the status
PER_HZ = 100
BETWEEN_FRAMES_S = 0.006  # of silence; a frame that follows sooner is taken for part of the one before
SHORTEST, LONGEST_DATA = 6, 5


def crc16(data: bytes) -> bytes:
    """Returns the CRC of Modbus RTU, low byte first."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 if crc & 1 else crc >> 1
    return crc.to_bytes(2, "little")


def frame(address: int, function: int, data: bytes) -> bytes:
    """Returns a whole frame."""
    body = bytes((address, function, len(data))) + data
    return body + crc16(body)


def data_of(answer: bytes, address: int, function: int) -> bytes:
    """Returns the data of an answer. Raises ConverterError for one that is cut, broken, or another's."""
    if len(answer) < SHORTEST or len(answer) != 5 + answer[2]:
        raise ConverterError(Message("no whole answer: {count} bytes", count=len(answer)))
    if crc16(answer[:-2]) != answer[-2:]:
        raise ConverterError(Message("an answer whose check sum is wrong"))
    if (answer[0], answer[1]) != (address, function):
        raise ConverterError(Message("an answer to another question"))
    return answer[3:-2]


class HuanyangLine:
    """A Line (lines.Line) to a classic Huanyang."""

    def __init__(self, kind: Converter, device: str):
        """Opens the device. Raises ConverterError."""
        self._kind, self._device = kind, device
        self._serial = open_serial(device, kind)

    def run(self, hz: float) -> None:
        """Sets the frequency, then starts the motor forward. Its answer repeats the frequency."""
        wanted = round(hz * PER_HZ)
        if not 0 <= wanted <= 0xFFFF:
            raise ConverterError(Message("{hz:.0f} Hz are more than it can be told", hz=hz))
        answer = self._ask(FREQUENCY, wanted.to_bytes(2, "big"))
        if int.from_bytes(answer[-2:], "big") != wanted:
            raise ConverterError(Message("it has not taken the frequency"))
        self._ask(CONTROL, bytes((RUN_FORWARD,)))

    def stop(self) -> None:
        """Tells the converter to stop; the motor takes its ramp, so ``read`` says when it stands."""
        self._ask(CONTROL, bytes((STOP,)))

    def read(self) -> Reading:
        """Asks for the set and the output frequency. It tells no fault but by turning no more."""
        return Reading(self._status(OUTPUT_HZ), self._status(SET_HZ))

    def reopen(self) -> None:
        """Opens the device anew."""
        self.close()
        self._serial = open_serial(self._device, self._kind, again=True)

    def close(self) -> None:
        """Closes the serial device; the converter goes on with what it was told last."""
        self._serial.close()

    def _status(self, number: int) -> float:
        data = self._ask(STATUS, bytes((number, 0, 0)))
        if len(data) != 3 or data[0] != number:
            raise ConverterError(Message("an answer to another question"))
        return int.from_bytes(data[1:], "big") / PER_HZ

    def _ask(self, function: int, data: bytes) -> bytes:
        try:
            time.sleep(BETWEEN_FRAMES_S)
            self._serial.reset_input_buffer()
            self._serial.write(frame(self._kind.address, function, data))
            head = self._serial.read(3)
            rest = self._serial.read(min(head[2], LONGEST_DATA) + 2) if len(head) == 3 else b""
        except LINE_ERRORS as error:  # the last two: the device is gone, or was closed
            raise ConverterError(verbatim(str(error))) from error
        return data_of(head + rest, self._kind.address, function)
