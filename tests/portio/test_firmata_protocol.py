"""The Firmata codec: whatever comes, however it is cut, it never raises, and the next whole message is understood."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.portio.firmata_protocol import (
    LONGEST_SYSEX_BYTES,
    BoardMessage,
    Decoder,
    DigitalReport,
    Firmware,
    PinMode,
    PinState,
    Version,
    query_pin,
    report_port,
    set_pin_mode,
    write_port,
)

SEVEN_BITS = st.integers(0, 127)


def text_bytes(text: str) -> bytes:
    return bytes(byte for letter in text for byte in (ord(letter) & 0x7F, ord(letter) >> 7))


def as_sent(message: BoardMessage) -> bytes:
    """What a board sends for a message; written from the protocol's description, not from the decoder."""
    match message:
        case DigitalReport(port, value):
            return bytes((0x90 + port, value % 128, value // 128))
        case Firmware(version, name):
            return b"\xf0\x79" + bytes(version) + text_bytes(name) + b"\xf7"
        case PinState(pin, mode, state):
            return bytes((0xF0, 0x6E, pin, mode, state % 128, state // 128, 0xF7))
        case Version(major, minor):
            return bytes((0xF9, major, minor))


messages = st.one_of(
    st.builds(DigitalReport, st.integers(0, 15), st.integers(0, 255)),
    st.builds(Firmware, st.tuples(SEVEN_BITS, SEVEN_BITS), st.text(st.characters(max_codepoint=255), max_size=20)),
    st.builds(Version, SEVEN_BITS, SEVEN_BITS),
    st.builds(PinState, SEVEN_BITS, SEVEN_BITS, st.integers(0, 2**14 - 1)),
)


@pytest.mark.parametrize(
    ("sent", "wanted"),
    [
        (write_port(2, 0), "92 00 00"),
        (write_port(3, 0xFF), "93 7f 01"),
        (write_port(4, 0x80), "94 00 01"),
        (report_port(5), "d5 01"),
        (set_pin_mode(40, PinMode.INPUT), "f4 28 00"),
        (set_pin_mode(16, PinMode.OUTPUT), "f4 10 01"),
        (query_pin(40), "f0 6d 28 f7"),
    ],
)
def test_what_is_sent(sent: bytes, wanted: str) -> None:
    assert sent.hex(" ") == wanted


@given(st.lists(messages), st.lists(st.integers(1, 9), min_size=1))
def test_messages_come_through_however_they_are_cut(sent: list[BoardMessage], lengths: list[int]) -> None:
    stream = b"".join(map(as_sent, sent))
    decoder, received, start, turn = Decoder(), list[BoardMessage](), 0, 0
    while start < len(stream):
        length = lengths[turn % len(lengths)]
        received += decoder.feed(stream[start : start + length])
        start, turn = start + length, turn + 1
    assert received == sent


@given(st.lists(st.binary(max_size=200)))
def test_nothing_raises(pieces: list[bytes]) -> None:
    decoder = Decoder()
    for piece in pieces:
        assert all(isinstance(message, BoardMessage) for message in decoder.feed(piece))


@given(st.binary(max_size=80), messages)
def test_after_noise_the_next_whole_message_is_understood(noise: bytes, message: BoardMessage) -> None:
    assert Decoder().feed(noise + as_sent(message))[-1] == message


@given(messages, messages, st.data())
def test_a_cut_message_is_lost_and_no_other(first: BoardMessage, second: BoardMessage, data: st.DataObject) -> None:
    whole = as_sent(first)
    cut = whole[: data.draw(st.integers(0, len(whole) - 1))]
    assert Decoder().feed(cut + as_sent(second)) == [second]


def test_an_endless_message_is_dropped_and_takes_no_memory() -> None:
    decoder = Decoder()
    assert decoder.feed(b"\xf0\x79" + bytes(100 * LONGEST_SYSEX_BYTES) + b"\xf7") == []
    assert decoder.feed(b"\x92\x01\x00") == [DigitalReport(2, 1)]


@pytest.mark.parametrize(
    "unknown", ["e0 01 02", "f9 02", "f0 71 48 00 f7", "f0 f7", "f0 6e 01 f7", "f7 f7", "01 02 03"]
)
def test_messages_of_no_interest_are_skipped(unknown: str) -> None:
    assert Decoder().feed(bytes.fromhex(unknown)) == []
