"""The Firmata card when things go wrong: no board, an old one, one that goes away, one that takes nothing more."""

import time
from collections.abc import Callable
from contextlib import suppress

import pytest

from drillctl.portio import firmata_line
from drillctl.portio.firmata import FirmataCard, max_tick_hz, open_firmata, usb_devices
from drillctl.portio.firmata_pins import MEGA, UNO, Board
from drillctl.ports import LONGEST_WAIT_S, PortError, PortLayout, PortLost, PortRefused, PortSlow
from tests.portio.conformance import MOTOR, WIRING
from tests.portio.firmata_stand_in import StandIn

LISTEN_S = 0.05
LONGEST_OPENING_S = 3.0


@pytest.fixture(autouse=True)
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("GREETING_S", "ASK_AGAIN_S", "ANSWER_S"):
        monkeypatch.setattr(firmata_line, name, 0.2)


def opened(board: StandIn) -> FirmataCard:
    return open_firmata(MEGA, board.device, WIRING, LISTEN_S)


@pytest.mark.parametrize(
    ("faults", "reason"),
    [
        ({"speaks": False}, "no Firmata answers; upload StandardFirmata"),
        ({"version": (2, 2)}, r"StandIn 2\.2 is too old; upload 2\.3 or newer"),
        ({"version": (1, 9)}, r"1\.9 is too old"),
        ({"stops_answering_pins": True}, "answers no more"),
        ({"refuses_pull_ups": True}, "D40 did not become an input with pull-up"),
    ],
)
def test_a_board_that_will_not_do_is_refused(
    stand_in: Callable[..., StandIn], faults: dict[str, object], reason: str
) -> None:
    board = stand_in(**faults)
    with pytest.raises(PortRefused, match=reason):
        opened(board)
    assert not any(board.board.output(pin) for pin in range(16, 56))


@pytest.mark.parametrize("version", [(2, 3), (2, 4), (2, 5), (2, 10), (3, 0)])
def test_versions_that_will_do(stand_in: Callable[..., StandIn], version: tuple[int, int]) -> None:
    opened(stand_in(version=version)).close()


def test_noise_before_the_greeting_does_no_harm(stand_in: Callable[..., StandIn]) -> None:
    card = opened(stand_in(noise=bytes(range(256))))
    card.flush(1)
    card.close()


def test_no_output_is_made_before_it_is_low(stand_in: Callable[..., StandIn]) -> None:
    """Only zeros go to output ports until the card is handed out."""
    board = stand_in()
    card = opened(board)
    sent = bytes(board.received)
    for port in (2, 3, 4, 6):
        parts = sent.split(bytes((0x90 | port,)))[1:]
        assert parts and all(part[:2] == b"\0\0" for part in parts)
    card.close()


@pytest.mark.parametrize("after_bytes", [1, 3, 4, 20, 60, 100, 150, 190])
def test_a_board_that_goes_away_while_it_is_opened(stand_in: Callable[..., StandIn], after_bytes: int) -> None:
    began = time.monotonic()
    with pytest.raises(PortError):
        opened(stand_in(gone_after_bytes=after_bytes))
    assert time.monotonic() - began < LONGEST_OPENING_S


CALLS: dict[str, Callable[[FirmataCard], object]] = {
    "latch": lambda card: card.latch(),
    "flush": lambda card: card.flush(0x41),
    "safe": lambda card: card.safe(),
}


@pytest.mark.parametrize("call", CALLS)
def test_a_board_that_is_gone_is_a_lost_port_at_every_call(stand_in: Callable[..., StandIn], call: str) -> None:
    board = stand_in()
    card = opened(board)
    board.vanish()
    for _ in range(2):
        with pytest.raises(PortLost, match="initialise again"):
            CALLS[call](card)
    card.close()


