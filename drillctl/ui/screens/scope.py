"""The scope (Tests): a run as a logic analyser shows it, wires, columns, positions and commands over the ticks.

Rule: it only looks: the run at hand while it goes on, or a trace file. The cursor may stand on any tick of it, and the
machine is shown as it was then.
"""

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.viewport import SignalRows, Viewport
from drillctl.ui.screens.own_steps import SCOPE_STEPS
from drillctl.ui.screens.scope_curve import height_of
from drillctl.ui.screens.scope_keys import CLOSER, FURTHER, SCOPE_KEYS
from drillctl.ui.screens.scope_measure import POSITION
from drillctl.ui.screens.scope_search import Searching
from drillctl.ui.screens.scope_view import ScopeLayout, ScopeLook, scope_lines
from drillctl.ui.screens.shell import Shell, choose_another
from drillctl.ui.widgets.keys import called
from drillctl.ui.widgets.texts import Size, boxed
from drillctl.viewmodel.console import Console, MachineView, Problems, Watch
from drillctl.viewmodel.scope import RunOpening, ScopeSource

ROOM_FOR_CURVES = 46  # rows of a window in which positions are curves from the beginning
WHEEL = {4: CLOSER, 5: FURTHER}  # buttons of the mouse


class Scope(Searching, urwid.Widget):
    """Waves under a cursor. ``source``: what is looked at first; None: the run of the machine at hand."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _selectable = True
    title = N_("Scope")
    own_steps = SCOPE_STEPS
    keys = SCOPE_KEYS
    _following: bool
    _curves_drawn: bool
    _seen: object = None  # of the run, when it was last drawn

    def __init__(
        self, _console: Console, shell: Shell, runs: RunOpening, plain: bool = False, source: ScopeSource | None = None
    ):
        self._shell, self._runs, self._plain = shell, runs, plain
        self._file = ""
        self._live = source is None
        self._look_at(source or runs.running())

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the run as it is now."""
        assert len(size) == 2
        columns, rows = size
        self._draw_curves_first(rows)
        self._view = self._view.sized(ScopeLayout.of(self._source.signals(), columns).waves)
        lines, self._top, self._room = scope_lines(self._source, self._look(), columns, rows)
        return boxed(lines, columns, rows)

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; returns any other key for the frame."""
        return None if called(self, self.keys, key) else key

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Sets cursor and bar on a click; zooms around the pointer with the wheel."""
        assert len(size) == 2
        layout = ScopeLayout.of(self._source.signals(), size[0])
        if event != "mouse press" or not 0 <= col - layout.names < layout.waves:
            return False
        self._go(self._view.tick_at(col - layout.names))
        if button in WHEEL:
            self.zoom(WHEEL[button])
        else:
            self._rows = self._rows.put(row - self._top, self._room)
        return True

    def refresh(self, view: MachineView) -> None:
        """Redraws where something is new; takes up the new run of a machine that was chosen anew."""
        if self._live and self._runs.running() is not self._source:
            self.show_machine()
        source = self._source
        source.turn()
        state = (source.first_tick, source.last_tick, source.notices())
        if state == self._seen:
            return
        self._seen = state
        self._view = self._view.of_run(source.first_tick, source.last_tick)
        if self._following:
            self._view = self._view.go(source.last_tick)
        self._invalidate()

    def show_machine(self) -> None:
        """Shows the machine's own run and follows it."""
        self._live = True
        self._look_at(self._runs.running())

    def choose_run(self) -> None:
        """Offers the machine's own run, and a trace file."""
        ways, lines = (self.show_machine, self.open), (_("the machine's own run"), _("a trace file"))
        choose_another(self._shell, _("Runs"), lines, 0 if self._live else None, lambda index: ways[index]())

    def open(self) -> None:
        """Asks for a trace file, then shows its run."""
        self._shell.ask_text(_("Open a trace"), _("File:"), self._file, self._open)

    def step(self, columns: int) -> None:
        """Moves the cursor by so many columns; the scope no longer follows the run."""
        self._moved(self._view.step(columns))

    def pan(self, by: int) -> None:
        """Moves cursor and view by half a screen."""
        self._moved(self._view.pan(by))

    def zoom(self, by: int) -> None:
        """Zooms around the cursor, which keeps its column; closer for negative ``by``."""
        self._view = self._view.zoomed(by)
        self._invalidate()

    def whole(self) -> None:
        """Shows the whole run, from the first tick to the last."""
        self._view = self._view.whole()
        self._invalidate()

    def start(self) -> None:
        """Moves the cursor to the first tick that is kept."""
        self._go(self._source.first_tick)

    def end(self) -> None:
        """Moves the cursor to the last tick."""
        self._go(self._source.last_tick)

    def follow(self) -> None:
        """Follows the run as it goes on, or stops following; a recorded run has ended, so only its end is shown."""
        following = self._live and not self._following
        self.end()
        self._following = following

    def go_to(self) -> None:
        """Asks for a tick, then moves the cursor to it."""
        self._shell.ask_text(_("Go to a tick"), _("Tick:"), str(self._view.cursor), self._go_to_typed)

    def mark(self, name: str) -> None:
        """Puts the mark A or B at the cursor; takes it away if it is there already."""
        cursor = self._view.cursor
        if self._marks.get(name) == cursor:
            del self._marks[name]
        else:
            self._marks[name] = cursor
        self._say("")

    def curve(self) -> None:
        """Draws the numbers under the bar as a curve, a position with its speed; or as numbers again."""
        at, heights = self._rows.at, dict(self._rows.heights)
        height = height_of(self._source.signals()[at])
        if height == 1:
            self._say(_("a curve is drawn of numbers only: positions, states, currents"))
            return
        if heights.pop(at, None) is None:
            heights[at] = height
        self._with_rows(self._rows.with_heights(heights))

    def row(self, by: int) -> None:
        """Moves the bar down by so many rows."""
        self._with_rows(self._rows.move(by))

    def hide(self) -> None:
        """Hides the row under the bar until all are shown again."""
        self._with_rows(self._rows.hide())

    def isolate(self) -> None:
        """Shows only the rows of the bar's group, such as one axis."""
        signals = self._source.signals()
        group = signals[self._rows.at].group
        self._with_rows(self._rows.all().only(row for row, signal in enumerate(signals) if signal.group == group))

    def show_all(self) -> None:
        """Shows the rows that were hidden, too."""
        self._with_rows(self._rows.all())

    def _draw_curves_first(self, rows: int) -> None:
        """Positions as curves where there is room for them, until the operator chooses; asked once for each run."""
        if self._curves_drawn or rows < ROOM_FOR_CURVES:
            return
        self._curves_drawn = True
        signals = enumerate(self._source.signals())
        heights = {row: height_of(signal) for row, signal in signals if signal.name == POSITION}
        self._rows = self._rows.with_heights(heights)

    def _look_at(self, source: ScopeSource) -> None:
        """Shows another run: a live one from its end on, following it; a recorded one at its opening tick."""
        self._source = source
        self._following = self._live
        self._marks: dict[str, int] = {}
        self._curves_drawn = False
        self._rows = SignalRows(len(source.signals()))
        self._top = self._room = 0
        source.turn()
        self._view = Viewport().of_run(source.first_tick, source.last_tick)
        self._view = self._view.go(source.last_tick if self._live else source.opening_tick)
        self._say("")

    def _look(self) -> ScopeLook:
        marks = tuple(sorted(self._marks.items()))
        return ScopeLook(self._view, self._rows, marks, self._following, self._said, self._plain)

    def _open(self, file: str) -> None:
        """Reads a trace beside the screen; the run of before stays until then."""
        found: list[ScopeSource | None] = []

        def read(watch: Watch) -> Problems:
            source, problems = self._runs.open_trace(file, watch)
            found.append(source)
            return problems

        def opened(problems: Problems) -> None:
            source = found[0]
            if source is None:
                self._shell.message(_("Refused"), [translated(problem) for problem in problems])
                return
            self._file, self._live = file, False
            self._look_at(source)

        self._shell.work(read, opened)

    def _go_to_typed(self, text: str) -> None:
        if text.strip().isdecimal():
            self._go(int(text))
        else:
            self._say(_("a tick is a whole number, not {text!r}").format(text=text))

    def _go(self, tick: int) -> None:
        self._moved(self._view.go(tick))

    def _moved(self, view: Viewport) -> None:
        self._view, self._following = view, False
        self._say("")

    def _with_rows(self, rows: SignalRows) -> None:
        self._rows = rows
        self._say("")

    def _say(self, text: str) -> None:
        self._said = text
        self._invalidate()
