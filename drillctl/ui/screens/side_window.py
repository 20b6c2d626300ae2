"""The paper's window at the right: holes, coordinates, command, phases, ramp, sensors, ticks.

Rule: a function of the machine's view and the job's progress; what is on stands in brackets, so that nothing is told
by colour alone. Where there is room, each motor's whole phase table is drawn, with its column marked. Used by drilling.
"""

from collections.abc import Iterable

import urwid

from drillctl.panel.console import AxisView, BoardView, MachineView
from drillctl.panel.records import Progress
from drillctl.ui.lines import Line, Size, boxed
from drillctl.ui.progress import clock
from drillctl.ui.words import _

LABEL_WIDTH = 9


class SideWindow(urwid.Widget):
    """A box of these lines."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self) -> None:
        self._shown: tuple[MachineView, Progress | None, BoardView | None] | None = None

    def show(self, view: MachineView, progress: Progress | None, board: BoardView | None) -> None:
        """Redrawn only if something is new."""
        if (view, progress, board) != self._shown:
            self._shown = (view, progress, board)
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """The lines, clipped to the box."""
        assert len(size) == 2
        columns, rows = size
        lines = side_lines(*self._shown, columns, rows) if self._shown else []
        return boxed(lines, columns, rows)


def side_lines(
    view: MachineView, progress: Progress | None, board: BoardView | None, columns: int, rows: int
) -> list[Line]:
    """At most ``rows`` lines for a window of ``columns``; where they are too few, phases give way first."""
    head = [*_job_lines(view, progress, board), _headings(), *map(_place_line, view.axes)]
    sensors, outputs = _marked(_("Sensors"), view.sensors, columns), _marked(_("Outputs"), view.outputs, columns)
    tail = [*_tick_lines(view), *sensors, *outputs]
    tables = [line for axis in view.axes for line in _phase_table(axis)]
    if len(head) + len(tables) + len(tail) > rows:
        tables = [[("title", _("Phases"))], *map(_phase_line, view.axes)]
    return [*head, *tables[: max(0, rows - len(head) - len(tail))], *tail][:rows]


def _job_lines(view: MachineView, progress: Progress | None, board: BoardView | None) -> list[Line]:
    return [
        _labelled(_("Hole"), _hole(view, progress)),
        _labelled(_("Tool"), _tool(view, board)),
        _labelled(_("Time"), _time(progress)),
        _labelled(_("Command"), view.command or "-"),
        _labelled(_("Queue"), str(view.queued)),
    ]


def _labelled(label: str, text: str) -> Line:
    return [("title", f"{label:{LABEL_WIDTH}}"), text]


def _hole(view: MachineView, progress: Progress | None) -> str:
    if progress is None or not progress.holes_total:
        return "-"
    current = min(progress.holes_done + 1, progress.holes_total)
    return _("{number} of {total}, {done} done").format(
        number=current, total=progress.holes_total, done=progress.holes_done
    )


def _tool(view: MachineView, board: BoardView | None) -> str:
    if not view.tool:
        return "-"
    diameters = {tool.number: tool.diameter_mm for tool in board.tools} if board else {}
    diameter = diameters.get(view.tool)
    return f"T{view.tool}" + (f" {diameter:.3f} mm" if diameter else "")


def _time(progress: Progress | None) -> str:
    if progress is None:
        return "-"
    left = "" if progress.seconds_left is None else _(", {left} left").format(left=clock(progress.seconds_left))
    return clock(progress.machine_seconds) + left


def _headings() -> Line:
    return [("title", f"{'':3}{_('now mm'):>9}{_('steps'):>7}{_('to mm'):>8}{_('steps'):>7}")]


def _place_line(axis: AxisView) -> Line:
    return [
        ("title", f"{axis.name.upper():3}"),
        f"{axis.position_mm:9.3f}{axis.position_steps:7}{axis.target_mm:8.2f}{axis.target_steps:7}",
    ]


def _phase_line(axis: AxisView) -> Line:
    """One line a motor: column, ramp state, and its wires."""
    wires = [_lamp(name, lit) for name, _row, lit in axis.wires]
    return [("title", f"{axis.name.upper():3}"), f"{axis.column:2} {axis.state:+d} ", *wires]


def _phase_table(axis: AxisView) -> list[Line]:
    """The table as printed, a wire a line, the column that is put out in brackets."""
    top = _("column {column}, ramp {state} of {top}").format(
        column=axis.column, state=f"{axis.state:+d}", top=axis.top_state
    )
    return [[("title", f"{axis.name.upper():3}"), top], *(_wire_line(axis.column - 1, *wire) for wire in axis.wires)]


def _wire_line(column: int, name: str, row: str, lit: bool) -> Line:
    before, cell, after = row[:column], row[column : column + 1], row[column + 1 :]
    name_cell = f"[{name}]" if lit else f" {name} "
    return [("lit" if lit else "dark", f"   {name_cell:8}"), ("dark", before), ("lit", f"[{cell}]"), ("dark", after)]


def _lamp(name: str, lit: bool) -> tuple[str, str]:
    return ("lit", f"[{name}]") if lit else ("dark", f" {name} ")


def _marked(label: str, signals: Iterable[tuple[str, bool]], columns: int) -> list[Line]:
    """Lamps under each other's label, as many a line as fit."""
    lines: list[Line] = []
    room = 0
    for name, lit in signals:
        lamp = _lamp(name, lit)
        if room < len(lamp[1]):
            lines.append([("title", f"{'' if lines else label:{LABEL_WIDTH}}")])
            room = columns - LABEL_WIDTH
        lines[-1].append(lamp)
        room -= len(lamp[1])
    return lines


def _tick_lines(view: MachineView) -> list[Line]:
    late = _("{hz} Hz, {late} late").format(hz=view.tick_hz, late=view.late)
    worst = f" ({view.late_worst_ms:.1f} ms)" if view.late else ""
    lines: list[Line] = [[("title", f"{_('Ticks'):{LABEL_WIDTH}}"), ("warning" if view.late else "body", late + worst)]]
    if view.lost_steps is not None:
        lost = " ".join(map(str, view.lost_steps))
        lines.append([("title", f"{_('Lost'):{LABEL_WIDTH}}"), ("danger" if any(view.lost_steps) else "body", lost)])
    return lines
