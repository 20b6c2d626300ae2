"""Widgets with words in them, and lines of marked text that are drawn without a widget.

Rule: whatever they are given, a terminal only prints: what it would obey is escaped. Every text on the screen is one of
these; tests/ui/test_hidden_characters.py holds that no screen makes urwid's own.
"""

import re
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, Literal, TypeVar

import urwid

from drillctl.language import LINES, masked, visible
from drillctl.ui.widgets import borders

Part = str | tuple[str, str]
Line = list[Part]
Names = list[tuple[Hashable, int]]  # of attributes, and of how many bytes
Charsets = list[tuple[Literal["0", "U"] | None, int]]
Run = tuple[Hashable, Literal["0", "U"] | None, bytes]  # attribute, character set, text
Looks = Mapping[Hashable, Hashable]  # attributes that stand for others
Size = tuple[()] | tuple[int] | tuple[int, int]  # as urwid hands it to a widget: nothing, columns, or a box
# Whether all characters are of the alphabets, lines, blocks and braille that take one column each: urwid counts the
# columns of any other text character by character.
_NARROW = re.compile("[\x00-\x7f\xa1-\xac\xae-\u017f\u2500-\u259f\u2800-\u28ff]*").fullmatch
DRAWN = 1024  # lines that are kept as they were drawn last: several screens of a large terminal
KEPT = LINES.replace("\t", "")  # urwid gives a tab no columns
Markup = TypeVar("Markup")


def shown(markup: Markup) -> Markup:
    """urwid's markup, the text in it escaped: a string, a pair of attribute and markup, or a list of markup."""
    found: Any = markup
    if isinstance(found, str):
        return visible(found, KEPT)  # type: ignore[return-value]  # a str for a str
    if isinstance(found, tuple):
        return (found[0], shown(found[1]))  # type: ignore[return-value]
    return [shown(part) for part in found]  # type: ignore[return-value]


class Text(urwid.Text):
    """A text that is only read."""

    _given: Any = None

    def set_text(self, markup: Any) -> None:
        """Shows another text, escaped. The same text again draws nothing: screens hand theirs on at every beat."""
        given = list(markup) if isinstance(markup, list) else markup
        if given != self._given:
            self._given = given
            super().set_text(shown(markup))


class WholeText(Text):
    """A text of one line that is shown whole, or not at all where there are too few columns."""

    def __init__(self, markup: Any):
        super().__init__(markup, wrap="clip")

    def render(self, size: Size, focus: bool = False) -> urwid.TextCanvas:
        """Draws the text, or an empty line."""
        assert len(size) < 2
        if size and width_of([str(self.text)]) > size[0]:
            return urwid.TextCanvas([b""], maxcol=size[0])
        return super().render(size, focus)


class Icon(urwid.SelectableIcon):
    """A line of a list that can have the cursor."""

    def set_text(self, markup: Any) -> None:
        """Shows another text, its control characters escaped."""
        super().set_text(shown(markup))


class Edit(urwid.Edit):
    """A field: shows one mark for each character that is not printed, and keeps the text as it is."""

    def get_text(self) -> Any:
        """Caption and text as they are drawn, with their attributes."""
        text, attributes = super().get_text()
        return masked(str(text)), attributes


class Button(urwid.Button):
    """A button that calls something when it is pressed."""

    def __init__(self, label: str, pressed: Any):
        super().__init__(visible(label), pressed)


class Box(urwid.LineBox[urwid.Widget]):
    """A frame around a widget."""

    def __init__(self, inside: urwid.Widget, title: str = ""):
        across, down, *corners = borders.lines()
        super().__init__(
            inside, visible(title), "left", "title",
            tlcorner=corners[0], tline=across, trcorner=corners[1], lline=down, rline=down,
            blcorner=corners[2], bline=across, brcorner=corners[3],
        )  # fmt: skip

    def set_title(self, text: Any) -> None:
        """Shows another title, its control characters escaped."""
        super().set_title(shown(text))


