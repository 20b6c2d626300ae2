"""The paper's window at the right: holes, coordinates, command, phases, ramp, sensors, ticks.

Rule: a function of the machine's view and the job's progress; what is on stands in brackets, so that nothing is told by
colour alone. Each motor's whole phase table is drawn, with its column marked. What does not fit into one window stands
on further pages, no block broken that need not be.
"""

from collections.abc import Callable

import urwid

from drillctl.language.words import _
from drillctl.ui.screens.machine_lines import phase_line, phase_table
from drillctl.ui.screens.window_lines import hole_text, labelled, lamps, tick_lines, time_text, tool_text
from drillctl.ui.widgets.pages import numbered_pages
from drillctl.ui.widgets.texts import Line, Size, boxed
from drillctl.viewmodel.console import AxisView, BoardView, MachineView
from drillctl.viewmodel.records import Progress


class SideWindow(urwid.Widget):
    """Lines in a box, a page of them at a time: those that ``pages`` gives, which has the form of ``side_pages``."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, pages: "Pages") -> None:
        super().__init__()
        self._pages = pages
        self._shown: tuple[MachineView, Progress | None, BoardView | None] | None = None
        self._page = 0
        self._size: tuple[int, int] = (0, 0)
        self._lines: list[Line] = []

    def use(self, pages: "Pages") -> None:
        """Shows other pages from now on."""
        self._pages = pages
        self.draw_anew()

    def turn_page(self) -> None:
        """Shows the next page; after the last comes the first."""
        self._page += 1
        self.draw_anew()

    def show(self, view: MachineView, progress: Progress | None, board: BoardView | None) -> bool:
        """Takes a view of machine, job and board; returns whether it is another one than before, and then drawn."""
        if (view, progress, board) == self._shown:
            return False
        self._shown = (view, progress, board)
        self.draw_anew()
        return True

    def draw_anew(self) -> None:
        """Draws again if a line has changed. To be called where the pages take something from elsewhere than a view."""
        lines = self._page_lines()
        if lines != self._lines:
            self._lines = lines
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws a page, clipped to the box."""
        assert len(size) == 2
        if size != self._size:
            self._size = size
            self._lines = self._page_lines()
        return boxed(self._lines, *size)

    def _page_lines(self) -> list[Line]:
        """The page in view, as it is now; nothing before the size is known."""
        pages = self._pages(*self._shown, *self._size) if self._shown and all(self._size) else [[]]
        self._page %= len(pages)
        return pages[self._page]


def side_pages(
    view: MachineView, progress: Progress | None, board: BoardView | None, columns: int, rows: int
) -> list[list[Line]]:
    """The pages of a window of ``columns`` and ``rows``, at least one; lines may be longer, pages are not."""
    job, places = _job_lines(view, progress, board), _place_lines(view)
    phases: list[Line] = [[("title", _("Phases"))], *map(phase_line, view.axes)]
    tables = [phase_table(axis) for axis in view.axes]
    sensors, outputs = lamps(_("Sensors"), view.sensors, columns), lamps(_("Outputs"), view.outputs, columns)
    whole = [*job, *places, *(line for table in tables for line in table), *tick_lines(view), *sensors, *outputs]
    if len(whole) <= rows:
        return [whole]
    return numbered_pages([job, places, tick_lines(view), phases, sensors, outputs, *tables], columns, rows)


Pages = Callable[[MachineView, Progress | None, BoardView | None, int, int], list[list[Line]]]


def _job_lines(view: MachineView, progress: Progress | None, board: BoardView | None) -> list[Line]:
    return [
        labelled(_("Hole"), hole_text(view, progress)),
        labelled(_("Tool"), tool_text(view, board)),
        labelled(_("Time"), time_text(progress)),
        labelled(_("Command"), view.command or "-"),
        labelled(_("Queue"), str(view.queued)),
    ]


def _place_lines(view: MachineView) -> list[Line]:
    headings = f"{'':3}{_('now mm'):>9}{_('steps'):>7}{_('to mm'):>8}{_('steps'):>7}"
    return [[("title", headings)], *map(_place_line, view.axes)]


def _place_line(axis: AxisView) -> Line:
    return [
        ("title", f"{axis.name.upper():3}"),
        f"{axis.position_mm:9.3f}{axis.position_steps:7}{axis.target_mm:8.2f}{axis.target_steps:7}",
    ]
