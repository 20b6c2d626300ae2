"""The motors side by side: phase table with its column, ramp, speed, and where the rotor of a simulated motor is.

Rule: the wires that are on stand in brackets, in the column that is out too (machine_lines.py); the forcing wires'
pulses are capital X, so that nothing is told by colour alone. Where there is no room for all tables, each motor has a
line; where there is none for all lines, the rest stands on further pages.
"""

from itertools import zip_longest
from typing import NamedTuple

from drillctl.language.words import _, ngettext
from drillctl.ui.models.speeds import Speeds
from drillctl.ui.screens.machine_lines import phase_line, phase_table
from drillctl.ui.widgets.text_graphics import bar, strip
from drillctl.ui.widgets.texts import Line, width_of
from drillctl.viewmodel.console import AxisView, MachineView

BLOCK_COLUMNS = 34  # of a motor, at least
LABEL_COLUMNS = 9
BAR_COLUMNS = 16
SHORT_COLUMNS = 10  # of a bar in the line of a motor
SPEED_COLUMNS = SHORT_COLUMNS + 8  # there, with the number
REACH_STEPS = 6  # of the scale that the rotor is shown on, to either side
MARK, PLAIN_MARK = "●", "o"


class Motors:
    """The lines of each motor; they are made anew only where something in them has changed."""

    def __init__(self, plain: bool = False):
        self._plain = plain
        self._kept: dict[str, tuple[tuple[object, ...], Block]] = {}

    def pages(self, view: MachineView, speeds: Speeds, columns: int, rows: int) -> list[list[Line]]:
        """The pages of a window of ``columns`` and ``rows``, at least one."""
        lost = view.lost_steps or (0,) * len(view.axes)
        blocks = [self._block(axis, steps, speeds) for axis, steps in zip(view.axes, lost, strict=False)]
        widest = max((width + 1 for block in blocks for width in block.widths), default=1)
        beside = max(min(columns // max(BLOCK_COLUMNS, widest), len(blocks)), 1)
        below = max(rows // max(max((len(block.lines) for block in blocks), default=1), 1), 1)
        if len(blocks) > beside * below and (table := _table(blocks, columns, rows)):
            return [table]
        bands = [_side_by_side(blocks[i : i + beside], columns // beside) for i in range(0, len(blocks), beside)]
        return [[line for band in bands[i : i + below] for line in band] for i in range(0, len(bands), below)] or [[]]

    def _block(self, axis: AxisView, lost: int, speeds: Speeds) -> "Block":
        values = [*speeds.of.get(axis.name, ())]
        most = max(values, default=0.0)
        newest = values[-BAR_COLUMNS:]
        shown = axis.wires, axis.column, axis.state, axis.top_state, axis.behind_steps, lost, most, newest
        kept = self._kept.get(axis.name)
        if kept is None or kept[0] != shown:
            lines = _lines(axis, lost, values, most, self._plain)
            rest = _rest(axis, lost, values, most, self._plain)
            kept = self._kept[axis.name] = shown, Block(lines, [*map(width_of, lines)], phase_line(axis), rest)
        return kept[1]


class Block(NamedTuple):
    """The lines of a motor, and how many columns each takes; and its line in a table of all motors, in two parts."""

    lines: list[Line]
    widths: list[int]
    phases: Line
    rest: Line


def _lines(axis: AxisView, lost: int, values: list[float], most: float, plain: bool) -> list[Line]:
    rotor = _rotor(axis, lost, plain)
    return [
        *phase_table(axis),
        [_label(_("Ramp")), _ramp(axis, BAR_COLUMNS, plain)],
        [_label(_("Speed")), *_speed(values, most, BAR_COLUMNS, plain)],
        *([[_label(_("Rotor")), *rotor]] if rotor else []),
    ]


def _rest(axis: AxisView, lost: int, values: list[float], most: float, plain: bool) -> Line:
    """Ramp, speed and rotor of a motor behind its phases."""
    speed = _speed(values, most, SHORT_COLUMNS, plain)
    space = " " * max(SPEED_COLUMNS - width_of(speed), 1)
    return [" ", _ramp(axis, SHORT_COLUMNS, plain), " ", *speed, space, *_rotor(axis, lost, plain)]


def _table(blocks: list[Block], columns: int, rows: int) -> list[Line]:
    """A line for each motor below a heading; nothing where columns or rows do not suffice."""
    width = max(width_of(block.phases) for block in blocks)
    heading = f"{'':{width}} {_('Ramp'):{SHORT_COLUMNS}} {_('Speed'):{SPEED_COLUMNS}}{_('Rotor')}"
    lines: list[Line] = [[("title", heading)]]
    lines += [[*block.phases, " " * (width - width_of(block.phases)), *block.rest] for block in blocks]
    return lines if len(lines) <= rows and max(map(width_of, lines)) <= columns else []


def _label(word: str) -> tuple[str, str]:
    return "title", f"{word:{LABEL_COLUMNS}}"


def _ramp(axis: AxisView, columns: int, plain: bool) -> tuple[str, str]:
    return "good", bar(abs(axis.state) / axis.top_state if axis.top_state else 0.0, columns, plain)


def _speed(values: list[float], most: float, columns: int, plain: bool) -> Line:
    """The last speeds as a chart, and the newest as a number."""
    return [("good", strip(values, most, columns, plain)), f" {values[-1] if values else 0.0:.0f}/s"]


def _rotor(axis: AxisView, lost: int, plain: bool) -> Line:
    """The rotor on a scale whose middle is the place where it is thought to be; nothing on a real port."""
    if axis.behind_steps is None:
        return []
    off = round(-axis.behind_steps, 2) + 0.0  # never -0.00
    at = round(min(max(off, -REACH_STEPS), REACH_STEPS)) + REACH_STEPS
    scale = ["."] * (2 * REACH_STEPS + 1)
    scale[REACH_STEPS], scale[at] = "|", PLAIN_MARK if plain else MARK
    role = "danger" if lost else "body"
    lost_text = ngettext(", {count} lost", ", {count} lost", lost).format(count=lost) if lost else ""
    return [(role, "".join(scale)), f" {off:+.2f}{lost_text}"]


def _side_by_side(blocks: list[Block], columns: int) -> list[Line]:
    blank: Line = [" " * columns]
    rows = zip_longest(*(_padded(block, columns) for block in blocks), fillvalue=blank)
    return [[part for line in row for part in line] for row in rows]


def _padded(block: Block, columns: int) -> list[Line]:
    return [[*line, " " * max(columns - width, 0)] for line, width in zip(block.lines, block.widths, strict=True)]
