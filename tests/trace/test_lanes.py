"""Lanes against a list of values, one a tick: what every look must say, however the rows came in."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.trace.lanes import Column, Lane, Lanes

RUNS = st.lists(st.integers(0, 3), min_size=1, max_size=60)


def column_of(values: Sequence[int], pieces: int = 1) -> Column:
    """Handed in piece by piece, every tick a row."""
    column = Column()
    for ticks in np.array_split(np.arange(len(values)), pieces):
        if len(ticks):
            column.append(ticks, np.array(values)[ticks])
    return column


@given(RUNS, st.integers(1, 7))
def test_only_changes_are_kept(values: list[int], pieces: int) -> None:
    column = column_of(values, pieces)
    changes = [tick for tick, value in enumerate(values) if tick == 0 or value != values[tick - 1]]
    assert column.ticks.tolist() == changes
    assert [column.at(tick) for tick in range(-1, len(values))] == [None, *values]


@given(RUNS, st.data())
def test_a_window_tells_the_value_at_its_start_and_every_change(values: list[int], data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(values) - 1))
    stop = data.draw(st.integers(start + 1, len(values)))
    ticks, found = column_of(values).window(start, stop)
    assert ticks[0] == start
    assert np.repeat(found, np.diff(ticks, append=stop)).tolist() == values[start:stop]
    assert (np.diff(found) != 0).all()


@given(RUNS, st.data())
def test_a_strip_counts_every_change_of_every_stretch(values: list[int], data: st.DataObject) -> None:
    edges = sorted(data.draw(st.lists(st.integers(1, len(values)), min_size=1, max_size=8)))
    edges = [data.draw(st.integers(0, edges[0] - 1)), *edges]
    ends, changes = column_of(values).strip(np.array(edges))
    assert ends.tolist() == [values[edge - 1] for edge in edges[1:]]
    moved = [tick > 0 and value != values[tick - 1] for tick, value in enumerate(values)]
    assert changes.tolist() == [sum(moved[a:b]) for a, b in pairwise(edges)]


@given(RUNS, st.booleans(), st.integers(-2, 62))
def test_find_is_the_nearest_on_either_side(values: list[int], onset: bool, tick: int) -> None:
    column = column_of(values)
    moved = [i for i, value in enumerate(values) if i == 0 or value != values[i - 1]]
    events = [i for i in moved if values[i]] if onset else moved[1:]
    assert column.find(tick, 1, onset) == min((i for i in events if i > tick), default=None)
    assert column.find(tick, -1, onset) == max((i for i in events if i < tick), default=None)


@given(RUNS, st.data())
def test_what_is_cut_off_is_unknown_and_the_rest_as_before(values: list[int], data: st.DataObject) -> None:
    cut = data.draw(st.integers(0, len(values) - 1))
    column = column_of(values)
    column.cut(cut)
    assert [column.at(tick) for tick in range(len(values))] == [None] * cut + values[cut:]
    column.append(np.array([len(values)]), np.array([9]))
    assert column.at(len(values)) == 9


def test_a_lane_of_a_bit_shows_it_alone_and_may_be_turned_over() -> None:
    lanes = Lanes([Lane(0, bit=1), Lane(0, bit=1, invert=True), Lane(0), Lane(1)], most=100)
    lanes.append(np.array([0, 0, 3, 5, 8]), np.array([0, 1, 0, 0, 0], np.int32), np.array([0, -4, 2, 3, 1]))
    low_high_low = [[0, 3, 8], [0, 1, 0]]
    assert [lanes.columns[0].ticks.tolist(), lanes.columns[0].values.tolist()] == low_high_low
    assert lanes.columns[1].values.tolist() == [1, 0, 1]
    assert lanes.columns[2].values.tolist() == [0, 2, 3, 1] and lanes.columns[3].values.tolist() == [-4]


@settings(max_examples=50)
@given(st.lists(st.tuples(st.integers(1, 5), st.integers(0, 1), st.integers(0, 5)), min_size=1, max_size=200))
def test_a_full_record_forgets_its_older_part_in_all_lanes_at_once(rows: list[tuple[int, int, int]]) -> None:
    whole, bounded = (Lanes([Lane(0), Lane(1)], most) for most in (10**6, 20))
    ticks = np.cumsum([gap for gap, _, _ in rows])
    columns = np.array([[0, 0], *[row[1:] for row in rows]])
    for lanes in (whole, bounded):
        for tick, (signal, value) in zip([0, *ticks.tolist()], columns.tolist(), strict=True):
            lanes.append(np.array([tick]), np.array([signal], np.int32), np.array([value]))
    assert len(bounded) <= 20 and bounded.first_tick <= ticks[-1]
    for tick in range(bounded.first_tick, int(ticks[-1]) + 1):
        assert [column.at(tick) for column in bounded.columns] == [column.at(tick) for column in whole.columns]


@pytest.mark.parametrize("rows", [0, 1])
def test_a_lane_without_rows_is_empty_everywhere(rows: int) -> None:
    lanes = Lanes([Lane(0), Lane(1)], most=10)
    lanes.append(np.zeros(rows, np.int64), np.zeros(rows, np.int32), np.zeros(rows, np.int64))
    values, changes = lanes.columns[1].strip(np.array([0, 5, 9]))
    assert not changes.any() and not values.any() and lanes.columns[1].at(3) is None
    assert lanes.columns[1].find(0, 1, True) is None and lanes.columns[1].find(9, -1, False) is None
