"""Lines of a machine's window: hole, tool, time, lamps, ticks. Every family of machines that drills boards has them.

Rule: functions of the machine's view and the job's progress.
"""

from collections.abc import Iterable

from drillctl.language.number_text import clock
from drillctl.language.words import _
from drillctl.ui.screens.machine_lines import lamp
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import BoardView, MachineView
from drillctl.viewmodel.records import Progress

LABEL_WIDTH = 9


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
