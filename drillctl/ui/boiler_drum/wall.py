"""The wall of the drum, unrolled: the row of holes along it, where the tool is, and how deep.

Rule: functions of the part program and the machine; a hole that is drilled has another sign, not another colour alone.
The drum is turned by hand, so one row of holes is all that a program knows.
"""

from drillctl.language.words import _
from drillctl.ui.widgets.borders import lines as border_lines
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.console import MachineView
from drillctl.viewmodel.workpieces import PartView

SIGNS = {"to do": ("○", "o"), "at work": ("◎", "@"), "done": ("●", "#")}
ROLES = {"to do": "title", "at work": "warning", "done": "good"}
ORDER = ("done", "to do", "at work")  # of holes that share a column, the last of these is shown
TOOL, PLAIN_TOOL = "▼", "v"
LEAST_ROWS = 5


def wall_lines(
    part: PartView | None, view: MachineView, sentence: int, done: int, columns: int, plain: bool = False
) -> list[Line]:
    """Five lines: the tool over the wall, the wall with its holes, and a scale in mm; none without a program."""
    if part is None or len(view.axes) < 2 or columns < 2:
        return []
    tool_mm = view.axes[0].position_mm
    ends = [0.0, *(hole.x_mm for hole in part.holes), *(each.x_mm for each in part.sentences)]
    low, high = min(ends), max(ends)
    edge = border_lines().across * columns
    return [
        _tool(_column(tool_mm, low, high, columns), columns, plain, low <= tool_mm <= high),
        [("border", edge)],
        _holes(part, sentence, done, low, high, columns, plain),
        [("border", edge)],
        _scale(low, high, columns),
    ]


def depth_text(part: PartView | None, view: MachineView) -> str:
    """How far the tool is from the wall, or how deep in it; empty where that is not known."""
    if part is None or part.surface_mm is None or len(view.axes) < 2:
        return ""
    depth = view.axes[1].position_mm - part.surface_mm
    if depth > 0:
        return _("{mm:.2f} mm in the wall").format(mm=depth)
    return _("{mm:.2f} mm before the wall").format(mm=-depth)


def _tool(at: int, columns: int, plain: bool, inside: bool) -> Line:
    """The tool at its column; at an end, where it is beyond the program's way, it is shown faint."""
    return [" " * at, ("accent" if inside else "dark", PLAIN_TOOL if plain else TOOL), " " * (columns - at - 1)]


def _holes(
    part: PartView, sentence: int, done: int, low: float, high: float, columns: int, plain: bool
) -> Line:  # fmt: skip
    states: list[str] = [""] * columns
    at_work = next((hole for hole in part.holes if hole.sentence > done), None) if sentence else None
    for hole in part.holes:
        state = "done" if hole.sentence <= done else "at work" if hole is at_work else "to do"
        at = _column(hole.x_mm, low, high, columns)
        states[at] = max(states[at], state, key=lambda one: ORDER.index(one) if one else -1)
    return [(ROLES[state], SIGNS[state][plain]) if state else " " for state in states]


def _column(mm: float, low: float, high: float, columns: int) -> int:
    if high <= low:
        return 0
    return min(max(round((mm - low) / (high - low) * (columns - 1)), 0), columns - 1)


def _scale(low: float, high: float, columns: int) -> Line:
    left, right = f"{low:.1f}", f"{high:.1f} mm"
    return [("dark", f"{left}{right:>{max(columns - len(left), 0)}}")]