def test_a_line_that_takes_no_more_is_lost_within_its_time(stand_in: Callable[..., StandIn]) -> None:
    board = stand_in()
    card = opened(board)
    board.stop()
    slowest_s, images = 0.0, 0
    with pytest.raises(PortSlow, match="too slow"):
        for images in range(100_000):
            began = time.monotonic()
            try:
                card.flush(images & MOTOR)
            finally:
                slowest_s = max(slowest_s, time.monotonic() - began)
    assert images > 100
    assert slowest_s < 4 * LONGEST_WAIT_S  # the wait itself, and a busy computer
    with suppress(PortLost):
        card.safe()  # returns or raises, and does not hang
    card.close()


def test_only_changed_ports_are_sent(stand_in: Callable[..., StandIn]) -> None:
    board = stand_in()
    card = opened(board)
    settle(board)
    before = len(board.received)
    for image in (0x41, 0x41, 0x2041, 0x2041, 0x012041):
        card.flush(image)
    settle(board)
    assert bytes(board.received[before:]).hex(" ") == "92 41 00 93 20 00 94 01 00"
    card.close()


def settle(board: StandIn) -> None:
    """Until nothing more comes."""
    count = -1
    while count != len(board.received):
        count = len(board.received)
        time.sleep(0.03)


@pytest.mark.parametrize(
    ("board", "wiring", "reason"),
    [
        (MEGA, PortLayout(500, 0, (1 << 32,), 0, 0), r"bit 32; a Mega has bits 0\.\.31"),
        (MEGA, PortLayout(500, 0, (1,), 0, 1 << 16), r"bit 16; a Mega has bits 0\.\.15"),
        (UNO, PortLayout(500, 0, (0b10,), 0, 0), "D1 is the serial line's own"),
        (UNO, PortLayout(500, 0, (1 << 9,), 0, 1 << 9), "D9 both as output and as input"),
    ],
)
def test_wiring_that_a_board_does_not_have(board: Board, wiring: PortLayout, reason: str) -> None:
    with pytest.raises(PortRefused, match=reason):
        open_firmata(board, "/dev/null", wiring)


@pytest.mark.parametrize("device", ["/dev/null", "/nonexistent/tty", "/"])
def test_what_is_no_serial_line(device: str) -> None:
    with pytest.raises(PortRefused, match="can't be opened"):
        open_firmata(MEGA, device, WIRING)


@pytest.mark.parametrize("baud", ["fast", "", "0", "-9600", "99999999"])
def test_what_is_no_baud_rate(baud: str) -> None:
    with pytest.raises(PortRefused, match="no baud rate"):
        open_firmata(MEGA, f"/dev/ttyACM0@{baud}", WIRING)


def test_without_a_device_there_must_be_just_one(monkeypatch: pytest.MonkeyPatch) -> None:
    for found in ([], ["/dev/ttyACM0", "/dev/ttyUSB0"]):
        monkeypatch.setattr("drillctl.portio.firmata.usb_devices", lambda found=found: found)
        with pytest.raises(PortRefused, match="which serial line"):
            open_firmata(MEGA, "", WIRING)
    assert isinstance(usb_devices(), list)


@pytest.mark.parametrize(
    ("address", "axes", "wanted_hz"),
    [
        ("", (0, 1, 2), 5472 // 9),
        ("", (0, 1), 5472 // 6),
        ("/dev/ttyACM0", (2,), 5472 // 3),
        ("/dev/ttyACM0@115200", (0, 1, 2), 10944 // 9),
        ("", (), None),
    ],
)
def test_the_rate_that_a_line_carries(address: str, axes: tuple[int, ...], wanted_hz: int | None) -> None:
    """57600 baud are 5760 bytes a second, 95 % of them 5472; each moving motor costs three a tick."""
    assert max_tick_hz(MEGA, address, WIRING, axes) == wanted_hz


def test_motors_that_share_a_port_cost_one_message() -> None:
    shared = PortLayout(500, 0, (0b0000_1111, 0b1111_0000), 0, 0)
    assert max_tick_hz(MEGA, "", shared, (0, 1)) == 5472 // 3
