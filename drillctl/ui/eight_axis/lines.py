"""What the machine's screen tells in lines: coordinates of all axes, the work, tools, magazine, every signal by name.

Rule: functions of the machine's view and its records; what is on stands in brackets, and what is unknown is ``?``, so
that nothing is told by colour alone.
"""

import textwrap

from drillctl.language.words import _, translated
from drillctl.ui.screens.machine_lines import lamp, phase_line
from drillctl.ui.screens.window_lines import hole_text, time_text
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.texts import Line, packed
from drillctl.viewmodel.console import AxisView, BoardView, MachineView
from drillctl.viewmodel.production import PlaceRecord, Records, ToolRecord
from drillctl.viewmodel.records import Progress

BITS = {True: "o", False: ".", None: "?"}  # a bit of a place: there, not there, unknown
NOTHING = "-"
LABEL_WIDTH = 10
EXACT_MM = 1e-9


def coordinate_lines(view: MachineView, records: Records) -> list[Line]:
    """Each axis with its absolute and its relative coordinate, mm."""
    head = f"   {_('absolute'):>11}{_('relative'):>11}"
    return [[("title", head)], *(_coordinate(axis, index, records) for index, axis in enumerate(view.axes))]


def _coordinate(axis: AxisView, index: int, records: Records) -> Line:
    """X and Y count from the origins of the parameters, heads from machine zero and from the working base."""
    place_mm = axis.position_steps / axis.steps_per_mm
    origin_mm = records.absolute_mm[index] if index < len(records.absolute_mm) else 0.0
    relative_mm = axis.position_mm
    if records.relative_mm is not None and index < len(records.relative_mm):
        relative_mm = place_mm - records.relative_mm[index]
    return [("title", f"{axis.name.upper():3}"), ("accent", f"{place_mm - origin_mm:11.3f}"), f"{relative_mm:11.3f}"]


def work_lines(
    view: MachineView, records: Records, board: BoardView | None, progress: Progress | None, columns: int
) -> list[Line]:
    """Stroke, bottom dead centre, the tool in use with diameter and allowed offset, holes, time, command: as many of
    its words as there is room for, since the intervals of six heads would take three lines.
    """
    tool, diameter_mm = tool_in_use(view, records, board), _diameter(view, board)
    if diameter_mm is None and tool is not None:
        diameter_mm = tool.diameter_mm
    return [
        _labelled(_("Stroke"), _mm(records.stroke_mm)),
        _labelled(_("Bottom"), _mm(records.bottom_mm)),
        _labelled(_("Tool"), f"T{view.tool}" if view.tool else NOTHING),
        _labelled(_("Diameter"), _mm(diameter_mm)),
        _labelled(_("Offset +-"), _mm(tool.offset_mm if tool else None)),
        _labelled(_("Holes"), hole_text(view, progress)),
        _labelled(_("Time"), time_text(progress)),
        _labelled(_("Command"), textwrap.shorten(_command(view), columns - LABEL_WIDTH, placeholder=" ..")),
    ]


def _command(view: MachineView) -> str:
    """The command in execution, behind the step of the tool change that it belongs to; one that failed stands alone."""
    if not view.change_step:
        return view.command or NOTHING
    return _("change, step {number}").format(number=view.change_step) + (f": {view.command}" if view.command else "")


def _labelled(label: str, text: str) -> Line:
    return [("title", f"{label:{LABEL_WIDTH}}"), text]


def tool_in_use(view: MachineView, records: Records, board: BoardView | None) -> ToolRecord | None:
    """The machine's tool that serves the code in the drill file: that of its number, else the nearest, among those
    whose diameter differs by no more than their offset. Without a board, that of the number.
    """
    wanted_mm = _diameter(view, board)
    if wanted_mm is None:
        return next((tool for tool in records.tools if tool.number == view.tool), None)
    fitting = [(_off_mm(tool, wanted_mm), tool) for tool in records.tools if _fits(tool, wanted_mm)]
    fitting.sort(key=lambda pair: (pair[1].number != view.tool, pair[0]))
    return fitting[0][1] if fitting else None


