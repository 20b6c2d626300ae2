"""The paper's window at the right: holes, coordinates, command, phases, ramp, sensors, ticks.

Rule: a function of the machine's view and the job's progress; what is on stands in brackets, so that nothing is told by
colour alone. Each motor's whole phase table is drawn, with its column marked. What does not fit into one window stands
on further pages, no block broken that need not be.
"""

from collections.abc import Callable, Iterable, Sequence

import urwid

from drillctl.language.figures import clock
from drillctl.language.words import _
from drillctl.ui.screens.machine_lines import lamp, phase_line, phase_table
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of
from drillctl.viewmodel.console import AxisView, BoardView, MachineView
from drillctl.viewmodel.records import Progress

LABEL_WIDTH = 9


class SideWindow(urwid.Widget):
    """Lines in a box, a page of them at a time: those that ``pages`` gives, which has the form of ``side_pages``."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self, pages: "Pages") -> None:
        super().__init__()
        self._pages = pages
        self._shown: tuple[MachineView, Progress | None, BoardView | None] | None = None
        self._page = 0

    def use(self, pages: "Pages") -> None:
        """Shows other pages from now on."""
        self._pages = pages

    def turn_page(self) -> None:
        """Shows the next page; after the last comes the first."""
        self._page += 1
        self._invalidate()

    def show(self, view: MachineView, progress: Progress | None, board: BoardView | None) -> None:
        """Takes a new view of machine, job and board; redraws only if something is new."""
        if (view, progress, board) != self._shown:
            self._shown = (view, progress, board)
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws a page, clipped to the box."""
        assert len(size) == 2
        columns, rows = size
        pages = self._pages(*self._shown, columns, rows) if self._shown else [[]]
        self._page %= len(pages)
        return boxed(pages[self._page], columns, rows)


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


def apart(blocks: Iterable[list[Line]]) -> list[list[Line]]:
    """Blocks with an empty line after each."""
    return [[*block, []] for block in blocks]


def numbered_pages(blocks: Sequence[list[Line]], columns: int, rows: int) -> list[list[Line]]:
    """Blocks on pages, each with its number where they are more than one."""
    pages = _paged(blocks, rows)
    if len(pages) == 1:
        return pages
    return [_numbered(page, f"{number}/{len(pages)} Tab", columns) for number, page in enumerate(pages, start=1)]


def _paged(blocks: Sequence[list[Line]], rows: int) -> list[list[Line]]:
    """Distributes blocks of lines to pages; a block is broken only if no page can hold it."""
    pages: list[list[Line]] = [[]]
    for block in blocks:
        if pages[-1] and len(pages[-1]) + len(block) > rows:
            pages.append([])
        for line in block:
            if len(pages[-1]) == max(rows, 1):
                pages.append([])
            pages[-1].append(line)
    return pages


def _numbered(page: list[Line], mark: str, columns: int) -> list[Line]:
    """The page with its number at the right of the first line."""
    gap = max(1, columns - len(mark) - width_of(page[0]))
    return [[*page[0], " " * gap, ("key", mark)], *page[1:]]


def _job_lines(view: MachineView, progress: Progress | None, board: BoardView | None) -> list[Line]:
    return [
        labelled(_("Hole"), hole_text(view, progress)),
        labelled(_("Tool"), tool_text(view, board)),
        labelled(_("Time"), time_text(progress)),
        labelled(_("Command"), view.command or "-"),
        labelled(_("Queue"), str(view.queued)),
    ]


def labelled(label: str, text: str) -> Line:
    """A line of a label and what stands behind it."""
    return [("title", f"{label:{LABEL_WIDTH}}"), text]


def hole_text(view: MachineView, progress: Progress | None) -> str:
    """Which hole is in work, of how many."""
    if progress is None or not progress.holes_total:
        return "-"
    current = min(progress.holes_done + 1, progress.holes_total)
    return _("{number} of {total}, {done} done").format(
        number=current, total=progress.holes_total, done=progress.holes_done
    )


def tool_text(view: MachineView, board: BoardView | None) -> str:
    """The tool in the spindle, with its diameter where the board tells it."""
    if not view.tool:
        return "-"
    diameters = {tool.number: tool.diameter_mm for tool in board.tools} if board else {}
    diameter = diameters.get(view.tool)
    return f"T{view.tool}" + (f" {diameter:.3f} mm" if diameter else "")


def time_text(progress: Progress | None) -> str:
    """How long the job has run, and how long it will still take."""
    if progress is None:
        return "-"
    left = "" if progress.seconds_left is None else _(", {left} left").format(left=clock(progress.seconds_left))
    return clock(progress.machine_seconds) + left


def _place_lines(view: MachineView) -> list[Line]:
    headings = f"{'':3}{_('now mm'):>9}{_('steps'):>7}{_('to mm'):>8}{_('steps'):>7}"
    return [[("title", headings)], *map(_place_line, view.axes)]


def _place_line(axis: AxisView) -> Line:
    return [
        ("title", f"{axis.name.upper():3}"),
        f"{axis.position_mm:9.3f}{axis.position_steps:7}{axis.target_mm:8.2f}{axis.target_steps:7}",
    ]


def lamps(label: str, signals: Iterable[tuple[str, bool]], columns: int) -> list[Line]:
    """Signals as lamps beside their label, as many a line as fit."""
    lines: list[Line] = []
    room = 0
    for name, lit in signals:
        marked = lamp(name, lit)
        if room < len(marked[1]):
            lines.append([("title", f"{'' if lines else label:{LABEL_WIDTH}}")])
            room = columns - LABEL_WIDTH
        lines[-1].append(marked)
        room -= len(marked[1])
    return lines


def tick_lines(view: MachineView) -> list[Line]:
    """The tick rate with the late ticks, and on a simulated machine the lost steps."""
    late = _("{hz} Hz, {late} late").format(hz=view.tick_hz, late=view.late)
    if view.pace:
        late = _("{hz} Hz, pace {pace}").format(hz=view.tick_hz, pace=f"{view.pace:.2f}")
    worst = f" ({view.late_worst_ms:.1f} ms)" if view.late else ""
    lines: list[Line] = [[("title", f"{_('Ticks'):{LABEL_WIDTH}}"), ("warning" if view.late else "body", late + worst)]]
    if view.plant:
        lines.append([("title", f"{_('Plant'):{LABEL_WIDTH}}"), ("warning", view.plant)])
    if view.lost_steps is not None:
        lost = " ".join(map(str, view.lost_steps))
        lines.append([("title", f"{_('Lost'):{LABEL_WIDTH}}"), ("danger" if any(view.lost_steps) else "body", lost)])
    return lines