class Link(Text):
    """``chosen`` is called for a click with the first button. The cursor doesn't come here, so no key calls it."""

    def __init__(self, text: str | Line, chosen: Callable[[], object], wrap: Literal["space", "ellipsis"] = "space"):
        self._chosen = chosen
        super().__init__(text, wrap=wrap)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Chooses the line for a press of the first button."""
        if event != "mouse press" or button != 1:
            return False
        self._chosen()
        return True


class Pick(Link):
    """``chosen`` is called for Enter and for the further ``keys``, and for a click with the first button."""

    _selectable = True

    def __init__(
        self, text: str | Line, chosen: Callable[[], object], *keys: str, wrap: Literal["space", "ellipsis"] = "space"
    ):
        self._keys = ("enter", *keys)
        super().__init__(text, chosen, wrap)

    def keypress(self, size: Size, key: str) -> str | None:
        """Chooses the line for Enter and the further keys; returns any other key."""
        if key not in self._keys:
            return key
        self._chosen()
        return None


def boxed(lines: Sequence[Line], columns: int, rows: int) -> urwid.Canvas:
    """A canvas of exactly this size: lines are clipped, missing ones left empty. Drawn without a widget: most of
    what is new twenty times a second comes by here.
    """
    encoding = urwid.util.get_encoding()
    drawn = [_drawn(tuple(line), columns, encoding) for line in [*lines[:rows], *[[]] * (rows - len(lines))]]
    return _Rows(drawn, columns)


class _Rows(urwid.Canvas):
    """Rows that are already cut into runs of one look: urwid's own canvas cuts them anew whenever it is drawn."""

    def __init__(self, drawn: Sequence[Sequence[Run]], columns: int):
        super().__init__()
        self._drawn, self._columns = drawn, columns

    def cols(self) -> int:
        """How many columns it has."""
        return self._columns

    def rows(self) -> int:
        """How many rows it has."""
        return len(self._drawn)

    def content(
        self, trim_left: int = 0, trim_top: int = 0, cols: int = 0, rows: int = 0, attr: Looks | None = None
    ) -> Iterator[list[Run]]:
        """The rows of a part of the canvas as urwid wants them; ``attr`` maps names of attributes to others."""
        if trim_left or cols not in (0, self._columns):
            yield from self._as_text().content(trim_left, trim_top, cols, rows, attr)
            return
        for runs in self._drawn[trim_top : trim_top + rows if rows else None]:
            yield [(attr.get(name, name), charset, text) for name, charset, text in runs] if attr else [*runs]

    def _as_text(self) -> urwid.TextCanvas:
        """The same as a canvas of urwid's own, which knows how a character is cut that takes two columns."""
        texts = [b"".join(text for _name, _charset, text in runs) for runs in self._drawn]
        names: list[Names] = [[(name, len(text)) for name, _charset, text in runs] for runs in self._drawn]
        charsets: list[Charsets] = [[(charset, len(text)) for _name, charset, text in runs] for runs in self._drawn]
        return urwid.TextCanvas(texts, names, charsets, maxcol=self._columns, check_width=False)


def around(cursor: int, count: int, room: int) -> range:
    """The indices that are shown of ``count`` things where there is room for fewer: those around the cursor."""
    first = min(max(cursor - room // 2, 0), max(count - room, 0))
    return range(first, min(first + room, count))


def packed(parts: Sequence[Line], columns: int) -> list[Line]:
    """Parts side by side in as many lines as they need; no part is broken."""
    return [[piece for index in line for piece in parts[index]] for line in indices_packed(parts, columns)]


def indices_packed(parts: Sequence[Line], columns: int) -> list[list[int]]:
    """For each line of ``packed`` the indices of the parts that stand in it, from left to right."""
    lines: list[list[int]] = [[]]
    used = 0
    for index, part in enumerate(parts):
        width = width_of(part)
        if lines[-1] and used + width > columns:
            lines.append([])
            used = 0
        lines[-1].append(index)
        used += width
    return lines


@lru_cache(DRAWN)
def _drawn(line: tuple[Part, ...], columns: int, encoding: str) -> Sequence[Run]:
    """A line in runs, as a canvas has it. Kept, as most lines are the same in the next frame; ``encoding`` is the one
    in force.
    """
    room = columns
    runs: list[Run] = []
    for part in line:
        attribute, words = (None, part) if isinstance(part, str) else part
        encoded, charsets, width, whole = _encoded(words, min(room, _columns(words)), encoding)
        room -= width
        begin = 0
        for charset, length in charsets:
            _join(runs, attribute, charset, encoded[begin : begin + length])
            begin += length
        if not whole:
            break
    _join(runs, None, None, b" " * room)
    return tuple(runs)


def _join(runs: list[Run], name: Hashable, charset: Literal["0", "U"] | None, text: bytes) -> None:
    """Adds a text, to the last run where it looks the same; no run is empty."""
    if runs and runs[-1][:2] == (name, charset):
        text = runs.pop()[2] + text
    if text:
        runs.append((name, charset, text))


@lru_cache(DRAWN)
def _encoded(words: str, room: int, encoding: str) -> tuple[bytes, Charsets, int, bool]:
    """A part of a line, clipped to its room: bytes, character sets, columns, and whether nothing was clipped off."""
    words = visible(words)
    end, width = _fitting(words, room)
    encoded, sets = urwid.apply_target_encoding(words[:end])
    return encoded, sets, width, end == len(words)


def _fitting(words: str, room: int) -> tuple[int, int]:
    """How many characters of a text fit into so many columns, and how many columns they take."""
    if _NARROW(words):
        return min(len(words), room), min(len(words), room)
    end, width = urwid.calc_text_pos(words, 0, len(words), room)
    return end, width


def width_of(line: Line) -> int:
    """How many columns a line takes."""
    return sum(_columns(part if isinstance(part, str) else part[1]) for part in line)


@lru_cache(DRAWN)
def _columns(text: str) -> int:
    shown_text = visible(text)
    return len(shown_text) if _NARROW(shown_text) else urwid.calc_width(shown_text, 0, len(shown_text))
