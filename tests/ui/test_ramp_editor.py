"""The ramp editor: numbers typed over, everything drawn of them at once, nothing unsound saved."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.ui.screens.ramp_editor import RampEditor, bar_rows
from tests.ui.editor_fakes import Bench, Console, Shell, Tables, attributes_of, press, text_of

TABLE = "-1 -1 -2 4\n0 0 0 7\n1 1 2 4"


@pytest.fixture
def shell() -> Shell:
    return Shell()


@pytest.fixture
def tables() -> Tables:
    return Tables(ramp=TABLE)


@pytest.fixture
def editor(shell: Shell, tables: Tables) -> RampEditor:
    return RampEditor(Console(), shell, tables, "one")


def states(editor: RampEditor) -> list[list[str]]:
    return [row.split() for row in text_of(editor).split("\n")[3:6]]


def test_states_stand_in_rows_with_what_stopping_takes(editor: RampEditor) -> None:
    assert states(editor) == [
        ["-1", "[-1]", "-2", "4", "1", "4"],
        ["0", "0", "0", "7", "0", "7"],
        ["1", "1", "2", "4", "1", "4"],
    ]
    assert "3 steps, 15 ticks" in text_of(editor) and "every move lands exactly" in text_of(editor)


def test_the_profile_stands_in_the_panel_where_there_is_one(shell: Shell, tables: Tables) -> None:
    editor = RampEditor(Console(), shell, tables, "one", bench=Bench())
    for size, left in (((160, 50), False), ((80, 24), True)):
        rows = text_of(editor, size).split("\n")
        caption = next(row for row in rows if "3 steps, 15 ticks" in row)
        assert (caption.index("3 steps") < 75) is left and ("way in steps" in "".join(rows)) is not left


def test_every_digit_goes_into_the_text_and_the_drawing(editor: RampEditor) -> None:
    press(editor, "down", "right", "right", "1")
    assert editor.text == "-1 -1 -2 4\n0 0 0 1\n1 1 2 4" and "3 steps, 9 ticks" in text_of(editor)
    press(editor, "2")
    assert editor.text == "-1 -1 -2 4\n0 0 0 12\n1 1 2 4" and "3 steps, 20 ticks" in text_of(editor)
    press(editor, "backspace", "backspace")
    assert editor.text == "-1 -1 -2 4\n0 0 0 1\n1 1 2 4", "an empty field goes nowhere"
    assert states(editor)[1][3] == "[]"


def test_a_minus_stands_in_front_only(editor: RampEditor) -> None:
    press(editor, "-")
    assert editor.text == TABLE, "a minus alone is no number yet"
    press(editor, "3", "-")
    assert editor.text.startswith("-1 -3 ")


def test_the_cursor_ends_a_number_and_stays_inside(editor: RampEditor) -> None:
    press(editor, "right", "5", "left", "left", "up", "6")
    assert editor.text == "-1 6 5 4\n0 0 0 7\n1 1 2 4"
    press(editor, *["down"] * 9, *["right"] * 9, "8")
    assert editor.text.endswith("1 1 2 8")


def test_a_number_has_an_end(editor: RampEditor) -> None:
    press(editor, *"1234567890")
    assert editor.text.startswith("-1 1234567 ")


def test_undo_and_redo(editor: RampEditor) -> None:
    press(editor, "5", "ctrl u")
    assert editor.text == TABLE and states(editor)[0][1] == "[-1]"
    press(editor, "ctrl r")
    assert editor.text.startswith("-1 5 ")


def test_an_unsound_ramp_is_not_drawn(editor: RampEditor) -> None:
    press(editor, "right", "right", "0")
    assert "no profile" in text_of(editor) and states(editor)[0][4:] == ["?", "?"]
    assert attributes_of(editor, "no profile") == {"warning"}


def test_a_sound_ramp_is_saved(editor: RampEditor, tables: Tables) -> None:
    press(editor, "5", "f2")
    assert tables.own["ramp"] == "-1 5 -2 4\n0 0 0 7\n1 1 2 4" and "your own copy" in text_of(editor)


def test_a_pair_of_states_comes_and_goes_and_the_cursor_stays_on_its_state(editor: RampEditor) -> None:
    press(editor, "down", "down", "insert")
    assert editor.text == "-2 -1 -2 4\n-1 -1 -2 4\n0 0 0 7\n1 1 2 4\n2 1 2 4"
    rows = [row.split() for row in text_of(editor).split("\n")]
    assert ["1", "[1]", "2", "4", "1", "4"] in rows
    press(editor, "down", "delete")
    assert editor.text == TABLE and ["1", "[1]", "2", "4", "1", "4"] in states(editor), "on the outermost that is left"
    press(editor, "ctrl u")
    assert editor.text.startswith("-2 ")


@pytest.mark.parametrize("size", [(80, 16), (80, 24), (160, 50)])
def test_a_ramp_of_many_states_shows_the_cursor_the_profile_and_the_verdict(
    shell: Shell, size: tuple[int, int]
) -> None:
    table = "\n".join(f"{state} {state} {2 * state} 4" for state in range(-10, 11))
    editor = RampEditor(Console(), shell, Tables(ramp=table), "one")
    for state in range(-10, 11):
        text = text_of(editor, size)
        assert f"[{state}]" in text and "every move lands exactly" in text and "sound" in text
        press(editor, "down")


class Unread(Tables):
    """Tables of which no ramp's rows can be read."""

    def ramp(self, text: str) -> Any:
        return type(super().ramp(TABLE))(())


def test_a_text_that_is_no_ramp_is_said_to_be_none_and_takes_no_digits(shell: Shell) -> None:
    editor = RampEditor(Console(), shell, Unread(ramp="bad"), "one")
    press(editor, "5", "down", "right", "backspace")
    assert editor.text == "bad" and "no ramp" in text_of(editor) and "problem: 1: it is bad" in text_of(editor)
    press(editor, "f2")
    assert shell.told == [("Not saved", ["1: it is bad"])]


@given(st.lists(st.floats(0, 1e6), max_size=40), st.integers(1, 60), st.integers(1, 9), st.booleans())
def test_bars_are_as_high_as_their_values(values: list[float], columns: int, rows: int, plain: bool) -> None:
    drawn = bar_rows(values, columns, rows, plain)
    assert len(drawn) == rows
    greatest = max(values, default=0)
    shown = values[:columns] if greatest > 0 else []
    assert all(len(row) == len(shown) for row in drawn)
    eighths = {**{block: n for n, block in enumerate(" ▁▂▃▄▅▆▇█")}, "#": 8}
    for index, value in enumerate(shown):
        height = sum(eighths[row[index]] for row in drawn)
        assert abs(height - value / greatest * rows * 8) <= (5 if plain else 1)


def test_plain_bars_need_no_utf8() -> None:
    assert bar_rows([1, 0.5, 0.25], 3, 2, plain=True) == ["#  ", "###"]
