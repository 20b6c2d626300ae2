"""A box that finds a line among many by words: a field to type in, and below it the lines that fit, the best first.

Rule: the words may be typed in any order and cut short, in any of the languages that a line is known by. No screen is
known here.
"""

from collections.abc import Callable, Sequence
from fnmatch import fnmatchcase
from glob import escape
from typing import Any, NamedTuple

import urwid

from drillctl.language.words import _
from drillctl.ui.widgets.texts import Box, Edit, Pick, Size, Text

COLUMNS, ROWS = 72, 16


class Found(NamedTuple):
    """A line to be found: how it is shown, and the texts that it is found by, one for each language."""

    line: str
    known_by: tuple[str, ...]


UNLIKE = 1000  # farther than any text that fits


def fitting(entries: Sequence[Found], typed: str) -> list[int]:
    """Returns the indices of the entries that fit what was typed, the best first; all of them for no words."""
    words = typed.lower().split()
    ranked = [(min(_distance(text.lower(), words) for text in entry.known_by), i) for i, entry in enumerate(entries)]
    return [index for distance, index in sorted(ranked) if distance < UNLIKE]


def fits(name: str, patterns: str) -> bool:
    """Whether a name has one of the patterns, separated by blanks, in it; one with ``*`` or ``?`` is for all of it."""
    wanted = [pattern if set(pattern) & set("*?") else f"*{escape(pattern)}*" for pattern in patterns.lower().split()]
    return any(fnmatchcase(name.lower(), pattern) for pattern in wanted)


def _distance(text: str, words: Sequence[str]) -> int:
    """How far the typed words are from a text: 0 where each begins a word of it; UNLIKE where one doesn't fit."""
    return min(UNLIKE, sum(_distance_of_word(text, word) for word in words))


def _distance_of_word(text: str, word: str) -> int:
    """0 for the beginning of a word of the text, 1 within one, 5 for letters in their order, else UNLIKE."""
    if any(part.startswith(word) for part in text.split()):
        return 0
    if word in text:
        return 1
    letters = iter(text)
    return 5 if all(letter in letters for letter in word) else UNLIKE


class Finder(urwid.WidgetWrap[urwid.Widget]):
    """``chosen`` is called with the index of the entry that Enter or a click chose; ``closing`` before, and for Esc."""

    def __init__(
        self, title: str, entries: Sequence[Found], chosen: Callable[[int], object], closing: Callable[[], object]
    ):
        self._entries, self._chosen, self._closing = entries, chosen, closing
        self._edit = Edit(("body", f"{_('Words:')} "))
        self._rows: urwid.SimpleFocusListWalker[urwid.AttrMap[Pick]] = urwid.SimpleFocusListWalker([])
        self._count = Text("")
        head = urwid.Pile([urwid.AttrMap(self._edit, "field"), self._count])
        frame: urwid.Frame[Any, Any, Any] = urwid.Frame(urwid.ListBox(self._rows), header=head)
        urwid.connect_signal(self._edit, "postchange", lambda _edit, _before: self._list_fitting())
        self._list_fitting()
        super().__init__(urwid.AttrMap(Box(urwid.Padding(frame, left=1, right=1), title), "body"))

    def keypress(self, size: Size, key: str) -> str | None:
        """Moves in the list, chooses, closes, or types; no key passes the box."""
        if key == "esc":
            self._closing()
        elif (left := super().keypress(size, key)) is not None:
            self._edit.keypress((COLUMNS,), left)
        return None

    def _list_fitting(self) -> None:
        indices = fitting(self._entries, self._edit.edit_text)
        picks = [Pick(self._entries[index].line, self._act(index)) for index in indices]
        self._rows[:] = [urwid.AttrMap(pick, "body", "focus") for pick in picks]
        self._count.set_text(("dark", _("{count} of {total} fit").format(count=len(picks), total=len(self._entries))))
        if picks:
            self._rows.set_focus(0)

    def _act(self, index: int) -> Callable[[], None]:
        def act() -> None:
            self._closing()
            self._chosen(index)

        return act
