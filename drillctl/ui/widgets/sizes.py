"""Layouts by size: what a screen has room for. A screen asks ``layout`` in its ``render``, with the size it is given.

Rule: four sizes of terminal are designed (80x24, 100x32, 160x50, 220x60); any other gets the largest that fits.
"""

from typing import NamedTuple


class Layout(NamedTuple):
    """What fits into a screen of at least these columns and rows, which are those between the frame's lines.

    framed   windows have borders; without, a rule in a line that is there anyway
    side     columns of the window at the side
    motors   rows of the motors' own window below the board; 0: they share the side window
    machine  rows of the machine's window, tools and events below it; 0: it has the whole side, and there are no lists
    """

    columns: int
    rows: int
    framed: bool
    side: int
    motors: int
    machine: int


SMALL = Layout(0, 0, False, 36, 0, 0)
LAYOUTS = (
    Layout(210, 48, True, 60, 13, 27),  # 220x60
    Layout(150, 38, True, 50, 13, 27),  # 160x50
    Layout(98, 22, True, 48, 0, 0),  # 100x32
    SMALL,  # 80x24
)


def layout(columns: int, rows: int) -> Layout:
    """The layout for a screen of this size."""
    return next(each for each in LAYOUTS if columns >= each.columns and rows >= each.rows)
