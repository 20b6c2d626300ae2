"""The Signals screen (Tests): every input and output by name, live; outputs and coils switched by hand while at
rest, inputs of a simulated machine pressed.

Rule: what is seen is what the port has, and nothing is switched that was not asked for: a coil costs the position, a
real machine moves, so both are asked about first.
"""

from collections.abc import Sequence

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.signal_grid import CELL_COLUMNS, about, grid_lines, grid_rows, image_lines, moved
from drillctl.ui.screens.own_steps import SIGNAL_STEPS
from drillctl.ui.screens.shell import Shell, asked_if_real
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.texts import Line, Size, boxed, width_of
from drillctl.viewmodel.console import Console, MachineView
from drillctl.viewmodel.signals import ManualControl, SignalView

SWITCHES = N_("switches the output on or off, at rest; presses an input of the simulated machine")


class Signals(urwid.Widget):
    """The signals, one of them under the cursor; ``refresh`` is called with the newest view."""

    _sizing = frozenset([urwid.Sizing.BOX])
    _selectable = True
    title = N_("Signals")
    own_steps = SIGNAL_STEPS
    keys = (
        Key((" ", "enter"), N_("Space"), "toggle", SWITCHES, N_("Switch")),
        Key(("left",), N_("Left"), "sideways", N_("the signal before"), argument=-1),
        Key(("right",), N_("Right"), "sideways", N_("the next signal"), argument=1),
        Key(("up",), N_("Up"), "downwards", N_("a line up"), argument=-1),
        Key(("down",), N_("Down"), "downwards", N_("a line down"), argument=1),
        Key(("page up",), "PgUp", "downwards", N_("a section of lines up"), argument=-8),
        Key(("page down",), "PgDn", "downwards", N_("a section of lines down"), argument=8),
    )

    def __init__(self, console: Console, shell: Shell, control: ManualControl):
        self._console, self._shell, self._control = console, shell, control
        self._signals: tuple[SignalView, ...] = ()
        self._cursor = self._top = 0
        self._columns = 80
        self._said: tuple[str, str] = ("body", "")
        self._limited = ""
        self.refresh(console.view())

    def refresh(self, view: MachineView) -> None:
        """Reads the signals again; redraws only if something is new."""
        signals = tuple(self._control.signals())
        self._limit(view)
        if signals != self._signals:
            self._signals = signals
            self._cursor = min(self._cursor, len(signals) - 1)
            self._invalidate()

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; returns any other key for the frame."""
        return None if called(self, self.keys, key) else key

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the lines around the cursor, and below them what the cursor is on."""
        assert len(size) == 2
        self._columns, rows = size
        about_it = folded([[("key", about(self._signals[self._cursor]))]], self._columns - 2)
        answer = folded([[self._answer_line()]], self._columns)
        room = max(1, rows - len(about_it) - len(answer))
        lines = grid_lines(self._signals, self._cursor, self._columns)
        self._scroll(room, len(lines))
        shown = lines[self._top : self._top + room]
        image = [[], *image_lines(self._signals)]
        shown += image if len(shown) + len(image) <= room else []
        foot = [*self._foot(about_it, len(lines), room), *answer]
        return boxed([*shown, *([[]] * (room - len(shown))), *foot], self._columns, rows)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Sets the cursor on a click; moves it with the wheel."""
        if event != "mouse press":
            return False
        if button in (4, 5):
            self.downwards(-1 if button == 4 else 1)
            return True
        rows = grid_rows(self._signals, self._columns)
        places = rows[self._top + row] if self._top + row < len(rows) else []
        place = col // CELL_COLUMNS
        if place < len(places):
            self._go(places[place])
        return place < len(places)

    def toggle(self) -> None:
        """Switches an output or a coil over; asks first where a coil would cost a known position. Presses an input of a
        simulated machine, and lets it go.
        """
        signal = self._signals[self._cursor]
        if signal.kind == "input":
            self._press(signal)
            return
        coil = signal.kind == "coil" and self._console.view().position_known
        warning = _("{name} is a motor's wire: the position will be lost.").format(name=signal.name) if coil else ""
        state = _("off") if signal.on else _("on")
        what = _("Switch {name} {state}?").format(name=signal.name, state=state)
        asked_if_real(self._control, self._shell, what, lambda: self._switch(signal), warning)

    def sideways(self, by: int) -> None:
        """Moves the cursor by so many signals; it stops at the ends."""
        self._go(max(0, min(self._cursor + by, len(self._signals) - 1)))

    def downwards(self, by: int) -> None:
        """Moves the cursor down by so many lines; it stops at the ends."""
        for _line in range(abs(by)):
            self._go(moved(self._signals, self._cursor, self._columns, 1 if by > 0 else -1))

    def _press(self, signal: SignalView) -> None:
        if self._control.real_port():
            self._say("warning", _("{name} is an input: it is read, not switched").format(name=signal.name))
        elif problems := self._control.press_input(signal.bit, not signal.held):
            self._say("warning", _("refused: {why}").format(why="; ".join(map(translated, problems))))
        else:
            said = _("{name} is let go") if signal.held else _("{name} is pressed; Space lets it go")
            self._say("body", said.format(name=signal.name))

    def _switch(self, signal: SignalView) -> None:
        if problems := self._control.set_output(signal.bit, not signal.on):
            self._say("warning", _("refused: {why}").format(why="; ".join(map(translated, problems))))
        else:
            self._say("body", "")

    def _go(self, cursor: int) -> None:
        self._cursor = cursor
        self._say("body", "")

    def _say(self, attribute: str, text: str) -> None:
        self._said = (attribute, text)
        self._invalidate()

    def _limit(self, view: MachineView) -> None:
        """Notes what the machine does by itself about outputs that would burn a winding."""
        limited = _("what would have burned a winding went off after a second") if view.cut_off else ""
        if view.hot_s:
            warning = _("this burns a winding at rest: it goes off by itself in {seconds:.1f} s")
            limited = warning.format(seconds=view.hot_s)
        if limited != self._limited:
            self._limited = limited
            self._invalidate()

    def _scroll(self, room: int, lines: int) -> None:
        """Scrolls so far that the cursor's line and the line above it are seen."""
        rows = grid_rows(self._signals, self._columns)
        at = next((number for number, row in enumerate(rows) if self._cursor in row), 0)
        self._top = max(min(self._top, at - 1), at - room + 1, 0)
        self._top = min(self._top, max(0, lines - room))

    def _foot(self, about_it: Sequence[Line], lines: int, room: int) -> list[Line]:
        """What the cursor is on, and how much there is above and below."""
        above, below = self._top, max(0, lines - self._top - room)
        more = _("lines above: {above}, below: {below}").format(above=above, below=below) if above or below else ""
        *before, last = [[("key", " "), *line, ("key", " ")] for line in about_it]
        ended: Line = [*last, " ", more]
        return [*before, ended if width_of(ended) <= self._columns else last]

    def _answer_line(self) -> tuple[str, str]:
        """The last answer, or the warning that a winding is in danger."""
        return ("warning", self._limited) if self._limited else self._said
