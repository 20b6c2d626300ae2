"""A text to be read: a lab sheet. It is scrolled by its lines; nothing in it is changed."""

from collections.abc import Sequence

import urwid

from drillctl.language.words import N_
from drillctl.ui.widgets.texts import Icon


class Reader(urwid.WidgetWrap[urwid.Widget]):
    """Lines of text, the one that the cursor is on marked; arrows, PgUp and PgDn scroll."""

    title = N_("Lab sheet")

    def __init__(self, lines: Sequence[str]):
        rows = [urwid.AttrMap(Icon(line, 0), "title" if line.startswith("#") else "body", "accent") for line in lines]
        super().__init__(urwid.ListBox(urwid.SimpleFocusListWalker(rows or [Icon("")])))
