"""A line that can be chosen, with Enter or a click: what menus and lists are made of."""

from collections.abc import Callable

from drillctl.ui.widgets.lines import Line, Size
from drillctl.ui.widgets.texts import Text


class Pick(Text):
    """``chosen`` is called for Enter and for the further ``keys``, and for a click with the first button."""

    _selectable = True

    def __init__(self, text: str | Line, chosen: Callable[[], object], *keys: str):
        self._chosen, self._keys = chosen, ("enter", *keys)
        super().__init__(text, wrap="ellipsis")

    def keypress(self, size: Size, key: str) -> str | None:
        """Anything else is somebody else's."""
        if key not in self._keys:
            return key
        self._chosen()
        return None

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """A press of the first button."""
        if event != "mouse press" or button != 1:
            return False
        self._chosen()
        return True
