"""A box of lines that a function gives: what a window draws where no widget is needed."""

from collections.abc import Callable

import urwid

from drillctl.ui.widgets.texts import Line, Size, boxed


class Drawn(urwid.Widget):
    """A box of lines that ``lines`` gives for its columns and rows."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, lines: Callable[[int, int], list[Line]]):
        super().__init__()
        self._lines = lines
        self._values: tuple[object, ...] = ()

    def depend(self, *values: object) -> None:
        """Takes what the lines are made of, and draws them anew if that is something else than at the last call."""
        if values != self._values:
            self._values = values
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the lines that fit."""
        assert len(size) == 2
        return boxed(self._lines(*size), *size)
