"""The 28 keys of the panel, four rows of seven, and the switches beside them, as a widget that can be clicked.

Rule: the table is the keypad: what stands where, and the method of the panel that a key calls. The keys of the keyboard
stand in the panel's own table.
"""

from collections.abc import Callable
from typing import NamedTuple

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of


class PanelKey(NamedTuple):
    """A key: what is printed on it, the method that it calls, and the argument of that method, if it has one."""

    label: str
    method: str
    argument: str | int | None = None


def _digits(figures: str) -> tuple[PanelKey, ...]:
    return tuple(PanelKey(figure, "digit", figure) for figure in figures)


ROWS = (
    (*_digits("CDEF"), PanelKey("RESET", "reset"), PanelKey("MEM", "memory"), PanelKey("PROG", "call_workpiece")),
    (*_digits("89AB"), PanelKey("ADR-", "next_cell", -1), PanelKey("ADR+", "next_cell", 1), PanelKey("AUTO", "start")),
    (*_digits("4567"), PanelKey("X-", "jog_back", 0), PanelKey("X+", "jog_on", 0),
     PanelKey("ZERO", "return_to_zero")),
    (*_digits("0123"), PanelKey("Y-", "jog_back", 1), PanelKey("Y+", "jog_on", 1), PanelKey("CONT", "resume")),
)  # fmt: skip
SWITCHES = (PanelKey(N_("PAUSE"), "pause"), PanelKey(N_("EMERGENCY STOP"), "emergency_stop"))
DIGIT_COLUMNS, FUNCTION_COLUMNS = 4, 8
COLUMNS = 4 * DIGIT_COLUMNS + 3 * FUNCTION_COLUMNS
LEAST_ROWS, ROWS_APART = len(ROWS) + 1, 2 * len(ROWS) + 1
Place = tuple[int, range, PanelKey]  # row, columns, key


class Keypad(urwid.Widget):
    """Draws the keys; ``pressed`` is called with one that is clicked. Rows are set apart where there is room."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, pressed: Callable[[PanelKey], object]):
        super().__init__()
        self._pressed = pressed

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the keys and the switches."""
        assert len(size) == 2
        columns, rows = size
        lines: list[Line] = [[] for _row in range(rows)]
        for row, place, key in places(rows):
            gap = place.start - width_of(lines[row])
            lines[row] += [" " * gap, ("danger" if key.method == "emergency_stop" else "key", _cap(key, len(place)))]
        return boxed(lines, columns, rows)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Presses the key under a click with the first button."""
        assert len(size) == 2
        if event != "mouse press" or button != 1:
            return False
        found = next((key for at, place, key in places(size[1]) if at == row and col in place), None)
        if found is not None:
            self._pressed(found)
        return found is not None


def places(rows: int) -> list[Place]:
    """Where the keys stand in a box of so many rows: those that fit."""
    step = 2 if rows >= ROWS_APART else 1
    found: list[Place] = []
    for index, keys in enumerate(ROWS):
        left = 0
        for key in keys:
            width = DIGIT_COLUMNS if key.method == "digit" else FUNCTION_COLUMNS
            found.append((step * index, range(left, left + width - 1), key))
            left += width
    left = 0
    for key in SWITCHES:
        width = len(_(key.label)) + 2
        found.append((step * len(ROWS), range(left, left + width), key))
        left += width + 2
    return [place for place in found if place[0] < rows]


def _cap(key: PanelKey, columns: int) -> str:
    return f"[{_(key.label):^{columns - 2}}]"
