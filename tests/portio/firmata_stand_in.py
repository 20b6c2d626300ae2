"""A board that speaks Firmata, and can be told to fail. Its own reading of the protocol, not the driver's.

``Sketch`` is the program on it, without a line; ``StandIn`` has it at the end of a pty. Used where the real firmware
(tests/firmware) is not needed: every failure, in milliseconds.
"""

import os
import select
import threading
import time
import tty
from collections.abc import Callable
from dataclasses import dataclass, field

PORTS = 16


@dataclass
class Faults:
    """What a board may do wrong."""

    version: tuple[int, int] = (2, 5)
    speaks: bool = True
    noise: bytes = b""  # sent before the first greeting
    stops_answering_pins: bool = False
    refuses_pull_ups: bool = False
    gone_after_bytes: int | None = None
    greets_again: int = 0  # so often, as what was asked before it was ready is answered


@dataclass
class Board:
    """The state that a driver can see and set."""

    modes: dict[int, int] = field(default_factory=dict)
    latches: list[int] = field(default_factory=lambda: [0] * PORTS)
    outside: list[int] = field(default_factory=lambda: [0xFF] * PORTS)
    reported: dict[int, int] = field(default_factory=dict)

    def output(self, pin: int) -> int:
        """The level of a pin, 0 unless it is an output that is on."""
        return self.latches[pin // 8] >> pin % 8 & 1 if self.modes.get(pin) == 1 else 0

    def inputs(self, port: int) -> int:
        """The levels of a port's inputs; its other pins read 0."""
        pins = (port * 8 + bit for bit in range(8))
        mask = sum(1 << pin % 8 for pin in pins if self.modes.get(pin) == 0)
        return self.outside[port] & mask


class Sketch:
    """What a board does with the bytes that come. ``say`` takes what it answers."""

    def __init__(self, faults: Faults, say: Callable[[bytes], None]):
        self.faults, self.board = faults, Board()
        self._answer = say
        self._message = bytearray()

    def start(self) -> None:
        """As it is switched on."""
        self._say(self.faults.noise + self._greeting())

    def take(self, byte: int) -> None:
        """One byte from the driver."""
        if byte == 0xFF:
            self._say(self._greeting() * self.faults.greets_again)
            self._forget()
        elif byte == 0xF7:
            self._asked(bytes(self._message))
        elif byte >= 0x80:
            self._message[:] = (byte,)
        elif self._message:
            self._message.append(byte)
            self._told()

    def reset(self, greets: bool) -> None:
        """A dip in the supply, over in no time: everything is forgotten. Whether its greeting comes through."""
        self._message.clear()
        self._forget()
        if greets:
            self._say(bytes((0xF9, *self.faults.version)) + self._greeting())

    def report(self) -> None:
        """As firmware 2.3 does: what differs from what was reported, zero at first."""
        for port, before in list(self.board.reported.items()):
            now = self.board.inputs(port)
            if now != before:
                self.board.reported[port] = now
                self._say(bytes((0x90 | port, now & 0x7F, now >> 7)))

    def _say(self, data: bytes) -> None:
        if self.faults.speaks and data:
            self._answer(data)

    def _greeting(self) -> bytes:
        name = "".join(letter + "\0" for letter in "StandIn").encode()
        return b"\xf0\x79" + bytes(self.faults.version) + name + b"\xf7"

    def _forget(self) -> None:
        self.board.modes = dict.fromkeys(range(2, PORTS * 8), 1)
        self.board.latches = [0] * PORTS
        self.board.reported.clear()

    def _told(self) -> None:
        command, *data = self._message
        port = command & 0x0F
        if command == 0xF4 and len(data) == 2:
            self._set_mode(*data)
        elif command & 0xF0 == 0x90 and len(data) == 2:
            self.board.latches[port] = data[0] | data[1] << 7
        elif command & 0xF0 == 0xD0 and len(data) == 1:
            self.board.reported[port] = 0

    def _set_mode(self, pin: int, mode: int) -> None:
        self.board.modes[pin] = mode
        self.board.latches[pin // 8] &= ~(1 << pin % 8)

    def _asked(self, question: bytes) -> None:
        if question == b"\xf0\x79":
            self._say(self._greeting())
        elif question[:2] == b"\xf0\x6d" and not self.faults.stops_answering_pins:
            pin = question[2]
            mode = self.board.modes[pin]
            state = self.board.latches[pin // 8] >> pin % 8 & 1
            if self.faults.refuses_pull_ups and mode == 0:
                state = 0
            self._say(bytes((0xF0, 0x6E, pin, mode, state, 0xF7)))


class StandIn:
    """The board at the other end of ``device``. ``received`` is all that came from the driver."""

    def __init__(self, faults: Faults | None = None):
        self.faults = faults or Faults()
        self.received = bytearray()
        self._host, self._line = os.openpty()
        tty.setraw(self._line)
        self.device = os.ttyname(self._line)
        self.sketch = Sketch(self.faults, self._say)
        self._reset: bool | None = None  # asked for: whether it greets
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    @property
    def board(self) -> Board:
        """Its pins."""
        return self.sketch.board

    def set_inputs(self, port: int, levels: int) -> None:
        """Levels from outside; reported by the board's next round."""
        self.board.outside[port] = levels

    def reset(self, greets: bool) -> None:
        """In the board's next round, which is waited for."""
        self._reset = greets
        ends = time.monotonic() + 2
        while self._reset is not None and time.monotonic() < ends:
            time.sleep(0.001)

    def _say(self, data: bytes) -> None:
        os.write(self._host, data)

    def stop(self) -> None:
        """No more reading and answering; the line stays."""
        self._over.set()
        self._thread.join(timeout=2)

    def vanish(self) -> None:
        """The board and its line are gone."""
        self.stop()
        for descriptor in (self._host, self._line):
            if descriptor >= 0:
                os.close(descriptor)
        self._host = self._line = -1

    def _run(self) -> None:
        self.sketch.start()
        while not self._over.is_set():
            if select.select([self._host], [], [], 0.002)[0]:
                for byte in os.read(self._host, 4096):
                    self.received.append(byte)
                    self.sketch.take(byte)
                if self._is_gone():
                    return
            if self._reset is not None:
                self.sketch.reset(self._reset)
                self._reset = None
            self.sketch.report()

    def _is_gone(self) -> bool:
        limit = self.faults.gone_after_bytes
        if limit is None or len(self.received) < limit:
            return False
        for descriptor in (self._host, self._line):
            os.close(descriptor)
        self._host = self._line = -1
        return True
