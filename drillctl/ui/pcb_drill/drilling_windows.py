"""The windows of the Drilling screen: board, machine, motors, tools and events, laid out by the size of the terminal.

Rule: draws the newest view and hears no keys; what a size shows is a row of widgets/sizes.py.
"""

from functools import partial
from typing import Any

import urwid
from msgspec.structs import replace

from drillctl.language.words import N_, _
from drillctl.ui.models.board_work import BoardWork
from drillctl.ui.models.speeds import Speeds
from drillctl.ui.pcb_drill.machine_window import machine_pages
from drillctl.ui.pcb_drill.motor_strip import Motors
from drillctl.ui.pcb_drill.side_window import SideWindow, side_pages
from drillctl.ui.pcb_drill.tool_list import tool_lines
from drillctl.ui.screens.board_layers import head_places
from drillctl.ui.screens.board_view import BoardPicture
from drillctl.ui.screens.event_list import EventList
from drillctl.ui.widgets import borders
from drillctl.ui.widgets.sizes import Layout
from drillctl.ui.widgets.texts import Line
from drillctl.ui.widgets.windows import Window
from drillctl.viewmodel.console import BoardView, MachineView
from drillctl.viewmodel.records import Progress

FIRST_WORDS = (
    N_("No board is loaded."),
    "",
    N_("F opens a drill file."),
    N_("E shows example boards and lab sheets."),
    N_("L in Files offers the boards opened last."),
    N_("F1 or ? explains this screen."),
    "",
    N_("From here to a drilled board:"),
    N_("1. E and a number: an example is loaded."),
    N_("2. S, then Y: it finds zero and drills."),
    N_("3. C: the drill that it asks for is in."),
    "",
    N_("From there to steps that are lost:"),
    N_("4. Tests > Phase tables: Enter, change."),
    N_("5. The key Try counts the lost steps."),
)
Paged = list[list[Line]]
LEAST_BOARD = 24  # a board of fewer columns says nothing: then the window stands alone


class DrillingWindows(urwid.WidgetWrap[urwid.Widget]):
    """All windows, of which ``lay_out`` chooses; ``picture`` is that of the board."""

    def __init__(self, plain: bool):
        self._plain = plain
        self.picture = BoardPicture(plain, FIRST_WORDS)
        self._machine = SideWindow(side_pages)
        self._motors, self._tools = SideWindow(self._motor_pages), SideWindow(self._tool_pages)
        self._events, self._work, self._speeds = EventList(), BoardWork(), Speeds()
        self._motor_lines = Motors(plain)
        self._parts = {
            "board": Window(self.picture, _("Board")),
            "machine": Window(self._machine, _("Machine")),
            "motors": Window(self._motors, _("Motors")),
            "tools": Window(self._tools, _("Tools")),
            "events": Window(self._events, _("Events")),
        }
        self._rule = urwid.AttrMap(urwid.SolidFill(borders.lines().down), "border")
        self._left = urwid.Pile([self._parts["board"]])
        self._right = urwid.Pile([self._parts["machine"]])
        self._columns = urwid.Columns([self._left, self._right])
        self._laid_out: tuple[Layout, int] | None = None
        super().__init__(self._columns)

    def show(self, view: MachineView, board: BoardView | None, progress: Progress | None) -> None:
        """Draws what changed in machine, board and job."""
        timeless = replace(view, tick=0)  # the windows show no tick, and must not be drawn anew for one
        self._machine.show(timeless, progress, board)
        work = self._work.see(view, board, progress)
        faster = self._speeds.see(view)
        if not self._motors.show(timeless, progress, board) and faster:
            self._motors.draw_anew()
        self._tools.show(timeless, progress, board)
        self._events.see(view)
        head, real = head_places(view)
        self.picture.show(board, work, view.tool, head, real, view.moving)

    def turn_page(self) -> None:
        """Shows the next page of the machine's and the motors' windows."""
        self._machine.turn_page()
        self._motors.turn_page()

    def lay_out(self, room: Layout, columns: int) -> None:
        """Shows the windows that there is room for on a screen of so many columns; the same again draws nothing."""
        if self._laid_out == (room, columns):
            return
        self._laid_out = room, columns
        beside = columns >= room.side + LEAST_BOARD
        for part in self._parts.values():
            part.show(room.framed)
        self._machine.use(partial(machine_pages, plain=self._plain) if room.machine else side_pages)
        whole, given = self._columns.options(), self._columns.options
        side = given("given", room.side) if beside else whole
        rule = [] if room.framed else [(self._rule, given("given", 1))]
        left: list[Any] = [(self._left, whole), *rule] if beside else []
        self._columns.contents = [*left, (self._right, side)]
        self._left.contents = self._piled(("board", 0), *([("motors", room.motors)] if room.motors else []))
        lists = [("tools", 0), ("events", 0)] if room.machine else []
        self._right.contents = self._piled(("machine", room.machine), *lists)

    def _piled(self, *parts: tuple[str, int]) -> list[Any]:
        """Windows for a pile, by name and rows; 0 rows: as many as are left."""
        options = self._left.options
        return [(self._parts[name], options("given", rows) if rows else options()) for name, rows in parts]

    def _motor_pages(self, view: MachineView, _progress: object, _board: object, columns: int, rows: int) -> Paged:
        return self._motor_lines.pages(view, self._speeds, columns, rows)

    def _tool_pages(
        self, view: MachineView, _progress: object, board: BoardView | None, columns: int, _rows: int
    ) -> Paged:
        return [tool_lines(view, board, self._work.work.done, columns, self._plain)]
