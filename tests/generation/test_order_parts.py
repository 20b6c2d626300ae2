"""The parts of the order package: neighbour lists against looking at all pairs, and paths under repair."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from drillctl.generation.order import loop
from drillctl.generation.order.improve import Improver
from drillctl.generation.order.neighbours import find_neighbours
from drillctl.generation.order.path import Path
from drillctl.generation.order.plan import path_ticks
from drillctl.generation.order.stops import Stops
from drillctl.generation.order.travel import TravelCost

RAMP_TICKS = np.array([0, 7, 11, 18, 17, 24, 20, 27, *range(29, 5022)])
TRAVEL = TravelCost(RAMP_TICKS, RAMP_TICKS)

crowd = st.integers(0, 9)
spread = st.integers(0, 4000)
clustered = st.lists(st.tuples(crowd, crowd) | st.tuples(spread, spread), min_size=1, max_size=150).map(np.array)


def sorted_by_cost(
    points: NDArray[np.int64], travel: TravelCost, count: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The lists the slow way: all pairs, by ticks and then by number."""
    cost = travel.between(points[:, None], points[None])
    rows = []
    for hole, row in enumerate(cost):
        others = [other for other in np.argsort(row, kind="stable") if other != hole]
        rows.append(others[:count])
    return np.array(rows, np.int64).reshape(len(points), -1), cost


@settings(deadline=None)
@given(clustered, st.integers(1, 12))
def test_neighbour_lists_are_exact(points: NDArray[np.int64], count: int) -> None:
    expected, cost = sorted_by_cost(points, TRAVEL, count)
    found = find_neighbours(points, TRAVEL, count)
    np.testing.assert_array_equal(found.index, expected)
    np.testing.assert_array_equal(found.ticks, np.take_along_axis(cost, expected, axis=1))


@pytest.mark.parametrize(
    "ticks",
    [
        pytest.param(np.full(5001, 9), id="every move alike"),
        pytest.param(np.arange(5000, -1, -1), id="far is quick"),
        pytest.param(np.random.default_rng(5).integers(0, 50, 5001), id="at random"),
    ],
)
def test_neighbour_lists_trust_no_tables_shape(ticks: NDArray[np.int64]) -> None:
    points = np.random.default_rng(6).integers(0, 5000, (300, 2))
    travel = TravelCost(ticks, RAMP_TICKS)
    np.testing.assert_array_equal(find_neighbours(points, travel, 8).index, sorted_by_cost(points, travel, 8)[0])


def test_turning_and_swapping_by_hand() -> None:
    path = Path([0, 1, 2, 3, 4, 5, 6])
    path.turn(1, 3)
    assert path.order == [0, 3, 2, 1, 4, 5, 6]
    path.swap(1, 3, 6)
    assert path.order == [0, 1, 4, 5, 3, 2, 6]
    assert [path.place[hole] for hole in path.order] == list(range(7))


@given(st.data())
def test_a_moved_piece_lands_where_it_should(data: st.DataObject) -> None:
    path = Path(list(range(10)))
    first = data.draw(st.integers(1, 8))
    last = data.draw(st.integers(first, 8))
    after = data.draw(st.sampled_from([p for p in range(9) if not first <= p <= last]))
    turned = data.draw(st.booleans())
    path.move(first, last, after, turned=turned)
    piece = list(range(first, last + 1))
    rest = [hole for hole in range(10) if hole not in piece]
    cut = rest.index(after) + 1
    assert path.order == rest[:cut] + (piece[::-1] if turned else piece) + rest[cut:]


@given(st.lists(st.tuples(st.integers(1, 8), st.integers(1, 8)), max_size=20))
def test_undo_restores_what_was_kept(turns: list[tuple[int, int]]) -> None:
    path = Path(list(range(10)))
    path.turn(2, 5)
    path.keep()
    before = list(path.order)
    for one, other in turns:
        path.turn(min(one, other), max(one, other))
    path.undo()
    assert path.order == before
    assert [path.place[hole] for hole in path.order] == list(range(10))


@settings(deadline=None)
@given(clustered.filter(lambda points: len(points) > 1))
def test_ticks_said_to_be_saved_are_saved(points: NDArray[np.int64]) -> None:
    order = list(range(len(points)))
    stops = Stops.of([points[1:]], points[0])
    improver = Improver(stops, TRAVEL, find_neighbours(points, TRAVEL, 8).pairs(), order)
    saved = improver.settle(order)
    after = improver.path.order[:-1]
    assert sorted(after) == order and after[0] == 0 and improver.path.order[-1] == len(points)
    before_ticks = path_ticks(points[1:], range(len(points) - 1), TRAVEL, points[0])
    assert path_ticks(points[1:], np.array(after[1:], int) - 1, TRAVEL, points[0]) == before_ticks - saved


@settings(deadline=None)
@given(clustered.filter(lambda points: len(points) > 1))
def test_pairs_worked_out_one_by_one_are_those_of_the_matrix(points: NDArray[np.int64]) -> None:
    """Small boards have all pairs beforehand, large ones by and by."""
    half = 1 + len(points) // 2
    stops = Stops.of([points[1:half], [], points[half:]], points[0], end=(5, 5))
    by_and_by = loop.rows_by_pair(stops, TRAVEL)
    beforehand = loop.loop_rows(stops, TRAVEL)
    assert [[row[other] for other in range(len(row))] for row in by_and_by] == [list(row) for row in beforehand]
