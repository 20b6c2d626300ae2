"""Somebody at the program who knows nothing but what its screens have said: a key is pressed only once it is named.

Named is a key that the line of keys, the line of the next step, a dialog or a box of help shows, and a letter that a
menu on the screen marks; Enter after a typed text needs no naming. Rule: nothing waits for a time; a key that is never
named fails with the screen as it is. Used by the hours of tests/ui.
"""

import re
from collections.abc import Iterable
from itertools import pairwise

from drillctl.language.words import _
from tests.support.labels import word
from tests.support.terminal import KEYS, Act, Terminal

ALT = "\x1b"
BOTTOM_ROWS = 4  # of the next step and the keys, which a narrow screen breaks into lines
MARKED = ("underscore", "bold", "fg")  # by any of which a menu sets off the letter of an entry
WORD = re.compile(r"[^\W\d]{3,}")  # of a text that is typed; numbers are the typist's own


class Reader(Terminal):
    """A terminal whose keys are pressed one by one, each when the screen has named it."""

    helped = ""  # every box of help that was read, as it was drawn
    seen = ""  # whatever else was read

    def play(self, acts: Iterable[Act]) -> None:
        """One after the other, each key named first."""
        for act in acts:
            for before, key in pairwise(("", *act.keys)):
                ends_text = key == "Enter" and len(before) > 2 and before not in KEYS
                self.until(lambda key=key, ends=ends_text: ends or self._names(key), f"nothing names the key {key!r}")
                self.press(key)
            self.wait_for(*act.shows, gone=act.gone)
            self.seen += self.text

    def read_help(self, known_by: str) -> None:
        """Opens the help of the screen, ``known_by`` a line of it, and turns its pages to the last."""
        last = f"< {word('OK')}"  # the button below the text
        self.play([Act(("F1",), (known_by,))])
        self.settle()  # a page that is half drawn names half of its keys
        self.helped += self.text
        while last not in self.text:
            page = self.text
            self.press("PgDn")
            self.until(lambda page=page: self.text != page, "the help shows no further page")
            self.settle()
            self.helped += self.text
        self.play([Act(("Esc",), (), gone=(last,))])

    def _names(self, key: str) -> bool:
        if key.startswith(ALT):
            return "Alt" in self.helped + self._bottom() and self._marks(key[1], range(1))
        if key in KEYS:
            return self._says(_(key), self._bottom(), self._boxes(), self.helped)
        if len(key) > 1:  # typed into a field
            return all(part in self.seen + self.text for part in WORD.findall(key))
        if f"({key.upper()})" in self.text or self._marks(key, range(self.screen.lines)):
            return True
        return self._says(_("Space") if key == " " else key.upper(), self._bottom(), self.helped)

    def _says(self, printed: str, *places: str) -> bool:
        """Whether it stands there as a word of its own."""
        alone = re.compile(rf"(?<![\w-]){re.escape(printed)}(?![\w-])")
        return any(alone.search(place) for place in places)

    def _marks(self, letter: str, rows: range) -> bool:
        """Whether one of these letters looks otherwise than what follows it, as the letters of menus do."""
        cells = [[self.screen.buffer[row][column] for column in range(self.screen.columns)] for row in rows]
        return any(
            cell.data.lower() == letter and any(getattr(cell, name) != getattr(after, name) for name in MARKED)
            for row in cells
            for cell, after in pairwise(row)
        )

    def _bottom(self) -> str:
        return "\n".join(self.screen.display[-BOTTOM_ROWS:])

    def _boxes(self) -> str:
        """The rows of dialogs, and of whatever else has a frame."""
        return "\n".join(row for row in self.screen.display if "│" in row)
