"""The windows of the Panel: display, keys and counters at the left; program and wall beside them, where there is room.

Rule: draws what ``show`` was given last and hears no keys; a click on a key goes to ``pressed``.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import urwid

from drillctl.language.words import _
from drillctl.ui.boiler_drum import keypad, segments
from drillctl.ui.boiler_drum.program_list import facts, heading, list_lines
from drillctl.ui.boiler_drum.wall import depth_text, wall_lines
from drillctl.ui.screens.machine_lines import lamp, phase_line
from drillctl.ui.widgets import borders
from drillctl.ui.widgets.drawn import Drawn
from drillctl.ui.widgets.sizes import Layout
from drillctl.ui.widgets.texts import Line, packed
from drillctl.ui.widgets.windows import Window
from drillctl.viewmodel.console import AxisView, MachineView
from drillctl.viewmodel.records import Progress
from drillctl.viewmodel.workpieces import PartView

DISPLAY_ROWS, COUNTER_ROWS, WALL_ROWS, FACTS_ROWS = 4, 4, 5, 7
LEAST_BESIDE = 30  # columns: a part program in fewer says nothing


class Shown(NamedTuple):
    """What is drawn: the machine, how far its job is, the program with its sentence in work (0: none) and how many are
    done, and the six figures of the display.
    """

    view: MachineView
    progress: Progress | None
    part: PartView | None
    sentence: int
    done: int
    figures: str


class PanelWindows(urwid.WidgetWrap[urwid.Widget]):
    """All windows; ``pressed`` is called with a key that is clicked."""

    _now: Shown

    def __init__(self, pressed: Callable[[keypad.PanelKey], object], plain: bool):
        self._plain = plain
        drawn = (self._display, self._counters, self._program, self._wall, self._facts)
        self._drawn = display, counters, program, wall, facts = [Drawn(lines) for lines in drawn]
        self._keypad = keypad.Keypad(pressed)
        keys = self._keys = urwid.Pile([("given", DISPLAY_ROWS, display), self._keypad, counters])
        part = urwid.Pile([program, ("given", FACTS_ROWS, facts)])
        self._panel, self._part = Window(keys, _("Keys")), Window(part, _("Part program"))
        self._drum = Window(wall, _("Drum wall"))
        self._beside = urwid.Pile([self._part, ("given", WALL_ROWS, self._drum)])
        self._rule = urwid.AttrMap(urwid.SolidFill(borders.lines().down), "border")
        self._columns = urwid.Columns([self._panel, self._beside])
        super().__init__(self._columns)

    def show(self, now: Shown) -> None:
        """Takes what is to be drawn; redraws only if something is new."""
        self._now = now
        work = now.part, now.sentence, now.done
        display, counters, program, wall, facts = self._drawn
        display.depend(now.figures)
        counters.depend(now.view.axes, now.view.sensors, now.part)
        program.depend(*work)
        wall.depend(*work, now.view.axes)
        facts.depend(*work, now.progress)

    def lay_out(self, room: Layout, columns: int, rows: int) -> None:
        """Shows the windows that there is room for on a screen of this size; the keys stand closer on few rows."""
        edges = 2 * room.framed
        apart = rows - edges >= DISPLAY_ROWS + keypad.ROWS_APART + COUNTER_ROWS
        keys = self._keys.options("given", keypad.ROWS_APART if apart else keypad.LEAST_ROWS)
        self._keys.contents[1] = (self._keypad, keys)
        for window in (self._panel, self._part, self._drum):
            window.show(room.framed)
        whole, given = self._columns.options(), self._columns.options
        beside = columns >= keypad.COLUMNS + edges + LEAST_BESIDE
        left: Any = (self._panel, given("given", keypad.COLUMNS + edges) if beside else whole)
        rule = [] if room.framed else [(self._rule, given("given", 1))]
        self._columns.contents = [left, *rule, (self._beside, whole)] if beside else [left]
        wall = self._beside.options("given", WALL_ROWS + edges)
        self._beside.contents = [(self._part, self._beside.options()), (self._drum, wall)]

    def _display(self, _columns: int, _rows: int) -> list[Line]:
        return [[("accent", row)] for row in segments.figures(self._now.figures)]

    def _counters(self, columns: int, _rows: int) -> list[Line]:
        """The two counters of each motor: the accumulator, and the steps left of the sentence. Below them, where there
        is room, the phases and the inputs.
        """
        view = self._now.view
        head = f"  {_('accumulator'):>12}{_('steps left'):>13}{_('mm'):>10}"
        inputs = packed([[lamp(name, on)] for name, on in view.sensors], columns)
        phases = [[], *map(phase_line, view.axes), [], *inputs]
        return [[("title", head)], *map(_counter, view.axes), [depth_text(self._now.part, view)], *phases]

    def _program(self, columns: int, rows: int) -> list[Line]:
        now = self._now
        return [heading(now.part), *list_lines(now.part, now.sentence, now.done, columns, rows - 1)]

    def _wall(self, columns: int, _rows: int) -> list[Line]:
        now = self._now
        return wall_lines(now.part, now.view, now.sentence, now.done, columns, self._plain)

    def _facts(self, columns: int, _rows: int) -> list[Line]:
        now = self._now
        return facts(now.part, now.progress, now.sentence, now.done, columns)


def _counter(axis: AxisView) -> Line:
    left = axis.target_steps - axis.position_steps
    return [
        ("title", f"{axis.name.upper():2}"),
        ("accent", f"{axis.position_steps:+12d}{left:+13d}"),
        f"{axis.position_mm:+10.2f}",
    ]
