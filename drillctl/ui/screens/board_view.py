"""The board on the screen: a picture to scale with rulers, that can be zoomed, panned and asked about its holes.

Rule: board_layers.py says what lies in a cell, rulers.py what stands around; this is the widget of both, and the mouse
on it: the wheel zooms around the pointer, a drag pans, a click tells of a hole.
"""

from collections import deque
from collections.abc import Sequence

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.models.board_map import BoardMap
from drillctl.ui.models.board_work import Work
from drillctl.ui.screens.board_layers import Head, Layers, PlaceMm
from drillctl.ui.screens.rulers import (
    RULER_COLUMNS,
    RULER_ROWS,
    SCALE_ROWS,
    has_rulers,
    left_ruler,
    ruler_below,
    scale_bar,
    zoom_told,
)  # fmt: skip
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of
from drillctl.viewmodel.console import HolesView

STEP = 2.0  # of a key or of the wheel
WHEEL = {4: STEP, 5: 1 / STEP}  # buttons of the mouse
NOTHING_DONE = Work()
TRAIL = 60  # places of the head that are kept


class BoardPicture(urwid.Widget):
    """A box that draws a board; ``plain`` where the terminal has no UTF-8, ``hint``: what it says without one."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, plain: bool = False, hint: Sequence[str] = (N_("No board is loaded."),)):
        super().__init__()
        self._plain, self._hint = plain, hint
        self._board: HolesView | None = None
        self._work, self._tool, self._head = Work(), 0, Head()
        self._trail: deque[PlaceMm] = deque(maxlen=TRAIL)
        self._numbers = False
        self._chosen: int | None = None
        self._map: BoardMap | None = None
        self._layers: Layers | None = None
        self._pressed: tuple[int, int] | None = None

    def show(
        self, board: HolesView | None, work: Work = NOTHING_DONE, tool: int = 0, head_mm: PlaceMm | None = None,
        real_mm: PlaceMm | None = None, moving: bool = True,
    ) -> None:  # fmt: skip
        """Draws a board as far as it is; ``tool``: the number of the one in the spindle. Only if something is new. The
        trail is that of the motion under way: at rest, not ``moving``, there is none.
        """
        if board is not self._board:
            self._map = BoardMap.of(board.xy_mm, 1, 1) if board and len(board.xy_mm) else None
            self._chosen = None
            self._trail.clear()
        if (board, work, tool) != (self._board, self._work, self._tool):
            self._board, self._work, self._tool = board, work, tool
            self._draw_anew()
        if not moving:
            self._trail.clear()
        elif head_mm and head_mm != self._head.thought_mm:
            self._trail.append(head_mm)
        head = Head(head_mm, real_mm, tuple(self._trail))
        if head != self._head:
            self._head = head
            self._invalidate()

    def zoom(self, factor: float) -> float:
        """Closer by ``factor``, further below 1; the zoom that is shown then, 1 where there is nothing to be seen."""
        return self._look_at(self._map.zoomed(factor)) if self._map else 1.0

    def whole(self) -> float:
        """Shows the whole board again."""
        return self.zoom(0.0)

    def pan(self, across: float, down: float) -> float:
        """Looks further by parts of what is seen; the zoom that is shown."""
        placed = self._map
        return self._look_at(placed.panned(across * placed.columns, down * placed.rows)) if placed else 1.0

    def turn_numbers(self) -> bool:
        """Shows the holes to do by the numbers of their tools, or as dots again; whether numbers are shown now."""
        self._numbers = not self._numbers
        self._draw_anew()
        return self._numbers

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the picture, clipped to the box."""
        assert len(size) == 2
        columns, rows = size
        return boxed(self._lines(columns, rows), columns, rows)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Zooms with the wheel, tells of a hole that is clicked, pans with a drag."""
        assert len(size) == 2
        column = col - (RULER_COLUMNS if has_rulers(*size) else 0)
        if self._map is None or self._board is None:
            return False
        if event == "mouse press" and button in WHEEL:
            self._look_at(self._map.zoomed(WHEEL[button], self._map.place_mm(column, row)))
        elif event == "mouse press" and button == 1:
            self._pressed, self._chosen = (column, row), self._map.hole_at(column, row, self._board.xy_mm)
            self._invalidate()
        elif event == "mouse drag" and self._pressed:
            from_column, from_row = self._pressed
            self._pressed = column, row
            self._look_at(self._map.panned(from_column - column, from_row - row))
        else:
            return False
        return True

    def _look_at(self, placed: BoardMap) -> float:
        self._map = placed
        self._draw_anew()
        return placed.zoom

    def _draw_anew(self) -> None:
        self._layers = None
        self._invalidate()

    def _lines(self, columns: int, rows: int) -> list[Line]:
        board = self._board
        if board is None or not len(board.xy_mm):
            return folded([[("dark", f" {_(line)}")] for line in self._hint], columns)
        ruled = has_rulers(columns, rows)
        sheet = (columns - RULER_COLUMNS, rows - RULER_ROWS - SCALE_ROWS) if ruled else (columns, rows - SCALE_ROWS)
        drawn = self._still(board, *sheet).with_head(self._head)
        assert self._map is not None
        below = [self._below(board, self._map, columns)]
        if not ruled:
            return [*drawn, *below]
        left = left_ruler(self._map, self._plain)
        sides: list[Line] = [[mark, *line] for mark, line in zip(left, drawn, strict=True)]
        return [*sides, *ruler_below(self._map, self._plain), *below]

    def _still(self, board: HolesView, columns: int, rows: int) -> Layers:
        """The layers that do not move, laid anew only where board, work, place or size has changed."""
        placed = self._map
        assert placed is not None, "show makes one for every board with holes"
        if (placed.columns, placed.rows) != (max(columns, 1), max(rows, 1)):
            placed, self._layers = placed.sized(columns, rows), None
        self._map = placed
        if self._layers is None:
            self._layers = Layers.of(board, placed, self._work, self._tool, self._plain, self._numbers)
        return self._layers

    def _below(self, board: HolesView, placed: BoardMap, columns: int) -> Line:
        """Scale bar, zoom and the hole that was clicked; without zoom, then without bar, then without the hole's place,
        where they have no room.
        """
        bar, (told, brief) = scale_bar(placed, self._plain), self._told(board)
        ways = ([*bar, *zoom_told(placed), *told], [*bar, *told], told or bar, brief or bar, bar)
        return next((line for line in ways if width_of(line) <= columns), [])

    def _told(self, board: HolesView) -> tuple[Line, Line]:
        """The hole that was clicked: its number in drilling order, its tool, its place; and without the place."""
        if self._chosen is None:
            return [], []
        tool = board.tools[int(board.tool[self._chosen])]
        x_mm, y_mm = board.xy_mm[self._chosen].tolist()
        size = f" {tool.diameter_mm:.3f} mm" if tool.diameter_mm else ""
        text = _("hole {number}, T{tool}{size}, X {x:.3f}, Y {y:.3f}")
        label = text.format(number=self._chosen + 1, tool=tool.number, size=size, x=x_mm, y=y_mm)
        brief = _("hole {number}, T{tool}").format(number=self._chosen + 1, tool=tool.number)
        return ["  ", ("accent", label)], ["  ", ("accent", brief)]
