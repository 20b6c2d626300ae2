"""The rows of a frame of many parts: those that urwid gives; a part that is as before is not asked for its rows."""

from collections.abc import Callable, Iterator
from typing import Any

import urwid
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.ui.canvas_rows import CanvasRows
from drillctl.ui.widgets.texts import boxed

COLUMNS, ROWS = 24, 9
LEAST = 2
Draw = Callable[..., Any]
KEPT: dict[tuple[int, int, str], urwid.Canvas] = {}


def leaf(columns: int, rows: int, word: str) -> urwid.Canvas:
    """A canvas of this size; the same one for the same word, as a widget that has not changed hands it on."""
    key = columns, rows, word
    if key not in KEPT:
        KEPT[key] = boxed([[word, ("good", f"{row}漢")] for row in range(rows)], columns, rows)
    return KEPT[key]


@st.composite
def frames(draw: Draw, columns: int = COLUMNS, rows: int = ROWS, depth: int = 3) -> urwid.Canvas:
    """Parts beside, below and over one another, some of them in other looks."""
    kinds = ["leaf", "leaf", "solid", "beside", "below", "over", "looks"] if depth else ["leaf"]
    kind = draw(st.sampled_from(kinds))
    if kind == "solid":
        return urwid.SolidCanvas("─", columns, rows)
    if kind == "beside" and columns >= 2 * LEAST:
        left = draw(st.integers(LEAST, columns - LEAST))
        parts = [draw(frames(left, rows, depth - 1)), draw(frames(columns - left, rows, depth - 1))]
        return urwid.CanvasJoin([(part, None, False, part.cols()) for part in parts])
    if kind == "below" and rows >= 2:
        top = draw(st.integers(1, rows - 1))
        parts = [draw(frames(columns, top, depth - 1)), draw(frames(columns, rows - top, depth - 1))]
        return urwid.CanvasCombine([(part, None, False) for part in parts])
    if kind == "over" and columns >= LEAST and rows >= 1:
        left, top = draw(st.integers(0, columns - LEAST)), draw(st.integers(0, rows - 1))
        width, height = draw(st.integers(LEAST, columns - left)), draw(st.integers(1, rows - top))
        below = urwid.CompositeCanvas(draw(frames(columns, rows, depth - 1)))
        below.overlay(urwid.CompositeCanvas(draw(frames(width, height, depth - 1))), left, top)
        return below
    if kind == "looks":
        canvas = urwid.CompositeCanvas(draw(frames(columns, rows, depth - 1)))
        canvas.fill_attr_apply({None: "body", "good": "focus"})
        return canvas
    return leaf(columns, rows, draw(st.sampled_from(["", "one", "a żółć", "⡏⡏"])))


@settings(max_examples=80)
@given(st.lists(frames(), min_size=1, max_size=4))
def test_the_rows_are_those_of_urwid(canvases: list[urwid.Canvas]) -> None:
    rows = CanvasRows()
    for canvas in canvases:
        assert rows.of(canvas) == list(canvas.content())


class Counted(urwid.SolidCanvas):
    """Counts how often its rows were asked for."""

    asked = 0

    def content(self, *part: Any) -> Iterator[Any]:
        self.asked += 1
        return super().content(*part)


def test_a_part_that_is_as_before_is_not_asked_for_its_rows() -> None:
    rows, still = CanvasRows(), Counted("x", 4, 2)
    for word in ("one", "two"):
        frame = urwid.CanvasJoin([(still, None, False, 4), (leaf(6, 2, word), None, False, 6)])
        assert word.encode() in b"".join(text for _look, _set, text in rows.of(frame)[0])
    assert still.asked == 1


def test_a_part_in_two_looks_has_rows_for_each() -> None:
    seen = []
    for look in ("good", "danger"):
        canvas = urwid.CompositeCanvas(leaf(4, 1, "one"))
        canvas.fill_attr_apply({None: look})
        seen.append(canvas)
    frame = urwid.CanvasJoin([(canvas, None, False, 4) for canvas in seen])
    assert {run[0] for run in CanvasRows().of(frame)[0]} >= {"good", "danger"}
