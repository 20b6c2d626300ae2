"""The fast engine on heads that move together, and X and Y with them, against the law.

Of several drives that pulse, each may be anywhere in its pulse where a stretch ends. Heads that the operator took out
stay up, so jobs name the others; a hold, a stop or a gap finds them at any tick.
"""

from dataclasses import replace

import pytest
from hypothesis import example, given, seed, settings
from hypothesis import strategies as st

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.ticker import Ticker
from tests.support.twins import Disturbances, check, disturbances, small

EIGHT = small("eight-axis")
HEADS = [EIGHT.axis_names[index] for index in EIGHT.drill_axes]
READY = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 5 5\n"
LIFTED_TO = ((40, 20), (45, 20), (45, 20), (300, 700), (40, 20), (45, 20))
LIFTED = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 5 5\n" + "\n".join(
    f"KMD_WIERTLO_DOL\nKMD_GORA_X_Y {x} {y} {{heads}}" for x, y in LIFTED_TO
)


@pytest.mark.parametrize("heads", ["", "{head}=3"])
@pytest.mark.parametrize(("name", "clear"), [("pcb-drill", None), ("pcb-drill", 700), ("eight-axis", 360)])
def test_x_and_y_start_in_the_same_tick_of_a_lift(name: str, clear: int | None, heads: str) -> None:
    """Ways shorter and longer than the lift, and none at all; by one feed, and with one of each head's own."""
    machine = replace(small(name), drill_clear_steps=clear)
    named = [machine.axis_names[index] for index in machine.drill_axes]
    text = LIFTED.format(heads=" ".join(heads.format(head=head) for head in named))
    fast = check(machine, text, {}, 10**9)
    assert fast.controller.fault == 0 and fast.touched


def job(places: list[tuple[int, int]], heads: list[str], feed: int, up: int) -> str:
    """Holes at these places with these heads, down at a feed in ticks a column, up to a height in steps."""
    named, fed = " ".join(heads), " ".join(f"{head}={feed}" for head in heads)
    holes = [f"KMD_WIERTLO_DOL {fed if feed else named}\nKMD_GORA_X_Y {x} {y} {named}" for x, y in places]
    return "\n".join([READY + "KMD_SUW " + " ".join(f"{head}={up}" for head in heads), *holes])


JOBS = st.builds(
    job,
    st.lists(st.tuples(st.integers(0, 60), st.integers(0, 60)), min_size=2, max_size=4),
    st.lists(st.sampled_from(HEADS), min_size=1, unique=True),
    st.sampled_from([0, 1, 6, 21]),
    st.sampled_from([0, 200, 340, 399]),
)


@example(text=job([(9, 9), (200, 5), (205, 5)], HEADS, 0, 340), clear=360, asked={}, ticks=10**9)
@example(text=job([(9, 9), (900, 5)], HEADS[1:4], 7, 200), clear=None, asked={3200: -9}, ticks=7000)
@seed(727)
@settings(max_examples=12, deadline=None)
@given(
    text=JOBS,
    clear=st.sampled_from([None, 360, 100]),
    asked=st.one_of(st.just({}), disturbances),
    ticks=st.integers(3000, 9000),
)
def test_any_spindles_of_the_production_drill(text: str, clear: int | None, asked: Disturbances, ticks: int) -> None:
    """With overlap and without; the same stroke comes again, and a record of it must be the law's."""
    check(replace(EIGHT, drill_clear_steps=clear), text, asked, ticks)


def ways(steps: dict[str, int], min_interval: int) -> str:
    """All axes at once, each its own way."""
    return f"KMD_PREDKOSC {min_interval}\nKMD_RUCHd " + " ".join(f"{axis}={way}" for axis, way in steps.items())


WAYS = st.builds(
    ways, st.fixed_dictionaries(dict.fromkeys(EIGHT.axis_names, st.integers(-60, 260))), st.sampled_from([0, 5, 9, 40])
)


@example(moves=[ways(dict.fromkeys(EIGHT.axis_names, steps), 9) for steps in (255, -60)], asked={}, ticks=9000)
@seed(728)
@settings(max_examples=8, deadline=None)
@given(
    moves=st.lists(WAYS, min_size=2, max_size=2),
    asked=st.one_of(st.just({}), disturbances),
    ticks=st.integers(2500, 9000),
)
def test_eight_drives_each_on_its_own_way(moves: list[str], asked: Disturbances, ticks: int) -> None:
    """To the index of each encoder and past it, to the home sensor, and into the board."""
    check(EIGHT, READY + "\n".join(moves), asked, ticks)


def test_the_first_strokes_of_six_heads_are_hardly_ticked(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is left to the law is where a sensor answers, a bit meets its board, or heads and X end their part."""
    ticked: list[int] = []
    law = Ticker.run
    monkeypatch.setattr(Ticker, "run", lambda self, *how: ticked.append(law(self, *how)) or ticked[-1])
    fast = FastTicker.ideal(EIGHT)
    fast.queue.put(parse_program(job([(9, 9), (70, 5), (9, 9)], HEADS, 21, 340), names_of(EIGHT)))
    while not fast.over() or not ticked:
        fast.turn(fast.over)
    assert len(fast.touched) == 3 * len(HEADS)
    assert sum(ticked) * 20 < fast.controller.tick
