"""What follows from a ramp alone: the automaton counted by hand, for the listed moves and for any sound ramp."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from drillctl.machine import Library, RampTable, intervals, shipped_tables, travel_table, travel_ticks
from drillctl.machine.landing import first_miss, strokes_of
from drillctl.machine.travel import cruising_from
from tests.support.paper import INTERVALS

SHIPPED = Library((shipped_tables(),))
SEVEN = SHIPPED.machine("pcb-drill").axes[0].ramp
RAMPS = {axis.ramp.name: axis.ramp for name in SHIPPED.machine_names() for axis in SHIPPED.machine(name).axes}


def counted(ramp: RampTable, steps: int, floor_ticks: int) -> tuple[list[int], int]:
    """The rule as the paper states it, in unsigned states: ticks before each step, and the state at the end."""
    sign = 1 if steps > 0 else -1
    interval, accelerate, brake = (
        [table[sign * state] for state in range(ramp.top + 1)] for table in (ramp.interval, ramp.accelerate, ramp.brake)
    )
    waits, state, may_accelerate = [], 0, True
    for distance in reversed(range(abs(steps))):
        waits.append(max(interval[state], floor_ticks))
        if distance == 0:
            break
        if distance < brake[state]:
            state -= 1
            may_accelerate = state == 0
        elif may_accelerate and state < ramp.top and distance > accelerate[state] and interval[state] > floor_ticks:
            state += 1
    return waits, state


@st.composite
def ramps(draw: st.DrawFn) -> RampTable:
    """Any automaton of 3 to 13 states that lands exactly, the two directions alike or not."""
    top = draw(st.integers(1, 6))

    def side() -> list[tuple[int, int, int]]:
        rows, brake = [], 1
        for state in range(1, top + 1):
            brake = draw(st.integers(max(brake, state), brake + 4))
            rows.append((draw(st.integers(1, 12)), draw(st.integers(1, state + 3)), brake))
        return rows

    up, down = side(), side()
    rest = (draw(st.integers(1, 12)), 0, 0)
    interval, accelerate, brake = zip(rest, *up, *reversed(down), strict=True)
    ramp = RampTable("any", top, interval, accelerate, brake)
    assume(ramp.first_inexact() is None)
    return ramp


@pytest.mark.parametrize("steps", sorted(INTERVALS))
@pytest.mark.parametrize("sign", [1, -1])
def test_listed_intervals(steps: int, sign: int) -> None:
    assert intervals(SEVEN, sign * steps) == INTERVALS[steps]
    assert travel_ticks(SEVEN, sign * steps) == sum(INTERVALS[steps])


def test_from_eight_steps_on_a_move_takes_21_ticks_more_than_steps() -> None:
    assert all(travel_ticks(SEVEN, steps) == steps + 21 for steps in range(8, 5001))
    assert travel_ticks(SEVEN, 2_000_000_000) == 2_000_000_021


def test_no_step_takes_no_tick() -> None:
    assert intervals(SEVEN, 0) == [] and travel_ticks(SEVEN, 0) == 0 and travel_table(SEVEN, 0).tolist() == [0]


@pytest.mark.parametrize("ramp", RAMPS.values(), ids=RAMPS)
@pytest.mark.parametrize("columns_per_step", [1, 2, 6])
def test_travel_table_is_the_sum_of_intervals(ramp: RampTable, columns_per_step: int) -> None:
    longest = 600 if ramp.top < 20 else 70  # a ramp of hundreds of states runs such strokes whole
    table = travel_table(ramp, longest, columns_per_step)
    assert table.shape == (longest + 1,)
    assert table.tolist() == [sum(intervals(ramp, steps)) * columns_per_step for steps in range(longest + 1)]


@pytest.mark.parametrize("longest", [0, 1, 2, 7, 8, 15, 16, 17])
def test_short_travel_tables(longest: int) -> None:
    assert travel_table(SEVEN, longest).tolist() == [sum(counted(SEVEN, steps, 0)[0]) for steps in range(longest + 1)]


def test_a_ramp_is_proven_where_a_state_is_left_before_the_one_below_it_may_be() -> None:
    """Steps to go above which a state rises need not grow with it; then one distance is the least of two states."""
    random, found = Random(5), 0
    for _ in range(1500):
        states = range(1, random.randint(2, 4) + 1)
        rows = [(random.randint(1, 9), random.randint(1, s + 3), random.randint(1, s + 3)) for s in states]
        interval, accelerate, brake = zip((5, 0, 0), *rows, *reversed(rows), strict=True)
        ramp = RampTable("any", len(rows), interval, accelerate, brake)
        too_fast = [steps for steps in range(1, 60) if list(ramp.walk(steps))[-1][1] > 1]
        miss = first_miss(ramp, 1)
        assert (miss is not None and not miss.capped) == bool(too_fast)
        found += bool(too_fast)
    assert 0 < found < 1500


@given(ramps(), st.booleans())
@settings(max_examples=60, deadline=None)
def test_travel_table_of_any_ramp(ramp: RampTable, whole_strokes: bool) -> None:
    ramp = replace(ramp, whole_strokes=whole_strokes)
    table = travel_table(ramp, 60, 2)
    assert table.tolist() == [2 * sum(intervals(ramp, steps)) for steps in range(61)]


def test_travel_table_of_a_ramp_of_hundreds_of_states() -> None:
    """Around the distance from which its strokes are no more made whole, and that from which they cruise."""
    ramp = RAMPS["even-interval"]
    ramped, cruising = strokes_of(ramp).ramped_from(1, 0) + 1, cruising_from(ramp, 0)
    for each in (ramp, replace(ramp, whole_strokes=False)):
        table = travel_table(each, cruising + 9, 1)
        for steps in (*range(ramped - 4, ramped + 5), *range(2, cruising + 9, 37), *range(cruising - 4, cruising + 5)):
            assert table[steps] == sum(intervals(each, steps))


@given(ramps(), st.integers(-400, 400), st.integers(0, 14), st.sampled_from([1, 2, 6]))
@settings(max_examples=300, deadline=None)
def test_travel_is_as_counted_by_hand(ramp: RampTable, steps: int, floor_ticks: int, columns: int) -> None:
    waits, last_state = counted(ramp, steps, floor_ticks)
    assert last_state <= 1
    assert intervals(ramp, steps, floor_ticks) == waits
    assert travel_ticks(ramp, steps, floor_ticks, columns) == sum(waits) * columns


@given(st.integers(1, 4), st.data())
@settings(max_examples=40, deadline=None)
def test_a_ramp_passes_just_when_every_distance_counted_by_hand_lands(top: int, data: st.DataObject) -> None:
    """Also ramps that don't: the proof walks each way only once, and must miss none."""
    whole = st.lists(st.integers(1, 8), min_size=top, max_size=top)
    sides = [(data.draw(whole), data.draw(whole), sorted(data.draw(whole))) for _ in range(2)]
    columns = [(rest, *sides[0][i], *reversed(sides[1][i])) for i, rest in enumerate((5, 0, 0))]
    ramp = RampTable("any", top, *columns)
    floors = {0, *ramp.interval}
    distances = [sign * d for d in range(1, ramp.straight_from() + 40) for sign in (1, -1)]
    inexact = {d for d in distances if any(counted(ramp, d, floor)[1] > 1 for floor in floors)}
    found = ramp.first_inexact()
    assert (found is not None) == bool(inexact)
    assert found is None or found[1] in inexact


@pytest.mark.parametrize("states", [3, 64])
def test_the_gentlest_ramp_allowed_is_proved_in_time(states: int, tables: Callable[..., Path], tmp_path: Path) -> None:
    """The greatest distances and most states that a file may have: seconds, not hours."""
    rows = [
        f"[[state]]\nstate = {s}\naccelerate = {1000 * (s > 0) - 1000 * (s < 0)}\n"
        f"brake = {1000 * (s > 0) - 1000 * (s < 0)}\ninterval = {states + 1 - abs(s)}\n"
        for s in range(-states, states + 1)
    ]
    file = tables("ramp/gentle")
    file.write_text('name = "gentle"\n' + "".join(rows))
    assert Library((tmp_path,)).check(file) == []
