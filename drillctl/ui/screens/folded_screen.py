"""What screens share that only show lines of text and have a table of keys."""

from collections.abc import Sequence

import urwid

from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.texts import Line, Size, boxed


class FoldedScreen(urwid.Widget):
    """Draws ``lines`` folded to its width. A subclass has a table ``keys``, and a method for each of them."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _selectable = True
    keys: tuple[Key, ...]

    def lines(self) -> Sequence[Line]:
        """Returns what the screen says now."""
        raise NotImplementedError  # by PortScreen and PlantScreen

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; returns any other key for the frame."""
        return None if called(self, self.keys, key) else key

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the lines, folded to the width."""
        assert len(size) == 2
        columns, rows = size
        return boxed(folded(self.lines(), columns), columns, rows)
