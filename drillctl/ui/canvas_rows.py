"""The rows of a frame, put together of those of its parts; parts that are as in the frame before give theirs again.

Rule: the same rows as ``Canvas.content``. urwid composes a frame of views of canvases (``CompositeCanvas.shards``) and
asks all of them for their rows at each frame; a widget that has not changed hands on the canvas of the frame before.
"""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

import urwid

Run = tuple[Hashable, Literal["0", "U"] | None, bytes]  # a name of the palette or None, the charset, the text
Row = list[Run]
Key = tuple[int, int, int, int, int, urwid.Canvas]  # of a view: what is seen of which canvas, through which looks
View = tuple[int, int, int, int, Mapping[Hashable, Hashable] | None, urwid.Canvas]  # left, top, columns, rows


class _Part(NamedTuple):
    """A view that has begun: its columns, the rows it still has from here on, and their runs."""

    columns: int
    rows: int
    runs: Iterator[Row]


class CanvasRows:
    """Makes the rows of one frame after the other. ``canvas``: that of the frame made last."""

    def __init__(self) -> None:
        self.canvas: urwid.Canvas | None = None  # held, so that no part is mistaken for a new one at its address
        self._made: dict[Key, list[Row]] = {}

    def of(self, canvas: urwid.Canvas) -> list[Row]:
        """The rows of a canvas as ``canvas.content()`` has them, to be read only."""
        before, self._made = self._made, {}
        shards = getattr(canvas, "shards", None)
        rows = list(canvas.content()) if shards is None else list(self._joined(shards, before))
        self.canvas = canvas
        return rows

    def _joined(self, shards: Sequence[tuple[int, Sequence[View]]], before: dict[Key, list[Row]]) -> Iterator[Row]:
        """Bands of rows, one after the other; a view may reach through several of them."""
        going: list[tuple[int, _Part]] = []  # those that reach on, each with the columns that are free to its left
        for count, views in shards:
            begun = (_Part(view[2], view[3], iter(self._rows_of(view, before))) for view in views)
            parts = [*_beside(going, begun)]
            for _ in range(count):
                yield [run for part in parts for run in next(part.runs)]
            going = _reaching_on(parts, count)

    def _rows_of(self, view: View, before: dict[Key, list[Row]]) -> list[Row]:
        left, top, columns, rows, looks, canvas = view[:6]
        key = left, top, columns, rows, id(looks), canvas
        found = before.get(key)
        if found is None:
            found = list(canvas.content(left, top, columns, rows, looks))
        self._made[key] = found
        return found


def _beside(going: Sequence[tuple[int, _Part]], begun: Iterator[_Part]) -> Iterator[_Part]:
    """The parts of a band from left to right: those that begin with it fill the columns between the others."""
    for free, part in going:
        filled = 0
        while filled < free:
            new = next(begun)
            filled += new.columns
            yield new
        yield part
    yield from begun


def _reaching_on(parts: Sequence[_Part], count: int) -> list[tuple[int, _Part]]:
    """The parts that have rows left after ``count`` of them."""
    found, free = [], 0
    for columns, rows, runs in parts:
        if rows == count:
            free += columns
        else:
            found.append((free, _Part(columns, rows - count, runs)))
            free = 0
    return found
