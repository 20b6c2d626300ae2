"""The terminal that the screen is drawn on: of each row only the part that has changed is written.

urwid's own draws every row that has changed whole, and turns the looks of all rows into escape sequences before it
compares them; at 20 frames a second that is most of what a frame costs (benchmarks/screen.py). The rows of a canvas
that was in the frame before already are not asked for again (ui/canvas_rows.py).
"""

from collections.abc import Iterator
from functools import lru_cache

import urwid
from urwid.display import escape

from drillctl.ui.canvas_rows import CanvasRows, Row

CONTROLS = dict.fromkeys([*range(0x20), *range(0x7F, 0xA0)], "?")  # what a file's name may hold, and a terminal obeys
WRAP_OFF, WRAP_ON = "\x1b[?7l", "\x1b[?7h"  # DECAWM: else the cell in the lower right corner moves all rows up


class Painter(urwid.display.raw.Screen):
    """urwid's screen on a terminal, with its drawing replaced where the terminal takes UTF-8."""

    _rows: CanvasRows | None = None
    _cursor: tuple[int, int] | None = None

    def draw_screen(self, size: tuple[int, int], canvas: urwid.Canvas) -> None:
        """Writes what differs from the frame before: nothing, where nothing does.

        size  columns and rows

        Raises OSError where the terminal can't be written to.
        """
        if urwid.util.get_encoding() != "utf-8":
            super().draw_screen(size, canvas)
            return
        if self._rows is None:
            self._rows = CanvasRows()
        if self.screen_buf and canvas is self._rows.canvas:
            return
        drawn: list[Row] = self.screen_buf or []
        if len(drawn) != size[1]:
            drawn = [[] for _ in range(size[1])]
        rows = self._rows.of(canvas)
        pairs = enumerate(zip(drawn, rows, strict=True))
        changes = [part for y, (old, new) in pairs for part in self._part(y, old, new)]
        if changes or canvas.cursor != self._cursor or not self.screen_buf:
            cursor = [] if canvas.cursor is None else [escape.set_cursor_position(*canvas.cursor), escape.SHOW_CURSOR]
            self.write("".join([escape.HIDE_CURSOR, WRAP_OFF, *changes, WRAP_ON, *cursor]))
            self.flush()
        self.screen_buf, self._cursor = rows, canvas.cursor

    def _part(self, y: int, old: Row, new: Row) -> Iterator[str]:
        """What writes the part of a row from its first to its last run that is not as it was."""
        if old == new:
            return
        first, end = _unequal(old, new)
        yield escape.set_cursor_position(sum(_width(text) for _look, _charset, text in new[:first]), y)
        for look, _charset, text in new[first:end]:
            yield self._attr_to_escape(look)
            yield text.decode("utf-8", "replace").translate(CONTROLS)


def _unequal(old: Row, new: Row) -> tuple[int, int]:
    """The first run of ``new`` that differs, and the end of those that do; what follows the end stands as it stood."""
    shorter = min(len(old), len(new))
    first = next((index for index in range(shorter) if old[index] != new[index]), shorter)
    same = next((back for back in range(shorter - first) if old[~back] != new[~back]), shorter - first)
    return first, len(new) - same


@lru_cache(maxsize=4096)  # what stands before a change mostly stood there in the frame before
def _width(text: bytes) -> int:
    return len(text) if text.isascii() else urwid.calc_width(text, 0, len(text))
