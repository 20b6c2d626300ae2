"""Long lines in as many short ones as a width asks for."""

import textwrap
from collections.abc import Iterable
from itertools import groupby

from drillctl.ui.widgets.texts import Line, Part, width_of


def folded(lines: Iterable[Line], columns: int) -> list[Line]:
    """Returns the lines in rows of so many columns, broken between words; every word keeps its look. A line that has
    room, as a label with its value, stays as it is.
    """
    return [row for line in lines for row in _rows(line, max(columns, 1))]


def _rows(line: Line, columns: int) -> list[Line]:
    if len(line) == 1 and isinstance(line[0], str):
        line = [("body", line[0])]
    if len(line) > 1 and width_of(line) <= columns:
        return [line]
    signs = [(look, sign) for look, text in map(_looked, line) for sign in text]
    text, rows, at = "".join(sign for _look, sign in signs), [], 0
    for row in textwrap.wrap(text, columns, expand_tabs=False, replace_whitespace=False):
        at = text.index(row, at)
        rows.append(_parts(signs[at : at + len(row)]))
        at += len(row)
    return rows or [line]


def _looked(part: Part) -> tuple[str | None, str]:
    return (None, part) if isinstance(part, str) else part


def _parts(signs: Iterable[tuple[str | None, str]]) -> Line:
    """Signs with their looks as marked text."""
    runs = [(look, "".join(sign for _look, sign in run)) for look, run in groupby(signs, key=lambda sign: sign[0])]
    return [text if look is None else (look, text) for look, text in runs]
