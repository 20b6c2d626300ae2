"""What is made of a converter's answers, and of none: silent, slow, lying; without a line and without a clock."""

from dataclasses import dataclass, field

import pytest

from drillctl.language import Message
from drillctl.machine.spindle import Spindle
from drillctl.ticker.converter.follower import SILENCE_S, Follower, Said
from drillctl.ticker.converter.lines import ConverterError, Reading

SPINDLE = Spindle(tolerance_percent=3, standstill_rev_min=60, reached_s=5, dip_s=0.5, rev_min_per_hz=60)
PERIOD_S, GREATEST_HZ = 0.125, 600.0


@dataclass
class FakeLine:
    """A converter whose motor turns ``per_turn_hz`` faster or slower with each reading."""

    per_turn_hz: float = 1000.0
    output_hz: float = 0.0
    goal_hz: float = 0.0
    tripped: int = 0
    silent: bool = False
    lie: Reading | None = None
    sent: list[float | str] = field(default_factory=list)

    def run(self, hz: float) -> None:
        self._answer()
        self.sent.append(hz)
        self.goal_hz = hz

    def stop(self) -> None:
        self._answer()
        self.sent.append("stop")
        self.goal_hz = 0.0

    def read(self) -> Reading:
        self._answer()
        way = self.goal_hz - self.output_hz
        self.output_hz += max(-self.per_turn_hz, min(self.per_turn_hz, way))
        return self.lie or Reading(self.output_hz, self.goal_hz or None, self.tripped)

    def reopen(self) -> None:
        self._answer()
        self.sent.append("reopened")

    def close(self) -> None:
        raise AssertionError("the line is whoever's that opened it")

    def _answer(self) -> None:
        if self.silent:
            raise ConverterError(Message("no answer"))


class Bench:
    def __init__(self, line: FakeLine | None = None):
        self.line = line or FakeLine()
        self.now_s = 0.0
        self.follower = Follower(self.line, SPINDLE, GREATEST_HZ, self.now_s)

    def turn(self, rev_min: int, turns: int = 1) -> Said:
        for _ in range(turns):
            self.now_s += PERIOD_S
            said = self.follower.turn(rev_min, self.now_s)
        return said


def words(said: Said) -> str:
    return str(said.wrong or "")


def test_it_is_stopped_first_and_a_speed_is_sent_once() -> None:
    b = Bench()
    assert b.turn(0) == Said(0, None, stopped=True)
    assert b.turn(30_000, 3) == Said(30_000, None, stopped=False)
    assert b.turn(24_000, 3).rev_min == 24_000
    assert b.line.sent == ["stop", 500.0, 400.0]


def test_stop_is_sent_until_the_motor_stands() -> None:
    b = Bench(FakeLine(per_turn_hz=200))
    b.turn(30_000, 5)
    assert not b.turn(0).stopped and not b.turn(0).stopped and b.turn(0).stopped
    b.turn(0, 3)
    assert b.line.sent == [500.0, "stop", "stop", "stop"]


def test_a_moment_without_an_answer_is_nothing_and_a_second_of_it_holds() -> None:
    b = Bench()
    b.turn(30_000)
    b.line.silent = True
    held = [bool(b.turn(30_000).wrong) for _ in range(12)]
    assert held.index(True) == SILENCE_S / PERIOD_S - 1 and all(held[held.index(True) :])
    assert "no answer" in words(b.turn(30_000)) and b.turn(30_000).rev_min == 30_000, "the last that was said"
    b.line.silent = False
    assert b.turn(30_000).wrong is None


def test_a_converter_whose_power_comes_back_does_not_turn_by_itself() -> None:
    b = Bench()
    b.turn(30_000)
    b.line.silent = True
    b.turn(30_000, 20)
    b.line.silent, b.line.goal_hz, b.line.output_hz = False, 0.0, 0.0
    said = b.turn(30_000, 4)
    assert said.rev_min == 0 and said.wrong is None and b.line.sent.count(500.0) == 1
    b.turn(0)
    assert b.turn(30_000).rev_min == 30_000, "asked anew it turns"


def test_a_speed_that_was_never_answered_is_not_sent_once_the_line_is_back() -> None:
    b = Bench()
    b.turn(0)
    b.line.silent = True
    b.turn(30_000, 20)
    b.line.silent = False
    assert b.turn(30_000, 3).rev_min == 0 and 500.0 not in b.line.sent


def test_a_stop_that_was_not_answered_is_sent_once_the_line_is_back() -> None:
    b = Bench()
    b.turn(30_000)
    b.line.silent = True
    b.turn(0, 20)
    b.line.silent = False
    assert b.turn(0).stopped and b.line.sent[-1] == "stop"


@pytest.mark.parametrize(
    ("reading", "wrong"),
    [
        (Reading(500.0, 500.0, 7), "fault code 7"),
        (Reading(400.0, 400.0), "400.0 Hz set where 500.0 Hz were sent"),
        (Reading(9_000.0, 500.0), "9000.0 Hz, which can't be true"),
        (Reading(-1.0, 500.0), "can't be true"),
    ],
    ids=["tripped", "limited", "impossible", "negative"],
)
def test_a_converter_that_says_what_can_not_be_holds(reading: Reading, wrong: str) -> None:
    b = Bench()
    b.turn(30_000)
    b.line.lie = reading
    assert wrong in words(b.turn(30_000, 12))
    b.line.lie = None
    assert b.turn(30_000).wrong is None


def test_a_slow_motor_and_one_that_says_it_stands_are_seen_as_they_are() -> None:
    """What comes of that decides the engine, which waits for the speed."""
    b = Bench(FakeLine(per_turn_hz=10))
    assert b.turn(30_000, 5) == Said(3_000, None, stopped=False)
    b.line.lie = Reading(0.0, 500.0)
    assert b.turn(30_000, 5) == Said(0, None, stopped=False)


def test_more_than_the_converter_gives_is_not_sent() -> None:
    b = Bench()
    b.turn(30_000)
    said = b.turn(36_001)
    assert "36001 rev/min are 600 Hz" in words(said) and b.line.sent == [500.0, "stop"]
    assert b.turn(36_000).wrong is None


def test_a_device_that_was_pulled_out_is_opened_anew() -> None:
    b = Bench()
    b.line.silent = True
    b.turn(0, 10)
    b.line.silent = False
    b.turn(0)
    assert b.line.sent == ["stop"]
    b = Bench()
    read, b.line.read = b.line.read, lambda: (_ for _ in ()).throw(ConverterError(Message("gone")))  # type: ignore
    b.turn(0, 20)
    assert b.line.sent.count("reopened") == 2
    b.line.read = read  # type: ignore
    assert b.turn(0).stopped
