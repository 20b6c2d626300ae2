"""A serial line with a Firmata board at its end: opens it, greets the board, sends and receives whole messages.

Rule: every wait is bounded; a line that is gone is PortLost, one that is too slow PortSlow; nothing is sent twice. No
thread: what has arrived is read when ``received`` is called.
"""

import select
import time
from contextlib import suppress
from typing import TypeVar

from drillctl.files import system
from drillctl.language import Message, verbatim
from drillctl.portio.firmata_protocol import FIRMWARE_QUERY, BoardMessage, Decoder, Firmware, Version
from drillctl.ports import LONGEST_WAIT_S, PortLost, PortRefused, PortSlow

OLDEST_FIRMWARE = (2, 3)
LISTEN_S = 3.0  # opening the line resets a Mega; its boot loader takes a byte sent too early for an upload
GREETING_S = 10.0
ASK_AGAIN_S = 1.0
ANSWER_S = 1.0
MOST_WAITING_BYTES = 512  # in the kernel, not yet on the wire: at 57600 baud 89 ms, far too late for a motor
MessageT = TypeVar("MessageT", bound=BoardMessage)


class FirmataLine:
    """Bytes to and from one board. ``name`` is the port as the user named it; all errors begin with it."""

    def __init__(self, name: str, device: str, baud: int):
        """Opens the device for this process alone. Raises PortRefused. On a Mega the outputs go low for 1 to 3 s."""
        import serial  # pyserial: only whoever opens a line pays for it

        self.name = name
        self._decoder = Decoder()
        self._earlier: list[BoardMessage] = []
        try:
            self._serial = serial.Serial(device, baud, timeout=0, write_timeout=LONGEST_WAIT_S, exclusive=True)
        except (OSError, ValueError) as error:
            reason = Message(
                "can't be opened ({why}); see that it is there, that nobody else has it, and your rights",
                why=verbatim(str(error)),
            )
            raise PortRefused(name, reason) from error
        # May fail: only some USB converters hold bytes back, and only some of their drivers can be set not to (OSError;
        # ValueError where the driver's answer makes no sense). NotImplementedError: pyserial can do it on Linux alone.
        with suppress(OSError, ValueError, NotImplementedError):
            self._serial.set_low_latency_mode(True)

    def greet(self, listen_s: float = LISTEN_S) -> Firmware:
        """Waits for the board's firmware message: first listens to the board starting, then asks. Raises PortRefused
        where none comes or it is too old.
        """
        firmware = self._next(Firmware, listen_s)
        gives_up = time.monotonic() + GREETING_S
        while firmware is None and time.monotonic() < gives_up:
            self.send(FIRMWARE_QUERY)
            firmware = self._next(Firmware, ASK_AGAIN_S)
        if firmware is None:
            raise PortRefused(self.name, Message("no Firmata answers; upload StandardFirmata, and check the baud rate"))
        if firmware.version < OLDEST_FIRMWARE:
            found, oldest = ("{}.{}".format(*version) for version in (firmware.version, OLDEST_FIRMWARE))
            raise PortRefused(
                self.name,
                Message(
                    "firmware {name} {found} is too old; upload {oldest} or newer",
                    name=firmware.name,
                    found=found,
                    oldest=oldest,
                ),
            )
        self._earlier.clear()  # reports and answers that an earlier run has asked for
        return firmware

    def send(self, data: bytes) -> None:
        """Sends all of the data within LONGEST_WAIT_S. Raises PortLost or PortSlow; part of it may
        have been sent then.
        """
        try:
            self._serial.write(data)
            waiting = self._serial.out_waiting
        except OSError as error:
            raise self._lost(error) from error
        if waiting > MOST_WAITING_BYTES:
            raise PortSlow(
                self.name,
                Message("too slow: {waiting} bytes wait to be sent; use fewer interrupts a second", waiting=waiting),
            )

    def send_first(self, data: bytes) -> None:
        """Like ``send``, before anything that still waits in the kernel, which is dropped."""
        try:
            self._serial.reset_output_buffer()
        except system.TERMINAL_ERRORS as error:
            raise self._lost(error) from error
        self.send(data)

    def received(self) -> list[BoardMessage]:
        """Returns the messages that have arrived since the last call, without waiting. Raises PortLost."""
        messages, self._earlier = self._earlier, []
        try:
            if waiting := self._serial.in_waiting:
                messages += self._decoder.feed(self._serial.read(waiting))
        except OSError as error:
            raise self._lost(error) from error
        return messages

    def answer(self, question: bytes, kind: type[MessageT]) -> MessageT:
        """Sends a question and waits for a message of this kind; others are left for ``received``.
        Raises PortRefused.
        """
        self.send(question)
        message = self._next(kind, ANSWER_S)
        if message is None:
            raise PortRefused(self.name, Message("the board answers no more; press its reset button and start again"))
        return message

    def forget_greetings(self) -> None:
        """Drops greetings that have arrived: those before an answer were asked for. A later one means a reset."""
        self._earlier = [message for message in self._earlier if not isinstance(message, Firmware | Version)]

    def close(self) -> None:
        """Closes the serial line to the board."""
        self._serial.close()

    def _next(self, kind: type[MessageT], wait_s: float) -> MessageT | None:
        """Returns the first message of a kind within this time, or None; all others are left for ``received``."""
        ends = time.monotonic() + wait_s
        kept: list[BoardMessage] = []
        found: MessageT | None = None
        while found is None and (left_s := ends - time.monotonic()) > 0:
            select.select([self._serial], [], [], left_s)
            for message in self.received():
                if found is None and isinstance(message, kind):
                    found = message
                else:
                    kept.append(message)
        self._earlier += kept
        return found

    def _lost(self, error: Exception) -> PortLost:
        import serial

        if isinstance(error, serial.SerialTimeoutException):
            return PortSlow(self.name, Message("too slow: the line took no more; use fewer interrupts a second"))
        return PortLost(
            self.name,
            Message(
                "the board is gone ({why}); check cable and power, then initialise again", why=verbatim(str(error))
            ),
        )
