"""The seven buttons of the paper in a row, or in as many rows as they need: each is a key of the screen's table."""

from collections.abc import Callable, Sequence

import urwid

from drillctl.language.words import _
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Line, Size, boxed, indices_packed, width_of


class Buttons(urwid.Widget):
    """Draws a button for each key that is given; ``pressed`` is called with the one that is clicked."""

    _sizing = frozenset([urwid.Sizing.FLOW])
    _selectable = False

    def __init__(self, keys: Sequence[Key], pressed: Callable[[Key], object]):
        super().__init__()
        self._keys, self._pressed = keys, pressed

    def rows(self, size: Size, focus: bool = False) -> int:
        """How many rows the buttons take in this width."""
        assert len(size) == 1
        return len(indices_packed(self._labels(), size[0]))

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the buttons, none of them broken."""
        assert len(size) == 1
        labels, rows = self._labels(), indices_packed(self._labels(), size[0])
        lines: list[Line] = [[part for index in row for part in labels[index]] for row in rows]
        return boxed(lines, size[0], len(rows))

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Presses the button under a click with the first button of the mouse."""
        assert len(size) == 1
        if event != "mouse press" or button != 1:
            return False
        labels, rows = self._labels(), indices_packed(self._labels(), size[0])
        left = 0
        for index in rows[row] if row < len(rows) else ():
            right = left + width_of(labels[index])
            if left <= col < right - 1:
                self._pressed(self._keys[index])
                return True
            left = right
        return False

    def _labels(self) -> list[Line]:
        return [[("key", f"[{_(key.printed)} {_(key.short)}]"), " "] for key in self._keys]
