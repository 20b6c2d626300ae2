"""Lines of marked text: what the board, the side window and the key line are in the end.

Rule: escaped as they are drawn, as the widgets of texts.py are.
"""

from collections.abc import Hashable, Sequence
from typing import Literal

import urwid

from drillctl.language import visible

Line = list[str | tuple[str, str]]
Names = list[tuple[Hashable, int]]  # of attributes, and of how many bytes
Charsets = list[tuple[Literal["0", "U"] | None, int]]
Size = tuple[()] | tuple[int] | tuple[int, int]  # as urwid hands it to a widget: nothing, columns, or a box


def boxed(lines: Sequence[Line], columns: int, rows: int) -> urwid.Canvas:
    """A canvas of exactly this size: lines are clipped, missing ones left empty. Drawn without a widget: most of
    what is new twenty times a second comes by here.
    """
    drawn = [_drawn(line, columns) for line in [*lines[:rows], *[[]] * (rows - len(lines))]]
    texts = [text for text, _names, _sets in drawn]
    attributes = [names for _text, names, _sets in drawn]
    charsets = [sets for _text, _names, sets in drawn]
    return urwid.TextCanvas(texts, attributes, charsets, maxcol=columns, check_width=False)


def around(cursor: int, count: int, room: int) -> range:
    """Which of ``count`` things are shown where there is room for fewer: those about the cursor."""
    first = min(max(cursor - room // 2, 0), max(count - room, 0))
    return range(first, min(first + room, count))


def packed(parts: Sequence[Line], columns: int) -> list[Line]:
    """Parts side by side, none of them broken, in as many lines as they need."""
    lines: list[Line] = [[]]
    for part in parts:
        if lines[-1] and width_of([*lines[-1], *part]) > columns:
            lines.append([])
        lines[-1].extend(part)
    return lines


def _drawn(line: Line, columns: int) -> tuple[bytes, Names, Charsets]:
    """A line as canvases have it: its bytes, and how many of them are of each attribute, and of each character set."""
    text, room = b"", columns
    attributes: Names = []
    charsets: Charsets = []
    for part in line:
        attribute, words = (None, part) if isinstance(part, str) else part
        words = visible(words)
        end, width = _fitting(words, room)
        encoded, sets = urwid.apply_target_encoding(words[:end])
        text, room = text + encoded, room - width
        attributes.append((attribute, len(encoded)))
        charsets += sets
        if end < len(words):
            break
    return text + b" " * room, [*attributes, (None, room)], [*charsets, (None, room)]


def _fitting(words: str, room: int) -> tuple[int, int]:
    """How many characters of a text fit into so many columns, and how many columns they take."""
    if words.isascii():
        return min(len(words), room), min(len(words), room)
    end, width = urwid.calc_text_pos(words, 0, len(words), room)
    return end, width


def width_of(line: Line) -> int:
    """Columns that a line takes."""
    texts = (visible(part if isinstance(part, str) else part[1]) for part in line)
    return sum(urwid.calc_width(text, 0, len(text)) for text in texts)
