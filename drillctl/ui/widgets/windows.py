"""A window: a screen's part with a title, in a border where there is room for one.

Rule: the border's four sides are canvases that are kept until size or title change. A frame of many windows is drawn
twenty times a second, and a LineBox lays its nine parts out each time.
"""

import urwid

from drillctl.ui.widgets.borders import lines
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of


class Window(urwid.WidgetDecoration[urwid.Widget]):
    """Shows ``inside`` with or without a border. Without one its title is not shown: the room is for the data."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _selectable = True

    def __init__(self, inside: urwid.Widget, title: str = ""):
        self.inside, self._title, self._framed = inside, title, False
        self._sides: tuple[urwid.Canvas, ...] = ()
        self._sides_for: tuple[str, Size] = ("", ())
        super().__init__(inside)

    def selectable(self) -> bool:
        """Whether the inside can have the cursor."""
        return self.inside.selectable()

    def set_title(self, title: str) -> None:
        """Draws this title in the upper border in place of the one before."""
        if title != self._title:
            self._title = title
            self._invalidate()

    def show(self, framed: bool) -> None:
        """Draws the border, or leaves it away."""
        if framed != self._framed:
            self._framed = framed
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.CompositeCanvas:
        """Draws the inside, within its border if it has one."""
        assert len(size) == 2
        inner = self.inside.render(self._inner(size), focus)
        if not self._bordered(size):
            return urwid.CompositeCanvas(inner)
        above, left, right, below = self._border(size)
        middle = urwid.CanvasJoin([(left, None, False, 1), (inner, None, True, size[0] - 2), (right, None, False, 1)])
        return urwid.CanvasCombine([(above, None, False), (middle, None, True), (below, None, False)])

    def keypress(self, size: Size, key: str) -> str | None:
        """Hands a key to the inside."""
        return self.inside.keypress(self._inner(size), key)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Hands an event to the inside, unless it is on the border."""
        inner = self._inner(size)
        edge = int(self._bordered(size))
        on_inside = 0 <= col - edge < inner[0] and 0 <= row - edge < inner[1]
        receives = on_inside and hasattr(self.inside, "mouse_event")
        return bool(receives and self.inside.mouse_event(inner, event, button, col - edge, row - edge, focus))

    def get_cursor_coords(self, size: Size) -> tuple[int, int] | None:
        """Where the inside has the cursor of the terminal, if it has it."""
        found = self.inside.get_cursor_coords(self._inner(size)) if hasattr(self.inside, "get_cursor_coords") else None
        edge = int(self._bordered(size))
        return (found[0] + edge, found[1] + edge) if found else None

    def _bordered(self, size: Size) -> bool:
        """Whether there is room for the border too."""
        assert len(size) == 2
        return self._framed and size[0] > 2 and size[1] > 2

    def _inner(self, size: Size) -> tuple[int, int]:
        assert len(size) == 2
        edges = 2 * self._bordered(size)
        return size[0] - edges, size[1] - edges

    def _border(self, size: Size) -> tuple[urwid.Canvas, ...]:
        """The sides above, left, right and below."""
        if self._sides_for != (self._title, size):
            self._sides_for = self._title, size
            assert len(size) == 2
            self._sides = _sides(self._title, *size)
        return self._sides


def _sides(title: str, columns: int, rows: int) -> tuple[urwid.Canvas, ...]:
    drawn = lines()
    heading: Line = [("title", f" {title} ")] if title else []
    left_over = columns - 2 - width_of(heading)
    above: Line = [("border", drawn.top_left), *heading, ("border", drawn.across * left_over + drawn.top_right)]
    if left_over < 0:
        above = [("border", drawn.top_left + drawn.across * (columns - 2) + drawn.top_right)]
    below: Line = [("border", drawn.bottom_left + drawn.across * (columns - 2) + drawn.bottom_right)]
    beside: list[Line] = [[("border", drawn.down)]] * (rows - 2)
    side = boxed(beside, 1, rows - 2)
    return boxed([above], columns, 1), side, side, boxed([below], columns, 1)
