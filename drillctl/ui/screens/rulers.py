"""What stands around the picture of a board: rulers in mm at its left and below it, and a bar that shows the scale."""

import math
from functools import lru_cache

from drillctl.language.words import _
from drillctl.ui.models.board_map import BoardMap, marks_mm, round_mm
from drillctl.ui.widgets import borders
from drillctl.ui.widgets.dots import CELL_DOTS
from drillctl.ui.widgets.texts import Line

RULER_COLUMNS, RULER_ROWS, SCALE_ROWS = 6, 2, 1
LEAST_WITH_RULERS = (48, 16)  # columns and rows of a picture that has room for them
MARK_DOTS = 20  # at least, from a mark of a ruler to the next
BAR_COLUMNS = 6  # at least, of the bar that shows the scale
KEPT = 4  # rulers: the picture is drawn anew at every step of the head, and its map is the same until it is zoomed
MARKS = {False: ("┤", "┴", "├", "┤"), True: ("+", "+", "|", "|")}  # by plain: left, below, both ends of the bar


def has_rulers(columns: int, rows: int) -> bool:
    """Whether a picture of this size has rulers; the bar it always has."""
    return columns >= LEAST_WITH_RULERS[0] and rows >= LEAST_WITH_RULERS[1]


@lru_cache(KEPT)
def left_ruler(placed: BoardMap, plain: bool) -> list[tuple[str, str]]:
    """For each row of the sheet its piece of the ruler, RULER_COLUMNS wide."""
    step_mm = round_mm(MARK_DOTS / placed.dots_per_mm)
    low, high = float(placed.place_mm(0, placed.rows - 1)[1]), float(placed.place_mm(0, 0)[1])
    labels = {_row(placed, mark): f"{mark:g}" for mark in marks_mm(low, high, step_mm)}
    blank = " " * (RULER_COLUMNS - 1) + _lines(plain).down
    marked = {row: f"{text[: RULER_COLUMNS - 1]:>{RULER_COLUMNS - 1}}{MARKS[plain][0]}" for row, text in labels.items()}
    return [("border", marked.get(row, blank)) for row in range(placed.rows)]


@lru_cache(KEPT)
def ruler_below(placed: BoardMap, plain: bool) -> list[Line]:
    """The two lines below the sheet, which begin below the left ruler: the marks, and their places in mm."""
    step_mm = round_mm(MARK_DOTS / placed.dots_per_mm)
    low, high = float(placed.place_mm(0, 0)[0]), float(placed.place_mm(placed.columns - 1, 0)[0])
    marks, labels = [_lines(plain).across] * placed.columns, [" "] * placed.columns
    for mark in marks_mm(low, high, step_mm):
        column, text = _column(placed, mark), f"{mark:g}"
        first = min(max(column - len(text) // 2, 0), placed.columns - len(text))
        marks[column] = MARKS[plain][1]
        labels[first : first + len(text)] = text
    indent = " " * (RULER_COLUMNS - 1)
    corner = _lines(plain).bottom_left
    return [
        [("border", indent + corner + "".join(marks))],
        [("border", f"{_('mm'):>{RULER_COLUMNS - 1}} " + "".join(labels))],
    ]


def scale_bar(placed: BoardMap, plain: bool) -> Line:
    """A bar with its length in mm."""
    across = CELL_DOTS[1]
    length_mm = round_mm(BAR_COLUMNS * across / placed.dots_per_mm)
    columns = max(round(length_mm * placed.dots_per_mm / across), 2)
    _left, _below, first, last = MARKS[plain]
    bar = first + _lines(plain).across * (columns - 2) + last
    return [("border", f" {bar}"), ("dark", f" {length_mm:g} mm")]


def zoom_told(placed: BoardMap) -> Line:
    """The zoom in words; nothing where the whole board is seen."""
    return [] if placed.zoom == 1 else [("dark", "  " + _("zoom {zoom:g}").format(zoom=round(placed.zoom, 1)))]


def _lines(plain: bool) -> borders.Lines:
    return borders.ASCII if plain else borders.LIGHT


def _row(placed: BoardMap, y_mm: float) -> int:
    down = CELL_DOTS[0]
    return math.floor((placed.rows * down / 2 - (y_mm - float(placed.centre_mm[1])) * placed.dots_per_mm) / down)


def _column(placed: BoardMap, x_mm: float) -> int:
    across = CELL_DOTS[1]
    return math.floor((placed.columns * across / 2 + (x_mm - float(placed.centre_mm[0])) * placed.dots_per_mm) / across)
