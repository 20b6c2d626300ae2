"""A panel beside a screen's own widget where the terminal has room for both: what is edited left, what it does right.

Rule: functions of a size. The panel has a border to its left and its title in its first row; below ``LEAST_COLUMNS``
there is none, and the screen has the whole width.
"""

from collections.abc import Sequence

import urwid

from drillctl.ui.widgets.borders import lines
from drillctl.ui.widgets.texts import Line, boxed, width_of

LEAST_COLUMNS = 92  # of a screen that has a panel
LEFT_COLUMNS = 62  # kept for the screen's own widget
GREATEST_PART = 0.5
BORDER_COLUMNS = 2


def panel_columns(columns: int, left: int = LEFT_COLUMNS) -> int:
    """The columns of the panel with its border, beside at least ``left`` for the widget; 0 where there is no room."""
    if columns < LEAST_COLUMNS:
        return 0
    return max(columns - max(left, int(columns * GREATEST_PART)), 0)


def with_panel(main: urwid.Canvas, title: str, panel: Sequence[Line], columns: int, rows: int) -> urwid.Canvas:
    """The widget's canvas with a panel of ``columns`` to its right; the canvas alone for 0."""
    if columns <= BORDER_COLUMNS:
        return main
    drawn = [titled(title, columns - BORDER_COLUMNS), *panel]
    side = [[("border", f"{lines().down} "), *line] for line in [*drawn, *[[]] * (rows - len(drawn))]]
    beside = boxed(side, columns, rows)
    return urwid.CanvasJoin([(main, None, True, main.cols()), (beside, None, False, columns)])


def titled(title: str, columns: int) -> Line:
    """A rule across so many columns that has a title in it."""
    heading: Line = [("title", f"{title} ")]
    return [*heading, ("border", lines().across * max(columns - width_of(heading), 0))]
