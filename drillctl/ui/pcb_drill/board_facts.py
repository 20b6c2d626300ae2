"""A board and its options in words. Functions of JobOptions and BoardView; shown by the Files screen."""

from collections.abc import Callable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drillctl.language.number_text import clock
from drillctl.language.words import N_, _, ngettext, translated
from drillctl.ui.pcb_drill.typed import BY_OPTION
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.text_graphics import bar
from drillctl.viewmodel.console import BoardView, HolesView
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.records import ToolEstimate

LEFT_COLUMNS, LABEL_COLUMNS = 24, 18
SHARE_COLUMNS = 24  # of the bar that is a tool's share of the time


class PlacingChoice(NamedTuple):
    """A way to place or drill a board: a field of JobOptions, its label, its values with the word for each."""

    field: str
    label: str
    values: tuple[tuple[str | float | None, str], ...]


CHOICES = (
    PlacingChoice("mirror", N_("Mirror"), ((None, N_("no")), ("x", N_("in X")), ("y", N_("in Y")))),
    PlacingChoice("rotate_deg", N_("Turn"), ((0.0, "0°"), (90.0, "90°"), (180.0, "180°"), (270.0, "270°"))),
    PlacingChoice("origin", N_("Origin"), ((None, N_("lowest hole")), ("file", N_("file zero")))),
    PlacingChoice(
        "order",
        N_("Order"),
        (("file", N_("as in the file")), ("nearest", N_("nearest")), ("optimised", N_("best"))),
    ),
    PlacingChoice(
        "after_end",
        N_("Behind M30"),
        (("refuse", N_("refuse holes")), ("ignore", N_("leave out")), ("drill", N_("drill too"))),
    ),
)


def option_lines(options: JobOptions) -> list[str]:
    """The options that always have a value, two a line; then those that were set beside them."""
    pairs = [f"{_('Format')}: {format_word(options.format)}"]
    *choices, behind_end = (f"{_(choice.label)}: {_chosen(choice, options)}" for choice in CHOICES)
    pairs += [*choices, _offset(options), behind_end]  # the longest has a line of its own
    lines = [f"{left:{LEFT_COLUMNS}} {right}".rstrip() for left, right in zip_longest(*[iter(pairs)] * 2, fillvalue="")]
    return [*lines, *_further(options)]


def placing_lines(options: JobOptions, keys: Sequence[Key]) -> list[str]:
    """Every option in a line of its own, behind the key that changes it; then what was set of the others."""
    by_field = {choice.field: choice for choice in CHOICES}
    lines = []
    for key in keys:
        if key.method == "cycle" and isinstance(key.argument, str):
            label, value = _(by_field[key.argument].label), _chosen(by_field[key.argument], options)
        elif key.method in OTHER_OPTIONS:
            label, value = (_(OTHER_OPTIONS[key.method][0]), OTHER_OPTIONS[key.method][1](options))
        else:
            continue
        lines.append(f"{_(key.printed):4}{label:{LABEL_COLUMNS}}{value}")
    return [*lines, "", *_further(options)]


def _set_or_none(is_set: object) -> str:
    return _("see below") if is_set else _("none")


OTHER_OPTIONS: Mapping[str, tuple[str, Callable[[JobOptions], str]]] = {  # by the method that changes it
    "choose_format": (N_("Format"), lambda options: format_word(options.format)),
    "offset": (N_("Offset"), lambda options: "{:g} {:g} mm".format(*options.offset_mm)),
    "align": (N_("Measured holes"), lambda options: _set_or_none(options.measured)),
    "panel": (N_("Panel"), lambda options: _set_or_none(options.panel)),
    "how_to_drill": (
        N_("How to drill"),
        lambda options: _set_or_none(options.peck_mm or options.spot_mm or options.skip_tools or options.drills
                                     or options.pins or options.mill),
    ),
}


def _offset(options: JobOptions) -> str:
    return "{}: {:g} {:g} mm".format(_("Offset"), *options.offset_mm)


def _chosen(choice: PlacingChoice, options: JobOptions) -> str:
    """The word for what was chosen; a list of recent jobs may hold values that can't be chosen."""
    value = getattr(options, choice.field)
    return _(dict(choice.values).get(value, str(value)))


def format_word(option: str | None) -> str:
    """A format's option as it is typed; "recognised" for none. Its name stands in the menu."""
    return option or _("recognised")


def format_name(option: str) -> str:
    """A format by its name, with the option that it stands for."""
    name = _(BY_OPTION[option].name).replace("&", "")
    return f"{name} ({option})" if option else name


def recent_line(file: str, options: JobOptions) -> str:
    """The line of a job opened before: the file, and the options that differ from the usual ones."""
    usual = JobOptions()
    unusual_choices = [
        _chosen(choice, options) for choice in CHOICES if getattr(options, choice.field) != getattr(usual, choice.field)
    ]
    offset = [] if options.offset_mm == usual.offset_mm else [_offset(options)]
    unusual = [*filter(None, [options.format]), *unusual_choices, *offset, *_further(options)]
    return "  ".join([Path(file).name, *unusual, str(Path(file).parent)])


