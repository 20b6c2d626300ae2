"""The board on the screen: holes to do, made, and current, and the head where it is.

Rule: every state has a sign of its own, so that nothing is told by colour alone.
"""

from collections.abc import Sequence
from itertools import groupby

import numpy as np
import urwid
from numpy.typing import NDArray

from drillctl.language.words import N_, _
from drillctl.ui.widgets.dots import BRAILLE, Sheet
from drillctl.ui.widgets.texts import Line, Size, boxed
from drillctl.viewmodel.console import BoardView

PlaceMm = tuple[float, float]
EMPTY = chr(BRAILLE)

# What a cell shows: its attribute, and its sign with and without UTF-8. Holes to do are braille where there is UTF-8.
SIGNS = {
    "to do": ("body", "", "."),
    "done": ("good", "○", "o"),
    "current": ("warning", "◎", "@"),
    "head": ("danger", "+", "+"),
}


class BoardPicture(urwid.Widget):
    """A box that draws a board; ``plain`` where the terminal has no UTF-8, ``hint``: what it says without one."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, plain: bool = False, hint: Sequence[str] = (N_("No board is loaded."),)):
        super().__init__()
        self._plain, self._hint = plain, hint
        self._state: tuple[BoardView | None, int, bool, PlaceMm | None] = (None, 0, False, None)

    def show(
        self, board: BoardView | None, done: int = 0, running: bool = False, head_mm: PlaceMm | None = None
    ) -> None:
        """Draws ``done`` holes as made and, if ``running``, the next as current; only if something is new."""
        state = (board, done, running, head_mm)
        if state != self._state:
            self._state = state
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the picture, clipped to the box."""
        assert len(size) == 2
        columns, rows = size
        return boxed(self._lines(columns, rows), columns, rows)

    def _lines(self, columns: int, rows: int) -> list[Line]:
        board, done, running, head_mm = self._state
        if board is None or not len(board.xy_mm):
            return [[("dark", f" {_(line)}")] for line in self._hint]
        sheet = Sheet.fitted(board.xy_mm, columns, rows)
        signs, states = self._drawn(sheet, board.xy_mm, done, running, head_mm)
        return [_runs(row, named) for row, named in zip(signs, states, strict=True)]

    def _drawn(
        self, sheet: Sheet, xy_mm: NDArray[np.float64], done: int, running: bool, head_mm: PlaceMm | None
    ) -> tuple[list[list[str]], list[list[str]]]:
        """Signs and states of the cells, row by row; what is told later lies over what was told before."""
        signs = [[self._sign(sign) for sign in row] for row in sheet.braille(xy_mm)]
        states = [["to do"] * len(row) for row in signs]
        cells = sheet.cells(xy_mm).tolist()
        left = set(map(tuple, cells[done:]))
        self._mark(signs, states, "done", [cell for cell in cells[:done] if tuple(cell) not in left])
        self._mark(signs, states, "current", cells[done : done + 1] if running else [])
        self._mark(signs, states, "head", sheet.cells(np.array([head_mm])).tolist() if head_mm else [])
        return signs, states

    def _sign(self, braille: str) -> str:
        """The sign of a cell by its dots: blank for a cell without holes to do."""
        if braille == EMPTY:
            return " "
        return SIGNS["to do"][2] if self._plain else braille

    def _mark(self, signs: list[list[str]], states: list[list[str]], state: str, cells: list[list[int]]) -> None:
        sign = SIGNS[state][2 if self._plain else 1]
        for row, column in cells:
            if 0 <= row < len(signs) and 0 <= column < len(signs[0]):
                signs[row][column], states[row][column] = sign, state


def _runs(signs: list[str], states: list[str]) -> Line:
    """One line of cells as marked text, neighbours of one state together."""
    pairs = groupby(zip(signs, states, strict=True), key=lambda pair: pair[1])
    return [(SIGNS[state][0], "".join(sign for sign, _state in run)) for state, run in pairs]
