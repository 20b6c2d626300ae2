"""Menus: their entries, and the box that drops from the menu bar. No screen and no machine is known here.

Rule: an entry says which screen comes to the front and which of its methods is called. ``&`` stands before the hot
letter of a label, in every language.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import NamedTuple

import urwid

from drillctl.language.words import _
from drillctl.ui.widgets.texts import Box, Line, Pick, Size


class Item(NamedTuple):
    """An entry: an empty ``screen`` means the program itself; an entry with ``items`` opens a further box."""

    label: str
    screen: str = ""
    method: str = ""
    argument: str | int | None = None
    items: tuple["Item", ...] = ()


def plain_label(item: Item) -> str:
    """The translated label of an entry without the mark of its hot letter."""
    return _(item.label).replace("&", "")


def hot_letter(item: Item) -> str:
    """The letter that chooses an entry, in lower case; an empty text where the label marks none."""
    _before, _mark, rest = _(item.label).partition("&")
    return rest[:1].lower()


def label_markup(item: Item) -> Line:
    """The translated label of an entry as marked text, its hot letter in the colour ``menu_hot``."""
    before, _mark, rest = _(item.label).partition("&")
    return [before, ("menu_hot", rest[:1]), rest[1:]] if rest else [before]


FOCUSED: Mapping[Hashable, Hashable] = {"menu_hot": "focus", None: "focus"}


class PullDown(urwid.WidgetWrap[urwid.Widget]):
    """A box of entries. ``sideways`` is called with -1 or 1 for a key that leads beyond it, ``closing`` for Esc."""

    def __init__(
        self, items: Sequence[Item], chosen: Callable[[Item], None], sideways: Callable[[int], None],
        closing: Callable[[], None],
    ):  # fmt: skip
        self._items, self._chosen, self._sideways, self._closing = items, chosen, sideways, closing
        rows = urwid.SimpleFocusListWalker([urwid.AttrMap(self._row(item), "menu", FOCUSED) for item in items])
        super().__init__(urwid.AttrMap(Box(urwid.ListBox(rows)), "menu"))
        self.columns = max(len(plain_label(item)) for item in items) + 4
        self.rows_wanted = len(items) + 2

    def keypress(self, size: Size, key: str) -> str | None:
        """Moves within the box, leaves it, or chooses an entry; an open menu passes no key on."""
        left = super().keypress(size, key)
        if left == "esc":
            self._closing()
        elif left in ("left", "right"):
            self._sideways(-1 if left == "left" else 1)
        elif left is not None:
            self._choose_by_letter(left)
        return None

    def _row(self, item: Item) -> Pick:
        further = (" >", "right") if item.items else ("",)
        return Pick([*label_markup(item), further[0]], lambda: self._chosen(item), *further[1:])

    def _choose_by_letter(self, key: str) -> None:
        """Chooses the entry with this letter; a q that no entry has closes the menu."""
        item = next((item for item in self._items if key.lower() == hot_letter(item)), None)
        if item is not None:
            self._chosen(item)
        elif key in ("q", "Q"):
            self._closing()