def _further(options: JobOptions) -> list[str]:
    lines = []
    if panel := options.panel:
        text = _("Panel: {columns} x {rows}, {x:g} by {y:g} mm")
        lines.append(text.format(columns=panel.columns, rows=panel.rows, x=panel.pitch_x_mm, y=panel.pitch_y_mm))
    if pins := options.pins:
        lines.append(_("Pins of {diameter:g} mm, {margin:g} mm outside").format(
            diameter=pins.diameter_mm, margin=pins.margin_mm))  # fmt: skip
    if options.measured:
        count = len(options.measured)
        placed = ngettext("Placed by {count} measured hole", "Placed by {count} measured holes", count)
        lines.append(placed.format(count=count))
    if options.peck_mm is not None:
        lines.append(_("In pecks of {depth:g} mm").format(depth=options.peck_mm))
    if options.spot_mm is not None:
        lines.append(_("A spot of {depth:g} mm first").format(depth=options.spot_mm))
    if options.mill:
        lines.append(_("Slots are milled"))
    if options.skip_tools:
        numbers = " ".join(f"T{number}" for number in options.skip_tools)
        lines.append(_("Without tools {numbers}").format(numbers=numbers))
    if options.drills:
        lines.append(_("Drills at hand: {file}").format(file=options.drills))
    return lines


def board_lines(board: BoardView, large: bool = False, plain: bool = False) -> list[str]:
    """A board in words: size, format and why, tools with their time, the whole time, warnings. ``large``: with a bar
    for each tool's share of the time, and the way between the holes.
    """
    width_mm, height_mm = _size_mm(board)
    size = ngettext(
        "{name}: {count} hole, {width:.2f} x {height:.2f} mm", "{name}: {count} holes, {width:.2f} x {height:.2f} mm",
        len(board.xy_mm),
    ).format(name=board.name, count=len(board.xy_mm), width=width_mm, height=height_mm)  # fmt: skip
    sure = f"{board.dialect}, {translated(board.format)} ({board.confidence:.0%}): {translated(board.reason)}"
    runner_up = [_("else: {format}").format(format=translated(board.runner_up))] if board.runner_up else []
    warnings = [_("warning: {text}").format(text=translated(text)) for text in board.warnings]
    tools, whole = _tool_lines(board), _whole_time(board)
    if large:
        tools = [f"{line:<44}{share}" for line, share in zip(tools, _shares(board, plain), strict=True)]
        whole = f"{whole}   {_('way between the holes: {mm:.0f} mm').format(mm=_way_mm(board))}"
    return [size, sure, *runner_up, *tools, whole, *warnings]


def _shares(board: BoardView, plain: bool) -> list[str]:
    """A bar for each tool: its share of the time."""
    whole = max(sum(tool.ticks for tool in board.estimate.tools), 1)
    return [bar(tool.ticks / whole, SHARE_COLUMNS, plain) for tool in board.estimate.tools]


def _way_mm(board: BoardView) -> float:
    """How far the drill goes from the first hole to the last, in the order of drilling."""
    return float(np.hypot(*np.diff(board.xy_mm, axis=0).T).sum()) if len(board.xy_mm) > 1 else 0.0


def loaded_line(board: BoardView) -> str:
    """What was loaded, in a line: holes, tools, size."""
    holes, tools = len(board.xy_mm), len(board.estimate.tools)
    width_mm, height_mm = _size_mm(board)
    return _("loaded: {name}, {holes}, {tools}, {width:.1f} x {height:.1f} mm").format(
        name=board.name, width=width_mm, height=height_mm,
        holes=ngettext("{count} hole", "{count} holes", holes).format(count=holes),
        tools=ngettext("{count} tool", "{count} tools", tools).format(count=tools),
    )  # fmt: skip


def glance_line(name: str, holes: HolesView) -> str:
    """A file that is not loaded, in a line: holes, size, and the key that loads it."""
    count, (width_mm, height_mm) = len(holes.xy_mm), _size_mm(holes)
    return ngettext(
        "{name}: {count} hole, {width:.2f} x {height:.2f} mm; Enter loads it",
        "{name}: {count} holes, {width:.2f} x {height:.2f} mm; Enter loads it",
        count,
    ).format(name=name, count=count, width=width_mm, height=height_mm)


def _size_mm(board: HolesView) -> tuple[float, float]:
    """Width and height of what is drilled."""
    width_mm, height_mm = np.ptp(board.xy_mm, axis=0).tolist() if len(board.xy_mm) else (0.0, 0.0)
    return width_mm, height_mm


def is_warning(line: str) -> bool:
    """Whether a line is one of the warnings."""
    return line.startswith(_("warning: {text}").partition("{")[0])


def _tool_lines(board: BoardView) -> list[str]:
    return [
        f"T{tool.number:<3} {_diameter(tool.diameter_mm):>9} "
        + ngettext("{count:6} hole   {time}", "{count:6} holes  {time}", tool.holes).format(
            count=tool.holes, time=clock(tool.ticks / board.estimate.tick_hz)
        )
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
