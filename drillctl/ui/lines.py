"""Lines of marked text: what the board, the side window and the key line are in the end."""

from collections.abc import Sequence

import urwid

Line = list[str | tuple[str, str]]
Size = tuple[()] | tuple[int] | tuple[int, int]  # as urwid hands it to a widget: nothing, columns, or a box


def boxed(lines: Sequence[Line], columns: int, rows: int) -> urwid.Canvas:
    """A canvas of exactly this size: lines are clipped, missing ones left empty."""
    markup = [part for line in lines[:rows] for part in [*line, "\n"]][:-1]
    canvas = urwid.CompositeCanvas(urwid.Text(markup, wrap="clip").render((columns,)))
    canvas.pad_trim_top_bottom(0, rows - canvas.rows())
    return canvas


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


def width_of(line: Line) -> int:
    """Columns that a line takes."""
    return sum(urwid.calc_width(text, 0, len(text)) for text in (p if isinstance(p, str) else p[1] for p in line))
