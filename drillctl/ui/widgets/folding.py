"""Long lines in as many short ones as a width asks for."""

import textwrap
from collections.abc import Iterable

from drillctl.ui.widgets.texts import Line


def folded(lines: Iterable[Line], columns: int) -> list[Line]:
    """Returns the lines in rows of so many columns. A line of one look is wrapped; one of several, as a label with its
    value, stays as it is.
    """
    return [row for line in lines for row in _rows(line, max(columns, 1))]


def _rows(line: Line, columns: int) -> list[Line]:
    if len(line) > 1:
        return [line]
    look, text = ("body", line[0]) if isinstance(line[0], str) else line[0]
    return [[(look, row)] for row in textwrap.wrap(text, columns) or [""]]
