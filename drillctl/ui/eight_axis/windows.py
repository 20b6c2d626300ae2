"""The windows of the machine's screen: the board in the middle, coordinates and work at the left, records at the right.

Rule: draws what ``show`` was given last and hears no keys. Where there are too few columns for a window at the right,
what it has stands on further pages of the left one.
"""

from typing import Any

import urwid
from msgspec.structs import replace

from drillctl.language.words import N_, _
from drillctl.ui.eight_axis.lines import (
    coordinate_lines,
    magazine_lines,
    missing_lines,
    signal_lines,
    tool_lines,
    work_lines,
)  # fmt: skip
from drillctl.ui.models.board_work import BoardWork
from drillctl.ui.screens.board_layers import head_places
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.screens.window_lines import tick_lines
from drillctl.ui.widgets import borders
from drillctl.ui.widgets.drawn import Drawn
from drillctl.ui.widgets.pages import numbered_pages
from drillctl.ui.widgets.sizes import Layout
from drillctl.ui.widgets.texts import Line
from drillctl.ui.widgets.windows import Window
from drillctl.viewmodel.console import BoardView, MachineView
from drillctl.viewmodel.production import Records
from drillctl.viewmodel.records import Progress

SIDE_COLUMNS, LEAST_BOARD = 36, 24
FIRST_WORDS = (
    N_("No board is loaded."),
    "",
    N_("4 opens a drill file."),
    N_("E shows example boards and lab sheets."),
    N_("F1 or ? explains this screen."),
)


class MachineWindows(urwid.WidgetWrap[urwid.Widget]):
    """A BoardWindows (screens/board_controls.py) of a machine with records; ``picture`` is that of the board."""

    def __init__(self, plain: bool):
        self.picture = BoardPicture(plain, FIRST_WORDS)
        self._work = BoardWork()
        self._now: tuple[MachineView, Records | None, BoardView | None, Progress | None] | None = None
        self._page = 0
        self._wide = self._large = False
        drawn = (self._own, self._beside, self._all_signals)
        self._left, self._right, self._signals = (Drawn(lines) for lines in drawn)
        self._parts = {
            "left": Window(self._left, _("Machine")),
            "board": Window(self.picture, _("Board")),
            "right": Window(self._right, _("Tools and magazine")),
            "signals": Window(self._signals, _("Self-diagnosis")),
        }
        self._rule = urwid.AttrMap(urwid.SolidFill(borders.lines().down), "border")
        self._beside_board = urwid.Pile([self._parts["right"]])
        self._columns = urwid.Columns([self._parts["left"], self._parts["board"]])
        super().__init__(self._columns)

    def use(self, records: Records | None) -> None:
        """Takes what is known of the machine beside its state; drawn with the next ``show``."""
        self._records = records

    _records: Records | None = None

    def show(self, view: MachineView, board: BoardView | None, progress: Progress | None) -> None:
        """Draws what changed in machine, records, board and job."""
        self._now = replace(view, tick=0), self._records, board, progress  # no tick is shown
        for drawn in (self._left, self._right, self._signals):
            drawn.depend(*self._now, self._page)
        head, real = head_places(view)
        self.picture.show(board, self._work.see(view, board, progress), view.tool, head, real, view.moving)

    def turn_page(self) -> None:
        """Shows the next page of the windows that have several."""
        self._page += 1
        if self._now is not None:
            for drawn in (self._left, self._right, self._signals):
                drawn.depend(*self._now, self._page)

    def lay_out(self, room: Layout, columns: int) -> None:
        """Shows the windows that there is room for on a screen of so many columns."""
        self._wide = columns >= 2 * SIDE_COLUMNS + LEAST_BOARD
        self._large = bool(room.machine)
        for part in self._parts.values():
            part.show(room.framed)
        whole, given = self._columns.options(), self._columns.options("given", SIDE_COLUMNS)
        rule: list[Any] = [] if room.framed else [(self._rule, self._columns.options("given", 1))]
        left, board = (self._parts["left"], given), (self._parts["board"], whole)
        names = ["right", "signals"] if self._large else ["right"]
        self._beside_board.contents = [(self._parts[name], self._beside_board.options()) for name in names]
        right: list[Any] = [*rule, (self._beside_board, given)] if self._wide else []
        beside = [*rule, board] if columns >= SIDE_COLUMNS + LEAST_BOARD else []
        self._columns.contents = [left, *beside, *right]

    def _own(self, columns: int, rows: int) -> list[Line]:
        """The page of the left window."""
        if self._now is None or self._now[1] is None:
            return []
        view, records, board, progress = self._now
        assert records is not None
        work = [*coordinate_lines(view, records), *work_lines(view, records, board, progress, columns)]
        own = [work, [*missing_lines(records), *tick_lines(view)]]
        return self._paged(own if self._wide else [*own, *self._records_of(columns)], columns, rows)

    def _beside(self, columns: int, rows: int) -> list[Line]:
        """The page of the window at the right."""
        return self._paged(self._records_of(columns), columns, rows)

    def _all_signals(self, columns: int, rows: int) -> list[Line]:
        return self._paged([signal_lines(self._now[0], columns)] if self._now else [], columns, rows)

    def _records_of(self, columns: int) -> list[list[Line]]:
        if self._now is None or self._now[1] is None:
            return []
        view, records, board = self._now[:3]
        assert records is not None
        found = [tool_lines(view, records, board), magazine_lines(records, columns)]
        return found if self._wide and self._large else [*found, signal_lines(view, columns)]

    def _paged(self, blocks: list[list[Line]], columns: int, rows: int) -> list[Line]:
        spaced = [[*block, []] for block in blocks]
        if sum(map(len, spaced)) - 1 <= rows:
            return [line for block in spaced for line in block]
        pages = numbered_pages(blocks, columns, rows)
        return pages[self._page % len(pages)]
