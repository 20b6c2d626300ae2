"""Notes what a terminal has no room for while a screen is drawn: lines that are clipped, titles that are left away.

Rule: what is noted is the whole text and the columns it got; which texts may be cut is for the test to say.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import pytest
import urwid

from drillctl.ui.widgets import texts, windows
from drillctl.ui.widgets.texts import Line, Part, width_of


class Cut(NamedTuple):
    """A text that got fewer columns than it is wide: a ``line``, a ``text``, a ``title``, or one ``elided``, with a
    sign of it at its end.
    """

    kind: str
    text: str
    columns: int


class Cuts:
    """The cuts since the last look, each once."""

    def __init__(self) -> None:
        self.found: dict[Cut, None] = {}

    def note(self, kind: str, line: Line, columns: int) -> None:
        """Keeps a line that is wider than the columns it gets."""
        if width_of(line) > columns:
            self.found[Cut(kind, plain(line), columns)] = None

    def take(self) -> list[Cut]:
        """Those found since the last call."""
        found = [*self.found]
        self.found.clear()
        return found


def plain(line: Line) -> str:
    """The words of a line, without trailing spaces."""
    return "".join(part if isinstance(part, str) else part[1] for part in line).rstrip()


def is_word_cut(cut: Cut) -> bool:
    """Whether a cut leaves words away that the program itself has put there: what is beyond the columns has a letter in
    it. The name of a file may be elided, and the line on the machine, whose notice has a box of its own.
    """
    may_be = cut.kind == "elided" and (" " not in cut.text.strip() or " | " in cut.text)
    return not may_be and any(sign.isalpha() for sign in cut.text[cut.columns :])


@contextmanager
def noted() -> Iterator[Cuts]:
    """While this is open, whatever is cut in drawing is noted."""
    cuts = Cuts()
    drawn, sides, render = texts._drawn, windows._sides, urwid.Text.render

    def draws(line: tuple[Part, ...], columns: int, encoding: str) -> Any:
        cuts.note("line", [plain([*line])], columns)
        return drawn(line, columns, encoding)

    def frames(title: str, columns: int, rows: int) -> Any:
        cuts.note("title", [f" {title} "], columns - 2)
        return sides(title, columns, rows)

    def renders(self: urwid.Text, size: tuple[int] | tuple[()], focus: bool = False) -> Any:
        if size and self.wrap in ("clip", "ellipsis"):
            for row in str(self.text).split("\n"):
                cuts.note("elided" if self.wrap == "ellipsis" else "text", [row.rstrip()], size[0])
        return render(self, size, focus)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(texts, "_drawn", draws)
        patched.setattr(windows, "_sides", frames)
        patched.setattr(urwid.Text, "render", renders)
        yield cuts
