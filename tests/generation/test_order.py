"""Orders of drilling: always a permutation, never longer than the cheaper ways, the same every time."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from drillctl.generation.order import OrderError, TravelCost, path_ticks, plan, plan_groups
from drillctl.viewmodel.choices import ORDERS

Pair = tuple[int, int]

# The seven-state ramp's short moves as the paper's table gives them; from 8 steps on d + 21 ticks.
SHORT_TICKS = (0, 7, 11, 18, 17, 24, 20, 27)
REACH = 5000


def ramp_ticks(reach: int = REACH) -> NDArray[np.int64]:
    return np.array([*SHORT_TICKS, *range(len(SHORT_TICKS) + 21, reach + 22)])


TRAVEL = TravelCost(ramp_ticks(), ramp_ticks())
SLOW_Y = TravelCost(ramp_ticks(), 3 * ramp_ticks())

steps = st.integers(0, 400) | st.integers(0, 12)  # wide boards, and crowded ones full of ties and duplicates
holes = st.lists(st.tuples(steps, steps), max_size=40)
places = st.tuples(steps, steps)
travels = st.sampled_from([TRAVEL, SLOW_Y])
slow = settings(deadline=None, max_examples=40)


def random_board(count: int, seed: int) -> NDArray[np.int64]:
    return np.random.default_rng(seed).integers(0, (4724, 3780), (count, 2))


@slow
@given(holes, travels, places, st.sampled_from(ORDERS))
def test_every_hole_is_drilled_once(points: list[Pair], travel: TravelCost, start: Pair, how: str) -> None:
    order = plan(points, travel, how, start)
    assert order.dtype == np.int64
    assert sorted(order.tolist()) == list(range(len(points)))


@slow
@given(holes, travels, places)
def test_optimised_is_never_longer_than_the_cheap_orders(points: list[Pair], travel: TravelCost, start: Pair) -> None:
    ticks = {how: path_ticks(points, plan(points, travel, how, start), travel, start) for how in ORDERS}
    assert ticks["optimised"] <= min(ticks["nearest"], ticks["file"])


@slow
@given(st.lists(places, min_size=1, max_size=7), travels, places)
def test_few_holes_are_ordered_within_a_few_percent_of_the_best(
    points: list[Pair], travel: TravelCost, start: Pair
) -> None:
    every = np.array(list(itertools.permutations(points)))
    stops = np.insert(every, 0, start, axis=1)
    best = travel.between(stops[:, :-1], stops[:, 1:]).sum(axis=1).min()
    assert path_ticks(points, plan(points, travel, "optimised", start), travel, start) <= 1.03 * best


@slow
@given(holes, travels, places)
def test_nearest_takes_the_nearest_left_and_the_first_of_equals(
    points: list[Pair], travel: TravelCost, start: Pair
) -> None:
    left = list(range(len(points)))
    here = np.array(start)
    for hole in plan(points, travel, "nearest", start):
        costs = [int(travel.between(here, np.array(points[other]))) for other in left]
        assert hole == left[costs.index(min(costs))]
        here = np.array(points[hole])
        left.remove(hole)


@pytest.mark.parametrize("how", ORDERS)
def test_same_holes_same_order(how: str) -> None:
    points = random_board(300, seed=1)
    first = plan(points, TRAVEL, how, (0, 0))
    np.random.seed(7)  # what others do to the common generators must not matter
    np.testing.assert_array_equal(plan(points, TRAVEL, how, (0, 0)), first)


def test_optimised_order_is_pinned() -> None:
    """The same on every machine and every Python; a change of method must change this list knowingly."""
    points = [(7919 * i % 4724, 104729 * i % 3780) for i in range(60)]
    expected = """
        0 3 37 6 40 9 43 12 46 15 49 18 52 21 55 24 58 48 14 45 11 42 8 39 5 36 2 33 30 27
        17 51 20 54 23 57 26 29 32 1 35 4 38 7 41 31 28 59 25 56 22 53 19 50 16 47 13 44 10 34
    """
    assert plan(points, TRAVEL, "optimised", (0, 0)).tolist() == [int(hole) for hole in expected.split()]


def test_file_order_is_the_files() -> None:
    assert plan([(9, 9), (0, 0), (5, 5)], TRAVEL, "file", (0, 0)).tolist() == [0, 1, 2]


def test_nearest_goes_by_ticks_not_by_distance() -> None:
    # 4 steps take 17 ticks, 3 take 18: the farther hole is the nearer one.
    assert plan([(3, 0), (4, 0)], TRAVEL, "nearest", (0, 0)).tolist() == [1, 0]


def test_a_slow_axis_is_avoided() -> None:
    assert plan([(0, 100), (200, 0)], TRAVEL, "nearest", (0, 0)).tolist() == [0, 1]
    assert plan([(0, 100), (200, 0)], SLOW_Y, "nearest", (0, 0)).tolist() == [1, 0]


def test_optimised_untangles_a_crossed_row() -> None:
    points = [(100 * i, 0) for i in (3, 0, 5, 1, 4, 2, 6, 9, 7, 8)]
    order = plan(points, TRAVEL, "optimised", (0, 0))
    assert [points[hole][0] for hole in order] == list(range(0, 1000, 100))


def test_the_end_is_free() -> None:
    # From the middle: first the short arm (either way round costs the same), then the long one, no way back.
    points = [(1000 + 50 * i, 0) for i in (1, 2, 3, 4, 5, 6, 7, 8, -1, -2)]
    order = plan(points, TRAVEL, "optimised", (1000, 0))
    assert set(order[:2].tolist()) == {8, 9} and order[2:].tolist() == [0, 1, 2, 3, 4, 5, 6, 7]


@pytest.mark.parametrize("count", [200, 1000])
def test_optimised_beats_nearest_clearly_on_a_board(count: int) -> None:
    points = random_board(count, seed=3)
    ticks = {how: path_ticks(points, plan(points, TRAVEL, how, (0, 0)), TRAVEL, (0, 0)) for how in ORDERS}
    assert ticks["optimised"] < 0.92 * ticks["nearest"] < 0.5 * ticks["file"]


@pytest.mark.parametrize("how", ORDERS)
@pytest.mark.parametrize("count", [0, 1, 2, 3, 100])
def test_holes_all_in_one_place(how: str, count: int) -> None:
    order = plan([(7, 7)] * count, TRAVEL, how, (7, 7))
    assert sorted(order.tolist()) == list(range(count))


def test_a_move_takes_at_least_one_tick() -> None:
    assert path_ticks([(7, 7), (7, 7)], [0, 1], TRAVEL, (7, 7)) == 2


def test_path_ticks_adds_the_slower_axis_of_each_move() -> None:
    assert path_ticks([(1, 3), (9, 3)], [1, 0], TRAVEL, (0, 0)) == 30 + 29


@slow
@given(st.lists(holes, max_size=4), places, st.sampled_from(["file", "nearest"]))
def test_each_tool_begins_where_the_one_before_ended(groups: list[list[Pair]], start: Pair, how: str) -> None:
    orders = plan_groups(groups, TRAVEL, how, start)
    for points, order in zip(groups, orders, strict=True):
        np.testing.assert_array_equal(order, plan(points, TRAVEL, how, start))
        start = points[order[-1]] if len(points) else start


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (lambda: plan([(0, 0)], TRAVEL, "best", (0, 0)), "'best' is not known; give file, nearest, opt"),
        (lambda: plan([(0, REACH + 1)], TRAVEL, "file", (0, 0)), "5001 steps apart in y, .* ends at 5000"),
        (lambda: plan([(0.5, 1.0)], TRAVEL, "file", (0, 0)), "pairs of whole steps"),
        (lambda: plan([1, 2, 3], TRAVEL, "file", (0, 0)), "pairs of whole steps"),
        (lambda: TravelCost(ramp_ticks()[:0], ramp_ticks()), "table of x must be a row of whole numbers"),
        (lambda: TravelCost(ramp_ticks(), np.array([1.5])), "table of y must be a row of whole numbers"),
        (lambda: TravelCost(ramp_ticks(), ramp_ticks()[None]), "table of y must be a row of whole numbers"),
    ],
)
def test_what_cannot_be_planned_is_refused(call: Callable[[], Any], reason: str) -> None:
    with pytest.raises(OrderError, match=reason):
        call()


def test_holes_on_the_far_side_of_zero_are_ordered_too() -> None:
    points = random_board(50, seed=4)
    moved = points - 3000
    np.testing.assert_array_equal(
        plan(moved, TRAVEL, "optimised", (-3000, -3000)), plan(points, TRAVEL, "optimised", (0, 0))
    )
