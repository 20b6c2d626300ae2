"""A board and what was asked of it, in words. Functions of Asked and BoardView; shown by the Files screen."""

from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drillctl.language.figures import clock
from drillctl.language.sentences import told
from drillctl.language.words import N_, _
from drillctl.ui.screens.formats import BY_OPTION
from drillctl.viewmodel.console import BoardView, ToolWanted
from drillctl.viewmodel.jobs import Asked
from drillctl.viewmodel.records import ToolEstimate

LEFT_COLUMNS = 24


class Choice(NamedTuple):
    """A way to place or drill a board: a field of Asked, its label, its values with the word for each."""

    field: str
    label: str
    values: tuple[tuple[str | float | None, str], ...]


CHOICES = (
    Choice("mirror", N_("Mirror"), ((None, N_("no")), ("x", N_("in X")), ("y", N_("in Y")))),
    Choice("rotate_deg", N_("Turn"), ((0.0, "0°"), (90.0, "90°"), (180.0, "180°"), (270.0, "270°"))),
    Choice("origin", N_("Origin"), (("base", N_("lowest hole")), ("file", N_("file zero")))),
    Choice(
        "order",
        N_("Order"),
        (("file", N_("as in the file")), ("nearest", N_("nearest")), ("optimised", N_("best"))),
    ),
    Choice(
        "after_end",
        N_("Behind M30"),
        (("refuse", N_("refuse holes")), ("ignore", N_("leave out")), ("drill", N_("drill too"))),
    ),
)


def asked_lines(asked: Asked) -> list[str]:
    """What is always to be chosen, two a line; then what was asked beside it."""
    offset = "{:g} {:g} mm".format(*asked.offset_mm)
    pairs = [f"{_('Format')}: {format_word(asked.format)}"]
    pairs += [f"{_(choice.label)}: {_chosen(choice, asked)}" for choice in CHOICES] + [f"{_('Offset')}: {offset}"]
    lines = [f"{left:{LEFT_COLUMNS}} {right}".rstrip() for left, right in zip_longest(*[iter(pairs)] * 2, fillvalue="")]
    return [*lines, *_further(asked)]


def _chosen(choice: Choice, asked: Asked) -> str:
    """The word for what was chosen; a list of recent jobs may hold values that can't be chosen."""
    value = getattr(asked, choice.field)
    return _(dict(choice.values).get(value, str(value)))


def format_word(option: str | None) -> str:
    """An option as it is typed; the name that it goes by stands in the menu."""
    return option or _("recognised")


def format_name(option: str) -> str:
    """A format by its name, with the option that it stands for."""
    name = _(BY_OPTION[option].name).replace("&", "")
    return f"{name} ({option})" if option else name


def recent_line(file: str, asked: Asked) -> str:
    """A job opened before: the file, and what was asked that is not usual."""
    usual = Asked()
    told_apart = [
        _chosen(choice, asked)
        for choice in CHOICES
        if getattr(asked, choice.field) != getattr(usual, choice.field)
    ]
    unusual = [*filter(None, [asked.format]), *told_apart, *_further(asked)]
    return "  ".join([Path(file).name, *unusual, str(Path(file).parent)])


def _further(asked: Asked) -> list[str]:
    lines = []
    if panel := asked.panel:
        text = _("Panel: {columns} x {rows}, {x:g} by {y:g} mm")
        lines.append(text.format(columns=panel.columns, rows=panel.rows, x=panel.pitch_x_mm, y=panel.pitch_y_mm))
    if asked.measured:
        lines.append(_("Placed by {count} measured holes").format(count=len(asked.measured)))
    if asked.peck_mm is not None:
        lines.append(_("In pecks of {depth:g} mm").format(depth=asked.peck_mm))
    if asked.spot_mm is not None:
        lines.append(_("A spot of {depth:g} mm first").format(depth=asked.spot_mm))
    if asked.skip_tools:
        lines.append(_("Without tools {numbers}").format(numbers=" ".join(f"T{number}" for number in asked.skip_tools)))
    if asked.drills:
        lines.append(_("Drills at hand: {file}").format(file=asked.drills))
    return lines


def board_lines(board: BoardView) -> list[str]:
    """A board in words: size, format and why, tools with their time, the whole time, warnings."""
    width_mm, height_mm = np.ptp(board.xy_mm, axis=0).tolist() if len(board.xy_mm) else (0.0, 0.0)
    size = _("{name}: {holes} holes, {width:.2f} x {height:.2f} mm").format(
        name=board.name, holes=len(board.xy_mm), width=width_mm, height=height_mm
    )
    sure = f"{board.dialect}, {told(board.format)} ({board.confidence:.0%}): {told(board.reason)}"
    runner_up = [_("else: {format}").format(format=told(board.runner_up))] if board.runner_up else []
    warnings = [_("warning: {text}").format(text=told(text)) for text in board.warnings]
    return [size, sure, *runner_up, *_tool_lines(board), _whole_time(board), *warnings]


def is_warning(line: str) -> bool:
    """Whether a line is one of the warnings."""
    return line.startswith(_("warning: {text}").partition("{")[0])


def _tool_lines(board: BoardView) -> list[str]:
    return [
        f"T{tool.number:<3} {_diameter(tool.diameter_mm):>9} "
        + _("{holes:6} holes  {time}").format(holes=tool.holes, time=clock(tool.ticks / board.estimate.tick_hz))
        + _drill(tool)
        for tool in board.estimate.tools
    ]


def _drill(tool: ToolEstimate) -> str:
    return "" if tool.drill_mm is None else _("  drill {diameter:.3f} mm").format(diameter=tool.drill_mm)


def _diameter(mm: float | None) -> str:
    return "? mm" if mm is None else f"{mm:.3f} mm"


def _whole_time(board: BoardView) -> str:
    estimate = board.estimate
    about = "" if estimate.exact else _("about ")
    line = _("Estimate {about}{time}").format(about=about, time=clock(estimate.ticks / estimate.tick_hz))
    fault = estimate.fault
    return line if fault is None else f"{line}; {_('it would end in')} {fault.name}: {_(fault.cause)}"


def tool_name(tool: ToolWanted) -> str:
    """``T3, 1.000 mm``, and the drill at hand that serves it where it is of another diameter."""
    name = f"T{tool.number}"
    if tool.diameter_mm is not None:
        name += f", {tool.diameter_mm:.3f} mm"
    if tool.drill_mm is not None:
        name += _(", the drill of {diameter:.3f} mm").format(diameter=tool.drill_mm)
    return name
