"""The list of every action: the entries of the menus, and the keys of the screens that were opened.

Rule: made from the menus and the key tables alone, so that an action that is there can be found. Each is found by its
words in English and in the operator's language.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import urwid

from drillctl.language.words import _
from drillctl.ui.frame import screen_keys
from drillctl.ui.widgets.finder import Found
from drillctl.ui.widgets.keys import FRAME_KEYS, Key
from drillctl.ui.widgets.menus import Item, plain_label


class Action(NamedTuple):
    """What can be done: how it is found, the entry or key that does it, and the screen of a key (None: the program)."""

    found: Found
    does: Item | Key
    screen: urwid.Widget | None = None


def actions(menus: Sequence[Item], top: urwid.Widget, others: Iterable[urwid.Widget]) -> list[Action]:
    """Returns every action: keys of the screen on top, entries of the menus, keys of other screens and of the frame."""
    own = [_of_key(key, top) for key in screen_keys(top)]
    elsewhere = [_of_key(key, screen) for screen in others if screen is not top for key in screen_keys(screen)]
    return [*own, *_of_menus(menus, ()), *elsewhere, *(_of_key(key, None) for key in FRAME_KEYS)]


def _of_menus(items: Sequence[Item], above: tuple[Item, ...]) -> Iterator[Action]:
    for item in items:
        path = (*above, item)
        if item.items:
            yield from _of_menus(item.items, path)
        else:
            line = " > ".join(map(plain_label, path))
            english = " ".join(part.label.replace("&", "") for part in path)
            yield Action(Found(line, (line, english)), item)


def _of_key(key: Key, screen: urwid.Widget | None) -> Action:
    title = getattr(screen, "title", "")
    where = f"{_(title)}: " if title else ""
    known_by = (f"{_(title)} {_(key.short)} {_(key.help)}", f"{title} {key.short} {key.help}")
    return Action(Found(f"{where}{_(key.help)}  [{_(key.printed)}]", known_by), key, screen)
