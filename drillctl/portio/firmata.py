"""An Arduino with unmodified StandardFirmata as the card: a Mega for 32 outputs and 16 inputs, an Uno for small drills.

Rule: of an output image only the ports (of eight pins) that changed are sent, three bytes each; so a motor whose wires
are in one port costs least, and its wires change together. A rate that the line can't carry is refused before it is
opened. A board that was reset is a lost port.

firmata_line.py has the serial line, firmata_protocol.py the bytes, firmata_pins.py the pins, firmata_watch.py the
questions by which a reset is noticed.
"""

from collections.abc import Iterable
from contextlib import suppress

from drillctl.language import Message
from drillctl.portio.firmata_line import LISTEN_S, FirmataLine
from drillctl.portio.firmata_pins import Board, Pins
from drillctl.portio.firmata_protocol import MESSAGE_BYTES, DigitalReport, Firmware
from drillctl.portio.firmata_watch import Watch
from drillctl.ports import SAFE_IMAGE, PortLayout, PortRefused

BAUD = 57_600  # StandardFirmata's own; another rate is given as DEVICE@BAUD
SLOWEST_BAUD, FASTEST_BAUD = 300, 4_000_000
BITS_A_BYTE = 10  # on the wire: start, eight, stop
USABLE_PERCENT = 95


class FirmataCard:
    """A driver (ports.Driver, ports.Answering) for a board whose pins have been set up.

    put  images put out so far
    """

    def __init__(self, line: FirmataLine, pins: Pins, firmware: Firmware, watch: Watch):
        self._line, self._pins, self._firmware, self._watch = line, pins, firmware, watch
        self.put = 0
        self._latched = False  # since the last image: a question is sent only where its answer is read
        self._outputs = SAFE_IMAGE
        self._inputs = 0

    def facts(self) -> tuple[Message, ...]:
        """Returns which firmware answered, and which pins are set up (ports.Telling)."""
        version = "{}.{}".format(*self._firmware.version)
        return (Message("{name} {version} answers", name=self._firmware.name, version=version), *self._pins.facts())

    def latch(self) -> int:
        """Returns the inputs as last reported; a change takes 0.5 ms on the wire. Raises PortLost, also for a board
        that was reset.
        """
        for message in self._line.received():
            self._watch.hear(message)
            if isinstance(message, DigitalReport):
                self._inputs = self._pins.latched(self._inputs, message)
        self._watch.check()
        if self._latched and (question := self._watch.question(self.put, 0)):  # at rest nothing is put out
            self._line.send(question)
        self._latched = True
        return self._inputs

    def flush(self, image: int) -> None:
        """Sends the ports that differ from what was sent last, and a question where one is due. Raises PortLost."""
        data = b"".join(self._pins.messages(image, image ^ self._outputs))
        self.put += 1
        if self._latched:
            data += self._watch.question(self.put, len(data))
        self._latched = False
        if data:
            self._line.send(data)
        self._outputs = image

    def safe(self, image: int = SAFE_IMAGE) -> None:
        """Sends the safe image to every output port, whatever was sent before. Raises PortLost."""
        self._watch.forget()
        self._line.send_first(b"".join(self._pins.messages(image)))
        self._outputs = image

    @property
    def vouched(self) -> int:
        """How many of the images were put out before the board's last right answer."""
        return self._watch.vouched

    def close(self, image: int = SAFE_IMAGE) -> None:
        """Makes the outputs safe, if the board still answers, and closes the line."""
        with suppress(OSError):
            self.safe(image)
        self._line.close()


def open_firmata(board: Board, address: str, layout: PortLayout, listen_s: float = LISTEN_S) -> FirmataCard:
    """Opens ``[DEVICE][@BAUD]``, waits for the board's greeting and sets its pins up. Raises PortRefused; PortLost
    where the board goes away meanwhile.

    listen_s  how long to wait for the board's own greeting before asking for it
    """
    device, baud = _split(address)
    device = device or _only_device()
    name = f"firmata:{device}"
    pins = Pins(board, layout, name)
    line = FirmataLine(name, device, baud)
    try:
        firmware = line.greet(listen_s)
        pins.prepare(line)
    except BaseException:
        line.close()
        raise
    watch = Watch(name, pins.witnesses(), BITS_A_BYTE / baud, 1 / layout.tick_hz)
    return FirmataCard(line, pins, firmware, watch)


def max_tick_hz(board: Board, address: str, layout: PortLayout, moving_axes: Iterable[int]) -> int | None:
    """Returns the most ticks a second that the line carries while these axes move; None where nothing is sent."""
    ports = {port for axis in moving_axes for port in board.ports_of(layout.axis_outputs[axis])}
    _, baud = _split(address)
    bytes_a_second = baud // BITS_A_BYTE * USABLE_PERCENT // 100
    return bytes_a_second // (MESSAGE_BYTES * len(ports)) if ports else None


def usb_devices() -> list[str]:
    """Returns the serial lines at USB, where an Arduino would be."""
    from serial.tools.list_ports import comports

    return sorted(found.device for found in comports() if found.vid is not None)


def _split(address: str) -> tuple[str, int]:
    device, at, baud = address.rpartition("@")
    if not at:
        return address, BAUD
    if not baud.isdecimal() or not SLOWEST_BAUD <= int(baud) <= FASTEST_BAUD:
        raise PortRefused(
            f"firmata:{address}",
            Message(
                "{baud!r} is no baud rate: {least} to {most}",
                baud=baud,
                least=SLOWEST_BAUD,
                most=FASTEST_BAUD,
            ),
        )
    return device, int(baud)


def _only_device() -> str:
    found = usb_devices()
    if len(found) != 1:
        there = ", ".join(found) or "none"
        raise PortRefused(
            "firmata", Message("which serial line? At USB there is {there}; name it: firmata:/dev/ttyACM0", there=there)
        )
    return found[0]
