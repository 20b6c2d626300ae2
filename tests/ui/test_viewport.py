"""Which ticks the scope's columns stand for, and which rows are shown: properties over every run, size and zoom."""

from collections.abc import Callable
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.ui.models.viewport import ZOOMS, SignalRows, Viewport


@st.composite
def viewports(draw: st.DrawFn) -> Viewport:
    """After some keys."""
    first = draw(st.integers(0, 1000))
    view = Viewport().sized(draw(st.integers(1, 200))).of_run(first, first + draw(st.integers(0, 10**7)))
    for by in draw(st.lists(st.integers(-3, 9), max_size=4)):
        view = view.zoomed(by).step(by * 7).pan(by)
    return view


@given(viewports())
def test_the_columns_lie_side_by_side_within_the_run(view: Viewport) -> None:
    edges = view.edges().tolist()
    assert len(edges) == view.shown + 1 <= view.columns + 1
    assert edges[0] == view.left and view.first <= edges[0] and edges[-1] <= view.last + 1
    assert all(a <= b <= a + view.zoom.ticks for a, b in pairwise(edges))
    assert edges[-1] == min(view.left + -(-view.columns * view.zoom.ticks // view.zoom.columns), view.last + 1)


@given(viewports(), st.data())
def test_a_column_and_its_tick_find_each_other(view: Viewport, data: st.DataObject) -> None:
    column = data.draw(st.integers(0, view.shown - 1))
    edges = view.edges().tolist()
    tick = view.tick_at(column)
    assert tick == (edges[column + 1] - 1 if view.zoom.ticks == 1 else edges[column])
    assert 0 <= column - view.column_of(tick) < view.zoom.columns


@given(viewports(), st.integers(-10, 10**7 + 2000))
def test_the_cursor_stays_in_the_run_and_is_seen_where_it_went(view: Viewport, tick: int) -> None:
    there = view.go(tick)
    assert there.cursor == max(view.first, min(tick, view.last))
    assert 0 <= there.column_of(there.cursor) < there.shown


@given(viewports(), st.integers(-20, 40))
def test_zooming_keeps_the_tick_under_the_cursor(view: Viewport, by: int) -> None:
    view = view.go(view.cursor)
    zoomed = view.zoomed(by)
    assert zoomed.cursor == view.cursor and 0 <= zoomed.column_of(zoomed.cursor) < zoomed.shown


@given(viewports())
def test_whole_shows_all_and_wastes_no_more_than_rounding(view: Viewport) -> None:
    whole = view.whole()
    edges = whole.edges()
    assert (edges[0], edges[-1]) == (view.first, view.last + 1)
    assert view.last + 1 - view.first <= whole.columns * whole.zoom.ticks
    assert whole.zoom.ticks == 1 or (whole.zoom.ticks - 1) * whole.columns < view.last + 1 - view.first
    assert whole.zoomed(5) == whole


def test_zooms_rise_and_end_at_both_ends() -> None:
    rates = [zoom.ticks / zoom.columns for zoom in ZOOMS]
    assert rates == sorted(rates) and rates[0] < 1 < rates[-1]
    view = Viewport().sized(50).of_run(0, 99_999)
    assert view.zoomed(-99).zoomed(-1) == view.zoomed(-99) and view.zoomed(99).zoomed(1).zoom.ticks == 2000


def test_a_growing_run_leaves_the_view_where_it_is_and_a_forgotten_part_moves_it() -> None:
    view = Viewport().sized(10).of_run(0, 99).go(50)
    assert view.of_run(0, 500).edges().tolist() == view.edges().tolist()
    later = view.of_run(80, 500)
    assert (later.left, later.cursor) == (80, 80)


ACTS: dict[str, Callable[[SignalRows, int], SignalRows]] = {
    "move": SignalRows.move,
    "hide": lambda rows, _by: rows.hide(),
    "all": lambda rows, _by: rows.all(),
    "only": lambda rows, by: rows.only([by]),
    "put": lambda rows, by: rows.put(by, 7),
}


@given(st.integers(1, 30), st.data())
def test_the_bar_is_always_on_a_row_that_is_shown(count: int, data: st.DataObject) -> None:
    rows = SignalRows(count)
    for act, by in data.draw(st.lists(st.tuples(st.sampled_from([*ACTS]), st.integers(-9, 30)))):
        rows = ACTS[act](rows, by)
        assert rows.at in rows.shown
        window = [row for row, _part in rows.window(7)]
        assert rows.at in window and len(window) == min(7, len(rows.shown)) and set(window) <= set(rows.shown)


@pytest.mark.parametrize(("by", "at"), [(1, 3), (-1, 0), (99, 4), (-99, 0)])
def test_the_bar_skips_what_is_hidden(by: int, at: int) -> None:
    rows = SignalRows(5, hidden=frozenset({1, 2})).move(0)
    assert rows.move(by).at == at


def test_the_last_row_can_not_be_hidden_and_all_come_back() -> None:
    rows = SignalRows(3)
    for _ in range(5):
        rows = rows.hide()
    assert len(rows.shown) == 1 and rows.all().shown == [0, 1, 2]
