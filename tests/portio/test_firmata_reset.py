"""A Firmata board that was reset while it is in use: told by its greeting, by its pins, or by its silence."""

import time
from collections.abc import Callable
from typing import Any

import pytest

from drillctl.portio import firmata_watch
from drillctl.portio.firmata import FirmataCard, open_firmata
from drillctl.portio.firmata_pins import MEGA, UNO, Pins
from drillctl.portio.firmata_protocol import DigitalReport, Firmware, PinState, Version, query_pin
from drillctl.portio.firmata_watch import Watch
from drillctl.ports import Answering, PortLayout, PortLost
from tests.portio.conformance import WIRING
from tests.portio.firmata_stand_in import StandIn

LISTEN_S = 0.05
PATIENCE_S = 3.0
BYTE_S, TICK_S = 10 / 57_600, 0.002
WANTED = {40: PinState(40, 0, 1), 41: PinState(41, 0, 1)}
BLIND = PortLayout(500, 0, (1,), 0, 0)  # a machine without sensors


def ticked(card: FirmataCard, until: Callable[[], object] = lambda: False) -> None:
    """As a ticker uses it, until something holds, or for a while."""
    ends = time.monotonic() + PATIENCE_S
    image = 0
    while not until():
        assert time.monotonic() < ends, "never came"
        card.latch()
        image ^= 0x41
        card.flush(image)
        time.sleep(TICK_S)


@pytest.mark.parametrize("wiring", [WIRING, BLIND], ids=["sensors", "none"])
@pytest.mark.parametrize(("greets", "reason"), [(True, "reported a new start"), (False, "not as it was set")])
def test_a_reset_is_a_lost_port(
    stand_in: Callable[..., StandIn], greets: bool, reason: str, wiring: PortLayout
) -> None:
    board = stand_in()
    card = open_firmata(MEGA, board.device, wiring, LISTEN_S)
    ticked(card, lambda: card.vouched > 2)
    board.reset(greets)
    with pytest.raises(PortLost, match=reason):
        ticked(card)
    card.close()


def test_a_reset_at_rest_is_found_by_latching_alone(stand_in: Callable[..., StandIn]) -> None:
    board = stand_in()
    card = open_firmata(MEGA, board.device, WIRING, LISTEN_S)
    board.reset(greets=False)
    ends = time.monotonic() + PATIENCE_S
    with pytest.raises(PortLost, match="not as it was set"):
        while time.monotonic() < ends:
            card.latch()
            time.sleep(TICK_S)
    card.close()


