"""A window: a screen's part with a title, in a border where there is room for one."""

import urwid

from drillctl.ui.widgets.texts import Box


class Window(urwid.WidgetPlaceholder[urwid.Widget]):
    """Shows ``inside`` with or without a border. Without one its title is not shown: the room is for the data."""

    def __init__(self, inside: urwid.Widget, title: str = ""):
        self.inside = inside
        self._box = Box(urwid.AttrMap(inside, {None: "body"}), title)
        self._boxed = urwid.AttrMap(self._box, {None: "border"})
        super().__init__(inside)

    def set_title(self, title: str) -> None:
        """Shows another title."""
        self._box.set_title(title)

    def show(self, framed: bool) -> None:
        """Draws the border, or leaves it away."""
        wanted = self._boxed if framed else self.inside
        if self.original_widget is not wanted:
            self.original_widget = wanted
