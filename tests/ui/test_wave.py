"""Waves in characters: no pulse is lost, no number is cut, and plain ones are ASCII."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.trace.lanes import Column
from drillctl.ui.screens.scope_wave import LEVELS, SIGNS, level_line, number_line, ruler, wire_line, word_line
from drillctl.viewmodel.scope import Strip


def strip(values: list[int], ticks_a_column: int) -> Strip:
    column = Column()
    column.append(np.arange(len(values)), np.array(values))
    edges = np.arange(0, len(values) + ticks_a_column, ticks_a_column)
    return Strip(*column.strip(np.minimum(edges, len(values))))


def numbers(values: list[int], ticks_a_column: int, may_cut: bool = False) -> str:
    return word_line(strip(values, ticks_a_column), lambda _column, value: str(value), may_cut, plain=True)


def test_a_tick_a_column_is_the_level_itself() -> None:
    assert wire_line(strip([0, 0, 1, 0, 1, 1], 1), exact=True) == "▁▁▔▁▔▔"
    assert wire_line(strip([0, 0, 1, 0, 1, 1], 1), exact=True, plain=True) == "__-_--"


def test_further_away_an_edge_is_a_bar_and_a_pulse_is_busy() -> None:
    values = [0] * 10 + [1] * 10 + [0] * 5 + [1] + [0] * 14
    assert wire_line(strip(values, 5), exact=False, plain=True) == "__|-|#__"


@given(st.lists(st.integers(0, 1), min_size=2, max_size=80), st.integers(2, 30))
def test_no_pulse_is_ever_missed(values: list[int], ticks_a_column: int) -> None:
    line = wire_line(strip(values, ticks_a_column), exact=False, plain=True)
    for column, sign in enumerate(line):
        ticks = range(max(1, column * ticks_a_column), min(len(values), (column + 1) * ticks_a_column))
        moved = sum(values[tick] != values[tick - 1] for tick in ticks)
        level = "-" if values[min(len(values), (column + 1) * ticks_a_column) - 1] else "_"
        assert sign == (level if moved == 0 else "|" if moved == 1 else "#")


def test_numbers_stand_behind_the_edge_at_which_they_came() -> None:
    assert numbers([7] * 4 + [12] * 4 + [-3] * 4, 1) == "7   |12 |-3 "


def test_a_number_without_room_is_a_dot_and_never_some_of_its_digits() -> None:
    assert numbers([1234] * 3 + [5] * 3, 1) == "...|5 "


@given(st.lists(st.integers(-9999, 9999), min_size=1, max_size=60), st.integers(1, 5))
def test_every_number_that_is_shown_is_one_of_the_run(values: list[int], ticks_a_column: int) -> None:
    line = numbers(values, ticks_a_column)
    assert len(line) == -(-len(values) // ticks_a_column)
    shown = line.replace("|", " ").replace("#", " ").replace(".", " ").split()
    assert {int(word) for word in shown} <= set(values)


def curve(values: list[int], ticks_a_column: int, plain: bool = True) -> str:
    exact = ticks_a_column == 1
    return number_line(strip(values, ticks_a_column), lambda _column, value: str(value), exact, plain)


def test_numbers_that_change_too_often_for_digits_are_a_curve() -> None:
    assert curve([-70, -50, -30, -10, 10, 30, 50, 70, 70, 0], 1, plain=False) == "▁▂▃▄▅▆▇██▅"
    assert curve([5, 5, 5, 5, 6, 6, 6, 6], 1) == "5   |6  ", "where there is room they stay numbers"


def test_a_curve_of_some_of_the_ticks_alone_is_never_drawn() -> None:
    assert curve([*range(40)], 4) == "#" * 10


@given(st.lists(st.integers(-(10**9), 10**9), min_size=1, max_size=60), st.booleans())
def test_a_curve_keeps_the_order_of_what_it_shows(values: list[int], plain: bool) -> None:
    heights = [LEVELS[plain].index(sign) for sign in level_line(strip(values, 1), plain)]
    pairs = sorted(zip(values, heights, strict=True))
    assert [height for _value, height in pairs] == sorted(heights)
    assert heights[values.index(min(values))] == 0
    assert min(values) == max(values) or heights[values.index(max(values))] == len(LEVELS[plain]) - 1


def test_words_may_be_cut_with_a_sign() -> None:
    assert numbers([123456] * 4 + [7] * 2, 1, may_cut=True) == "123~|7"


def test_a_ruler_has_round_ticks_and_marks_over_them() -> None:
    told = ruler(np.arange(95, 156), 60, [(0, "A"), (12, "v"), (99, "B")])
    assert told == "A    |100   v            |120                |140           "
    assert ruler(np.array([0]), 5, []) == "     "


@given(st.integers(0, 10**9), st.integers(1, 10**6), st.integers(1, 200))
def test_a_rulers_labels_stand_where_their_ticks_are(left: int, ticks: int, columns: int) -> None:
    edges = left + np.arange(columns + 1) * ticks
    told = ruler(edges, columns, [])
    assert len(told) == columns
    for label in told.split("|")[1:]:
        column = told.index(f"|{label}")
        assert edges[column] <= int(label) < edges[column + 1]


@pytest.mark.parametrize("plain", [False, True])
def test_the_signs_differ_from_each_other_and_plain_ones_are_ascii(plain: bool) -> None:
    assert len(set(SIGNS[plain])) == len(SIGNS[plain])
    assert not plain or "".join(SIGNS[plain]).isascii()
