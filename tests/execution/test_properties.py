"""Random programs, held, resumed and stopped at random ticks: nothing lost, nothing out of range, twice the same.

The invariants of tests/support/invariants.py are asserted after every tick.
"""

from dataclasses import dataclass

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from drillctl.kmd import Condition, Fault, Request
from tests.support.bench import Bench, shipped
from tests.support.invariants import Invariants

LONGEST_TICKS = 60_000
EXAMPLES = 24  # the same ones each time; raised, they are a search
NAMES = ("pcb-drill", "pcb-drill-ramp-lab", "boiler-drum", "eight-axis")
ACTIONS = (Request.HOLD, Request.RESUME, Request.STOP, Request.ACK, Request.ESTOP)

places, reaches = st.integers(0, 300), st.integers(-40, 40) | st.sampled_from([-400, 2_000])
absolute = st.builds("{} x={} y={}".format, st.sampled_from(["KMD_RUCH", "KMD_LINIA"]), places, places)
relative = st.builds("{} x={} y={}".format, st.sampled_from(["KMD_RUCHd", "KMD_LINIAd"]), reaches, reaches)
moves = absolute | relative
others = st.sampled_from(["KMD_CZEKAJ 0", "KMD_CZEKAJ 25", "KMD_PREDKOSC 0", "KMD_PREDKOSC 3", "KMD_BAZA"])
heads = st.sampled_from(["KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA"])
counted = st.lists(moves | others, min_size=1, max_size=8).map("\n".join)
programs = st.lists(moves | others | heads, min_size=1, max_size=8).map("\n".join)
requests = st.lists(st.tuples(st.integers(1, 300), st.sampled_from(ACTIONS)), max_size=6)
unhurried = settings(derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
modestly = settings(unhurried, max_examples=EXAMPLES)


@dataclass(frozen=True)
class Run:
    """What one run showed."""

    images: list[int]
    positions: list[int]
    fault: int
    bench: Bench


def run(name: str, program: str, asked: list[tuple[int, Request]], homed: bool) -> Run:
    """The program with its requests, each so many ticks after the last; held and latched runs are let go."""
    b = Bench(shipped(name))
    if homed:
        b.ready()
    b.queue(program)
    sound = Invariants(b.m)
    for ticks, request in asked:
        b.ticker.run(ticks, sound)
        b.ask(request)
        check_inside(b)
    b.ticker.run(1, sound)
    b.ask(Request.RESUME)
    b.ticker.run(LONGEST_TICKS, lambda: sound() or b.ticker.over())
    b.tick(2)
    return Run(b.images, b.positions(), b.m.fault, b)


def check_inside(b: Bench) -> None:
    """While the position is known every axis is inside its range, or a fault is raised in the next tick."""
    inside = all(axis.low <= axis.position <= axis.high for axis in b.m.axes)
    assert inside or not b.m.position_known or b.m.fault


def check_at_rest(outcome: Run) -> None:
    b = outcome.bench
    assert b.ticker.over()
    assert not any(axis.motion or axis.state for axis in b.m.axes)
    assert all(axis.followers is None for axis in b.m.axes)
    assert all(abs(lost) == 0 for lost in b.ticker.lost_steps())
    assert (b.m.condition == Condition.LATCHED) == (b.m.fault != Fault.NONE)
    check_inside(b)


@modestly
@given(st.sampled_from(NAMES), programs, requests, st.booleans())
def test_the_plant_stands_where_the_controller_says(
    name: str, program: str, asked: list[tuple[int, Request]], homed: bool
) -> None:
    check_at_rest(run(name, program, asked, homed))


@modestly
@given(st.sampled_from(NAMES), programs, requests)
def test_two_runs_put_out_the_same_to_the_bit(name: str, program: str, asked: list[tuple[int, Request]]) -> None:
    first, second = (run(name, program, asked, homed=True) for _ in range(2))
    assert (first.images, first.positions, first.fault) == (second.images, second.positions, second.fault)


@modestly
@given(st.sampled_from(NAMES), counted, st.lists(st.tuples(st.integers(1, 200), st.integers(1, 80)), max_size=4))
def test_holds_change_nothing_but_time(name: str, program: str, holds: list[tuple[int, int]]) -> None:
    """Where targets end the moves; how far an axis brakes past a sensor does depend on how fast it came."""
    plain = run(name, program, [], homed=True)
    assume(plain.fault != Fault.LIMIT)
    asked = [pair for after, held in holds for pair in ((after, Request.HOLD), (held, Request.RESUME))]
    held_up = run(name, program, asked, homed=True)
    assert (held_up.positions, held_up.fault) == (plain.positions, plain.fault)
    assert held_up.bench.m.position_known == plain.bench.m.position_known


@settings(unhurried, max_examples=60)
@given(
    st.sampled_from(NAMES),
    programs,
    st.lists(st.tuples(st.integers(0, 63), st.integers(0, 40), st.sampled_from([0, *ACTIONS])), max_size=25),
)
def test_no_input_makes_a_tick_raise(name: str, program: str, noise: list[tuple[int, int, int]]) -> None:
    """Sensors that say anything at any time, and requests in any order."""
    b = Bench(shipped(name)).queue(f"KMD_INICJALIZACJA\n{program}")
    before, sound = b.m.tick + b.m.underruns, Invariants(b.m)
    for stuck, ticks, request in noise:
        b.card.stuck_high, b.card.stuck_low = stuck, ~stuck
        b.ticker.run(ticks, sound)
        if request:
            b.ask(Request(request))
    assert b.m.tick + b.m.underruns - before == sum(ticks for _, ticks, _ in noise)
    assert b.m.image == (b.images[-1] if b.images else 0)