def test_a_board_that_hangs_is_a_lost_port(stand_in: Callable[..., StandIn], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(firmata_watch, "PATIENCE_S", 0.2)
    board = stand_in()
    card = open_firmata(MEGA, board.device, WIRING, LISTEN_S)
    board.stop()
    with pytest.raises(PortLost, match="has not answered for"):
        for _ in range(1000):
            card.latch()
            card.flush(0)
            time.sleep(TICK_S)
    card.close()


def test_greetings_that_were_asked_for_are_no_reset(stand_in: Callable[..., StandIn]) -> None:
    """A board that starts slowly greets by itself, and answers each question that came meanwhile."""
    board = stand_in(greets_again=3)
    card = open_firmata(MEGA, board.device, WIRING, LISTEN_S)
    ticked(card, lambda: card.vouched > 2)
    card.close()


class Clock:
    """Seconds, as a test sets them."""

    def __init__(self) -> None:
        self.s = 0.0

    def __call__(self) -> float:
        return self.s


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def watch(clock: Clock) -> Watch:
    return Watch("firmata:x", WANTED, BYTE_S, TICK_S, clock)


def asked(watch: Watch, clock: Clock, seconds: float, image_bytes: int = 0) -> list[tuple[int, bytes]]:
    """The questions of so many seconds of ticks, by tick; each is answered as it should be."""
    found = []
    for tick in range(round(seconds / TICK_S)):
        clock.s += TICK_S
        if question := watch.question(tick + 1, image_bytes):
            found.append((tick, question))
            watch.hear(WANTED[question[2]])
    return found


@pytest.mark.parametrize("image_bytes", [0, 6, 9], ids=["rest", "two motors", "three motors"])
def test_questions_take_a_fiftieth_of_the_line_and_ask_the_pins_in_turn(
    watch: Watch, clock: Clock, image_bytes: int
) -> None:
    questions = asked(watch, clock, 10, image_bytes)
    share = len(questions) * 4 * BYTE_S / 10
    assert share <= 0.0201
    assert len(questions) >= 10 / 0.072
    assert [question for _, question in questions[:3]] == [query_pin(40), query_pin(41), query_pin(40)]


def test_a_question_waits_for_a_tick_that_leaves_time(watch: Watch, clock: Clock) -> None:
    clock.s = 0.04
    assert not watch.question(1, image_bytes=9)
    assert watch.question(2, image_bytes=6)


def test_images_are_vouched_for_up_to_the_question(watch: Watch, clock: Clock) -> None:
    clock.s = 0.04
    assert watch.question(7, 0) == query_pin(40)
    assert watch.vouched == 0
    watch.hear(PinState(41, 0, 1))  # of another question
    assert watch.vouched == 0
    watch.hear(PinState(40, 0, 1))
    assert watch.vouched == 7


def test_an_unanswered_question_is_repeated_and_vouches_for_what_came_before_the_first(
    watch: Watch, clock: Clock
) -> None:
    clock.s = 0.04
    watch.question(7, 0)
    clock.s = 0.3
    assert not watch.question(100, 0)
    clock.s = 0.4
    assert watch.question(150, 0) == query_pin(40)
    watch.hear(PinState(40, 0, 1))
    assert watch.vouched == 7
    watch.check()


def test_an_answer_that_does_not_come_is_a_lost_port(watch: Watch, clock: Clock) -> None:
    clock.s = 0.04
    watch.question(7, 0)
    clock.s = 0.9
    watch.check()
    clock.s = 1.0
    with pytest.raises(PortLost, match=r"firmata:x: the board has not answered for 0\.9 s; check its supply"):
        watch.check()


@pytest.mark.parametrize(
    "message", [Version(2, 3), Firmware((2, 3), "S"), PinState(40, 1, 0), PinState(40, 0, 0), PinState(41, 1, 1)]
)
def test_what_only_a_board_says_that_was_reset(watch: Watch, message: Version | Firmware | PinState) -> None:
    with pytest.raises(PortLost, match="reset in mid-run"):
        watch.hear(message)


@pytest.mark.parametrize("message", [DigitalReport(5, 0), PinState(40, 0, 1), PinState(16, 1, 1)])
def test_what_a_board_may_say(watch: Watch, message: DigitalReport | PinState) -> None:
    watch.hear(message)


@pytest.mark.parametrize(
    ("board", "wiring", "wanted"),
    [
        (MEGA, WIRING, [PinState(pin, 0, 1) for pin in range(40, 46)]),
        (MEGA, BLIND, [PinState(40, 0, 0)]),
        (UNO, PortLayout(500, 0, (0b1101100,), 0, 0), [PinState(4, 0, 0)]),
        (UNO, PortLayout(500, 0, (0xFFFFC,), 0, 0), [None]),
    ],
    ids=["sensors", "no sensor", "a free pin between", "no pin left"],
)
def test_which_pins_are_asked(board: Any, wiring: PortLayout, wanted: list[PinState | None]) -> None:
    assert list(Pins(board, wiring, "firmata:x").witnesses().values()) == wanted


def test_the_card_answers_for_its_images(stand_in: Callable[..., StandIn]) -> None:
    card = open_firmata(MEGA, stand_in().device, WIRING, LISTEN_S)
    assert isinstance(card, Answering)
    assert (card.put, card.vouched) == (0, 0)
    ticked(card, lambda: card.vouched)
    assert 0 < card.vouched <= card.put
    card.close()
