"""The motors side by side: phase table with its column, ramp, speed, and where the rotor of a simulated motor is.

Rule: the wires that are on stand in brackets, in the column that is out too (machine_lines.py); the forcing wires'
pulses are capital X, so that nothing is told by colour alone. Motors for which there is no room stand on further pages.
"""

from itertools import zip_longest

from drillctl.language.words import _, ngettext
from drillctl.ui.models.speeds import Speeds
from drillctl.ui.screens.machine_lines import phase_table
from drillctl.ui.widgets.text_graphics import bar, strip
from drillctl.ui.widgets.texts import Line, width_of
from drillctl.viewmodel.console import AxisView, MachineView

BLOCK_COLUMNS = 34  # of a motor, at least
LABEL_COLUMNS = 9
BAR_COLUMNS = 16
REACH_STEPS = 6  # of the scale that the rotor is shown on, to either side
MARK, PLAIN_MARK = "●", "o"


def motor_pages(
    view: MachineView, speeds: Speeds, columns: int, rows: int, plain: bool = False
) -> list[list[Line]]:
    """The pages of a window of ``columns`` and ``rows``, at least one."""
    lost = view.lost_steps or (0,) * len(view.axes)
    blocks = [_block(axis, steps, speeds, plain) for axis, steps in zip(view.axes, lost, strict=False)]
    widest = max((width_of(line) + 1 for block in blocks for line in block), default=1)
    beside = max(min(columns // max(BLOCK_COLUMNS, widest), len(blocks)), 1)
    below = max(rows // max(max(map(len, blocks), default=1), 1), 1)
    bands = [_side_by_side(blocks[i : i + beside], columns // beside) for i in range(0, len(blocks), beside)]
    return [[line for band in bands[i : i + below] for line in band] for i in range(0, len(bands), below)] or [[]]


def _block(axis: AxisView, lost: int, speeds: Speeds, plain: bool) -> list[Line]:
    ramp = bar(abs(axis.state) / axis.top_state if axis.top_state else 0.0, BAR_COLUMNS, plain)
    speed, values = speeds.now(axis.name), list(speeds.of.get(axis.name, ()))
    curve = strip(values, max(values, default=0.0), BAR_COLUMNS, plain)
    return [
        *phase_table(axis),
        [("title", f"{_('Ramp'):{LABEL_COLUMNS}}"), ("good", ramp)],
        [("title", f"{_('Speed'):{LABEL_COLUMNS}}"), ("good", curve), f" {speed:.0f}/s"],
        *_rotor(axis, lost, plain),
    ]


def _rotor(axis: AxisView, lost: int, plain: bool) -> list[Line]:
    """The rotor on a scale whose middle is the place where it is thought to be; none on a real port."""
    if axis.behind_steps is None:
        return []
    off = round(-axis.behind_steps, 2) + 0.0  # never -0.00
    at = round(min(max(off, -REACH_STEPS), REACH_STEPS)) + REACH_STEPS
    scale = ["."] * (2 * REACH_STEPS + 1)
    scale[REACH_STEPS], scale[at] = "|", PLAIN_MARK if plain else MARK
    role = "danger" if lost else "body"
    lost_text = ngettext(", {count} lost", ", {count} lost", lost).format(count=lost) if lost else ""
    return [[("title", f"{_('Rotor'):{LABEL_COLUMNS}}"), (role, "".join(scale)), f" {off:+.2f}{lost_text}"]]


def _side_by_side(blocks: list[list[Line]], columns: int) -> list[Line]:
    rows = zip_longest(*blocks, fillvalue=[])
    return [[part for line in row for part in _padded(line, columns)] for row in rows]


def _padded(line: Line, columns: int) -> Line:
    return [*line, " " * max(columns - width_of(line), 0)]