def _fits(tool: ToolRecord, wanted_mm: float) -> bool:
    return _off_mm(tool, wanted_mm) <= (tool.offset_mm or 0.0) + EXACT_MM


def _off_mm(tool: ToolRecord, wanted_mm: float) -> float:
    return abs((tool.diameter_mm or 0.0) - wanted_mm)


def _diameter(view: MachineView, board: BoardView | None) -> float | None:
    """What the board's file says of the tool's code."""
    tools = board.tools if board is not None else ()
    return next((one.diameter_mm for one in tools if one.number == view.tool), None)


def _mm(value: float | None) -> str:
    return NOTHING if value is None else f"{value:.3f} mm"


def missing_lines(records: Records) -> list[Line]:
    """How many parameters must still be entered; nothing where none."""
    if not records.missing:
        return []
    text = _("parameters to be entered: {count}").format(count=len(records.missing))
    return [[("warning", text)], [("warning", records.missing[0])]]


def tool_lines(view: MachineView, records: Records, board: BoardView | None) -> list[Line]:
    """The tools of the machine, the one in use marked: diameter, allowed offset, holes left, place."""
    head = f"  {_('tool'):5}{'mm':>6}{'+-':>6}{_('left'):>9}{_('place'):>6}"
    used = tool_in_use(view, records, board)
    return [[("title", head)], *(_tool(tool, tool is used) for tool in records.tools)]


def _tool(tool: ToolRecord, used: bool) -> Line:
    diameter, offset = (NOTHING if mm is None else f"{mm:.3f}" for mm in (tool.diameter_mm, tool.offset_mm))
    left = NOTHING if tool.hits_left is None else str(tool.hits_left)
    place = str(tool.place) if tool.place else NOTHING
    name = f"T{tool.number}"
    return [("lit" if used else "body", f"{'>' if used else ' '} {name:5}{diameter:>6}{offset:>6}{left:>9}{place:>6}")]


def magazine_lines(records: Records, columns: int) -> list[Line]:
    """The chucks with their tools, and the places with their tools and bits (o there, . not, ? unknown)."""
    lines: list[Line] = [[("title", _("Magazine"))]]
    if records.trouble is not None:
        lines += folded([[("warning", translated(records.trouble))]], columns)
    if records.chucks:
        chucks: list[Line] = [[f" {spindle}:{_chuck(tool)}"] for spindle, tool in enumerate(records.chucks, start=1)]
        lines += [[_("chucks")], *packed(chucks, columns)]
    if any(place.bits for place in records.places):
        lines.append([("dark", _("bits: o there, . not, ? unknown"))])
    return [*lines, *packed([_place(place) for place in records.places], columns)]


def _chuck(tool: int | None) -> str:
    return "?" if tool is None else f"T{tool}" if tool else NOTHING


def _place(place: PlaceRecord) -> Line:
    bits = "".join(BITS[bit] for bit in place.bits)
    owner = NOTHING if place.tool is None else f"T{place.tool}"
    return [("title", f"{place.number:>3} "), f"{owner:4}", ("warning" if "?" in bits else "body", f"{bits}  ")]


def signal_lines(view: MachineView, columns: int) -> list[Line]:
    """Self-diagnosis: every input, output and drive of the machine by its name, in brackets while it is on; numbers of
    several bits.
    """
    inputs, outputs = (packed([[lamp(*signal)] for signal in found], columns) for found in (view.sensors, view.outputs))
    numbers = packed([[f" {name} {value} "] for name, value in view.words], columns)
    return [
        [("title", _("Inputs"))], *inputs, [("title", _("Outputs"))], *outputs, *(numbers if view.words else []),
        [("title", _("Drives"))], *map(phase_line, view.axes),
    ]  # fmt: skip
