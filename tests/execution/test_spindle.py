"""KMD_WRZECIONO where the spindle's speed is measured: it waits for the speed, and a speed that is lost is a fault."""

from dataclasses import replace

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine
from drillctl.trace import first_difference
from tests.support.bench import Bench, shipped
from tests.support.twins import remembered, trace, twins

WANTED, REACH_TICKS, DIP_TICKS = 30_000, 80, 40
HELD = "converter_fault"


def machine() -> Machine:
    plain = shipped("eight-axis")
    assert plain.spindle is not None
    times = replace(plain.spindle, reached_s=REACH_TICKS / plain.tick_hz, dip_s=DIP_TICKS / plain.tick_hz)
    return replace(plain, spindle=times)


def bench(queue: str) -> Bench:
    return Bench(machine()).queue(queue)


def turn_at(b: Bench, rev_min: int | None) -> None:
    """The spindle turns at this speed, whatever is wanted; None: as it is wanted."""
    (word,) = b.machine.input_words
    value = 0 if rev_min is None else word.put(0, rev_min)
    b.card.stuck_high, b.card.stuck_low = value, 0 if rev_min is None else word.mask & ~value


@pytest.mark.parametrize(
    ("rev_min", "reached"), [(WANTED, True), (29_100, True), (29_099, False), (30_900, True), (30_901, False)]
)
def test_the_command_waits_until_the_speed_is_within_its_tolerance(rev_min: int, reached: bool) -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_CZEKAJ 500")
    turn_at(b, 0)
    b.tick(REACH_TICKS // 2)
    assert b.m.done == 0 and b.m.fault == Fault.NONE
    turn_at(b, rev_min)
    b.tick(3)
    assert (b.m.done == 1) == reached


@pytest.mark.parametrize(("rev_min", "stands"), [(60, True), (61, False)])
def test_off_is_a_wait_for_the_standstill(rev_min: int, stands: bool) -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_WRZECIONO 0; KMD_CZEKAJ 500")
    b.done_at(1)
    turn_at(b, rev_min)
    b.tick(4)
    assert (b.m.done == 2) == stands and not b.m.image
    if not stands:
        b.finish()
        assert b.m.fault == Fault.SPINDLE_SPEED


def test_a_speed_that_is_not_reached_in_time_is_a_fault_in_its_tick_and_the_spindle_stops() -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_RUCHd x=100")
    turn_at(b, 29_000)
    b.finish()
    assert b.m.fault == Fault.SPINDLE_SPEED and b.m.tick - REACH_TICKS in range(3) and b.m.axes[0].made == 0
    assert not b.m.image


@pytest.mark.parametrize(("ticks", "lost"), [(DIP_TICKS, False), (DIP_TICKS + 2, True)])
def test_a_speed_that_was_reached_may_be_missed_for_so_long(ticks: int, lost: bool) -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_CZEKAJ 500")
    b.done_at(1)
    turn_at(b, 20_000)
    b.tick(ticks)
    turn_at(b, None)
    b.tick(2 * DIP_TICKS)
    assert (b.m.fault == Fault.SPINDLE_LOST) == lost and bool(b.m.image) != lost


def test_a_silent_converter_holds_the_job_and_its_speed_is_not_looked_at_until_it_goes_on() -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_RUCHd x=400; KMD_CZEKAJ 5")
    b.until(lambda: b.m.axes[0].made > 20)
    turn_at(b, 0)
    b.card.stuck_low |= b.input_bit(HELD)
    b.tick(20 * DIP_TICKS)
    assert b.m.condition == Condition.HOLDING and not b.m.moving and b.m.fault == Fault.NONE
    b.ask(Request.RESUME).tick(DIP_TICKS)
    assert b.m.condition == Condition.HOLDING, "it is silent still"
    turn_at(b, None)
    b.ask(Request.RESUME).finish()
    assert b.m.fault == Fault.NONE and b.m.axes[0].position == 400


@pytest.mark.parametrize("request_made", [Request.STOP, Request.ESTOP])
def test_every_stop_takes_speed_and_spindle_off(request_made: Request) -> None:
    b = bench(f"KMD_WRZECIONO {WANTED}; KMD_RUCHd x=400")
    b.until(lambda: b.m.axes[0].made > 20)
    b.ask(request_made)
    b.finish()
    turn_at(b, 0)
    b.tick(10 * DIP_TICKS)
    assert not b.m.switched and b.m.fault in (Fault.NONE, Fault.EMERGENCY_STOP), "what was switched off is not lost"


def test_the_fast_engine_is_the_same_to_the_byte() -> None:
    plain = machine()
    text = (
        f"KMD_WRZECIONO {WANTED}; KMD_RUCHd x=40 y=-30; KMD_CZEKAJ 90; KMD_WYJSCIE spindle 0; KMD_RUCHd x=-40; "
        "KMD_WYJSCIE spindle 1; KMD_CZEKAJ 7; KMD_WRZECIONO 500; KMD_WYJSCIE chuck_3 1; KMD_WRZECIONO 0; KMD_CZEKAJ 3"
    )
    ticked, fast = twins(plain, Bench(plain).program(text), {}, 5_000)
    assert first_difference(trace(ticked), trace(fast)) is None and remembered(ticked) == remembered(fast)
    assert ticked.controller.done == 12 and not ticked.controller.fault
