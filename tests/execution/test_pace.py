"""PACE: another tick rate, at rest and outside a job; the position stays, and seconds stay seconds (SPEC 1.20)."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.generation.job import names_of
from drillctl.kmd import Condition, Fault, Request, parse_program
from drillctl.machine import Machine
from drillctl.ticker.fast_ticker import FastTicker
from tests.support.bench import MACHINES, Bench, shipped

JOB = "KMD_GOTO_X_Y 60 25; KMD_WIERTLO_DOL; KMD_WIERTLO_GORA; KMD_CZEKAJ 30; KMD_LINIA x=5 y=60"
JOB_TICKS = 900
LIMIT_S = 0.5  # a stroke of the head takes longer than that at 500 Hz, and less at 5000


def limited(tick_hz: int) -> Machine:
    plain = shipped("pcb-drill")
    return replace(plain, configuration=replace(plain.configuration, longest_drilling_s=LIMIT_S)).at_rate(tick_hz)


def ready(name: str = "pcb-drill") -> Bench:
    return Bench(shipped(name)).ready()


def at_rate(b: Bench, tick_hz: int) -> Bench:
    assert b.ticker.requests.set_rate(tick_hz)
    return b.tick()


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("tick_hz", [1, 580, 100_000])
def test_the_rate_changes_and_nothing_else(name: str, tick_hz: int) -> None:
    b = Bench(shipped(name)).tick()
    b.m.position_known = True
    before, image = b.positions(), b.m.image
    at_rate(b, tick_hz)
    assert b.ticker.report()["tick_hz"] == b.m.tick_hz == b.ticker.machine.tick_hz == tick_hz
    assert b.positions() == before and b.m.image == image and b.m.position_known
    assert b.m.longest_drilling == b.machine.at_rate(tick_hz).longest_drilling_ticks


@given(after=st.integers(0, JOB_TICKS))
@settings(max_examples=12, deadline=None)
def test_in_a_job_it_is_no_request(after: int) -> None:
    """Whatever the tick: a job that was asked has the trace, to the byte, of one that was not."""
    asked, plain = (Bench(shipped("pcb-drill")).ready().queue(JOB).tick(after + 1) for _ in range(2))
    if asked.m.job:
        at_rate(asked, 580)
        assert asked.m.served == 0, "so that the trace has nothing of it"
        asked.finish()
        plain.finish()
        assert asked.m.tick_hz == 500 and asked.images == plain.images


@pytest.mark.parametrize("meanwhile", [Request.HOLD, Request.STOP, Request.ESTOP])
def test_held_braking_or_latched_it_is_no_request(meanwhile: Request) -> None:
    for later in (0, 1, 5, 60):
        b = ready().queue("KMD_GOTO_X_Y 200 100").tick(60).ask(meanwhile).tick(later)
        at_rate(b, 580)
        rests = later and b.m.condition == Condition.READY and not b.m.moving
        assert b.m.tick_hz == (580 if rests else 500)


def test_a_limit_in_seconds_keeps_its_seconds() -> None:
    """The drilling time: so many ticks at one rate, ten times as many at the other."""
    for before, after, fault in ((500, 5000, Fault.NONE), (5000, 500, Fault.DRILLING_TIME)):
        b = at_rate(Bench(limited(before)).ready(), after).queue("KMD_WIERTLO_DOL")
        b.tick(1000)
        assert b.m.fault == fault


def test_rates_and_outputs_are_served_one_a_tick_in_the_order_asked() -> None:
    b = ready("cnc-shield")
    spindle = dict(b.machine.outputs)["spindle"]
    b.ticker.requests.set_rate(600)
    b.ticker.requests.set_output(spindle, 1)
    b.ticker.requests.set_rate(700)
    seen = []
    for _ in range(3):
        b.tick()
        seen.append((b.m.tick_hz, b.m.switched >> spindle & 1))
    assert seen == [(600, 0), (600, 1), (700, 1)]


def test_the_fast_engine_forgets_what_it_foresaw_by_the_old_limits() -> None:
    """A stroke that was known to end in time may take too long at another rate."""
    fast = FastTicker.ideal(limited(5000))
    stroke = "KMD_INICJALIZACJA\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n"
    run(fast, stroke)
    assert not fast.controller.fault
    fast.requests.set_rate(500)
    fast.run(1)
    run(fast, "KMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n")
    assert fast.controller.fault == Fault.DRILLING_TIME


def run(fast: FastTicker, text: str) -> None:
    fast.queue.put(parse_program(text, names_of(fast.machine)))
    for _ in range(10_000):
        fast.turn(fast.over)
        if fast.over() and (fast.controller.fault or not len(fast.queue)):
            return
    raise AssertionError("it never ended")
