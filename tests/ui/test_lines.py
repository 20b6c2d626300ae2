"""Lines of marked text on a canvas: the same that urwid's own text widget makes of them, clipped and padded."""

from collections.abc import Iterable

import pytest
import urwid
from hypothesis import given
from hypothesis import strategies as st

from drillctl.ui.widgets.texts import Line, Run, boxed

WORDS = st.text("ab ⠁─żł", max_size=12)
LINES = st.lists(st.lists(st.one_of(WORDS, st.tuples(st.sampled_from(["good", "key"]), WORDS)), max_size=5), max_size=8)


def cells(canvas: urwid.Canvas) -> list[list[tuple[object, object, int]]]:
    """Attribute, character set and byte of each place, row by row."""
    return [[(name, charset, byte) for name, charset, text in row for byte in text] for row in canvas.content()]


def by_urwid(lines: list[Line], columns: int, rows: int) -> urwid.Canvas:
    markup = [part for line in lines[:rows] for part in [*line, "\n"]][:-1]
    canvas = urwid.CompositeCanvas(urwid.Text(markup, wrap="clip").render((columns,)))
    canvas.pad_trim_top_bottom(0, rows - canvas.rows())
    return canvas


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
@given(lines=LINES, columns=st.integers(1, 30), rows=st.integers(1, 9))
def test_a_box_is_as_urwid_would_draw_it(encoding: str, lines: list[Line], columns: int, rows: int) -> None:
    urwid.set_encoding(encoding)
    try:
        assert cells(boxed(lines, columns, rows)) == cells(by_urwid(lines, columns, rows))
    finally:
        urwid.set_encoding("utf-8")


def test_what_is_twice_as_wide_and_cut_leaves_a_gap() -> None:
    (row,) = boxed([["a漢漢", ("good", "b")]], 4, 1).text
    assert row.decode() == "a漢 "


@given(lines=LINES, part=st.tuples(st.integers(0, 9), st.integers(0, 3), st.integers(1, 10), st.integers(1, 3)))
def test_a_part_of_a_box_in_other_looks_is_cut_out_of_the_whole(lines: list[Line], part: tuple[int, ...]) -> None:
    looks = {None: "body", "good": "focus"}
    whole = letters(by_urwid(lines, 20, 6).content())
    for left, top, columns, rows in (part, (0, part[1], 20, part[3])):
        cut = letters(boxed(lines, 20, 6).content(left, top, columns, rows, looks))
        expected = [row[left : left + columns] for row in whole[top : top + rows]]
        assert cut == [[(looks.get(name, name), letter) for name, letter in row] for row in expected]


def letters(rows: Iterable[list[Run]]) -> list[list[tuple[object, str]]]:
    """Attribute and letter of each place, row by row; a letter of these texts takes one column."""
    return [[(name, letter) for name, _charset, text in row for letter in text.decode()] for row in rows]
