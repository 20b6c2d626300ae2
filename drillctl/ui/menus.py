"""The menus as a table, and the boxes that drop from the bar.

Rule: a row says which screen comes to the front and which of its methods is called; the frame does the rest, so a new
entry is a new row. ``&`` stands before the hot letter, in every language. Used by app.py.
"""

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import NamedTuple

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.screens.formats import FORMATS
from drillctl.ui.widgets.lines import Line, Size
from drillctl.ui.widgets.pick import Pick
from drillctl.ui.widgets.texts import Box


class Item(NamedTuple):
    """An entry: an empty ``screen`` means the frame itself; with ``items`` it opens a further box."""

    label: str
    screen: str = ""
    method: str = ""
    argument: str | None = None
    items: tuple["Item", ...] = ()


FORMAT_ITEMS = (
    *(Item(entry.name, "files", "set_format", entry.option) for entry in FORMATS),
    Item(N_("&Typed..."), "files", "type_format"),
)
PLACING_ITEMS = (
    Item(N_("&Mirror"), "files", "cycle", "mirror"),
    Item(N_("&Turn"), "files", "cycle", "rotate_deg"),
    Item(N_("&Origin"), "files", "cycle", "origin"),
    Item(N_("O&ffset..."), "files", "offset"),
    Item(N_("&Panel..."), "files", "panel"),
    Item(N_("Measured &holes..."), "files", "align"),
)
BASING_ITEMS = (
    Item(N_("Type &X and Y..."), "drilling", "type_place"),
    Item(N_("Go to a &hole..."), "drilling", "go_to_hole"),
    Item(N_("Set the &base here"), "drilling", "set_base"),
)
MENUS = (
    Item(N_("&Files"), items=(
        Item(N_("&Open..."), "files"),
        Item(N_("R&ecent..."), "files", "recent"),
        Item(N_("&Interrupted jobs..."), "files", "unfinished"),
        Item(N_("&Format"), items=FORMAT_ITEMS),
        Item(N_("&Placing"), items=PLACING_ITEMS),
        Item(N_("O&rder of the holes"), "files", "cycle", "order"),
        Item(N_("How to &drill..."), "files", "how_to_drill"),
        Item(N_("&Quit"), "", "leave"),
    )),
    Item(N_("&Drilling"), items=(
        Item(N_("&Start"), "drilling", "start"),
        Item(N_("&Dry run, drill up"), "drilling", "dry_run"),
        Item(N_("&Hold or go on"), "drilling", "hold_or_resume"),
        Item(N_("S&top"), "drilling", "stop"),
        Item(N_("&Basing"), items=BASING_ITEMS),
        Item(N_("&Initialisation"), "drilling", "initialise"),
        Item(N_("&Acknowledge a fault"), "drilling", "acknowledge"),
    )),
    Item(N_("&Tests"), items=(
        Item(N_("&Phase tables"), "phase_editor"),
        Item(N_("&Ramp tables"), "ramp_editor"),
        Item(N_("&Queue of commands"), "queue_editor"),
        Item(N_("&Signals"), "signals"),
        Item(N_("S&cope"), items=(
            Item(N_("&The machine's run"), "scope", "show_machine"),
            Item(N_("&Open a trace..."), "scope", "open_file"),
        )),
    )),
    Item(N_("&Configuration"), items=(
        Item(N_("&Parameters"), "configuration"),
        Item(N_("&Machine..."), "", "choose_machine"),
        Item(N_("Interrupt &frequency..."), "drilling", "type_tick_hz"),
        Item(N_("P&ort"), "port"),
        Item(N_("&Colours"), items=(
            Item(N_("&Colour"), "", "set_theme", "colour"),
            Item(N_("&Light"), "", "set_theme", "light"),
            Item(N_("&Monochrome"), "", "set_theme", "mono"),
        )),
    )),
    Item(N_("&Help"), items=(
        Item(N_("&Keys"), "", "help"),
        Item(N_("&Notices"), "", "notices"),
        Item(N_("&About"), "", "about"),
    )),
)  # fmt: skip


def plain_label(item: Item) -> str:
    """Without the mark."""
    return _(item.label).replace("&", "")


def hot_letter(item: Item) -> str:
    """In lower case; empty where there is none."""
    _before, _mark, rest = _(item.label).partition("&")
    return rest[:1].lower()


def label_markup(item: Item) -> Line:
    """With the hot letter marked."""
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
        """Nothing passes an open menu."""
        left = super().keypress(size, key)
        if left == "esc":
            self._closing()
        elif left in ("left", "right"):
            self._sideways(-1 if left == "left" else 1)
        elif left is not None:
            self._letter(left)
        return None

    def _row(self, item: Item) -> Pick:
        further = (" >", "right") if item.items else ("",)
        return Pick([*label_markup(item), further[0]], lambda: self._chosen(item), *further[1:])

    def _letter(self, key: str) -> None:
        for item in self._items:
            if key.lower() == hot_letter(item):
                self._chosen(item)
                return
