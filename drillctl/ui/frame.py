"""What stays on every screen: the menu bar, a line on the machine, the next step, and the keys at the bottom.

Rule: it only shows; what a click or a key does is decided in app.py. Where there is room a screen has a border with its
title; elsewhere the title stands in the line on the machine, which is drawn out to a rule.
"""

from collections.abc import Callable, Sequence
from typing import Any

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.widgets.borders import lines
from drillctl.ui.widgets.keys import EMERGENCY, FRAME_KEYS, STOP, Key, key_parts
from drillctl.ui.widgets.menus import Item, hot_letter, label_markup, plain_label
from drillctl.ui.widgets.sizes import layout
from drillctl.ui.widgets.texts import Line, Size, Text, boxed, indices_packed, packed, width_of
from drillctl.ui.widgets.windows import Window
from drillctl.viewmodel.console import MachineView

# Condition: how it is shown, and its word.
CONDITIONS = {
    "ready": ("good", N_("READY")),
    "holding": ("warning", N_("BRAKING")),
    "held": ("warning", N_("HELD")),
    "stopping": ("warning", N_("STOPPING")),
    "returning": ("warning", N_("RETURNING")),
    "latched": ("danger", N_("FAULT")),
    "zero_only": ("warning", N_("ZERO ONLY")),
}
PAUSED = ("warning", N_("CLOCK STOPPED"))
AT_WORK = ("good", N_("AT WORK"))  # while a job is under way that waits for nobody
FRAME_ROWS = 6  # that the frame takes of the terminal, the keys in three of them


class MenuBar(Text):
    """``menus`` side by side; ``left_of`` and ``at`` say where each of them stands."""

    menus: Sequence[Item] = ()

    def __init__(self) -> None:
        super().__init__("", wrap="clip")

    def show(self, menus: Sequence[Item]) -> None:
        """Replaces the menus of the bar."""
        self.menus = menus
        self.set_text([part for menu in menus for part in (" ", *label_markup(menu), " ")])

    def left_of(self, index: int) -> int:
        """The first column of a menu, by its index."""
        return sum(len(plain_label(menu)) + 2 for menu in self.menus[:index])

    def at(self, column: int) -> int | None:
        """The index of the menu at a column; None beside the menus."""
        inside = (i for i in range(len(self.menus)) if self.left_of(i) <= column < self.left_of(i + 1))
        return next(inside, None)

    def lettered(self, letter: str) -> int | None:
        """The index of the menu with this hot letter; None where no menu has it."""
        return next((i for i, menu in enumerate(self.menus) if hot_letter(menu) == letter.lower()), None)


class KeyLine(urwid.Widget):
    """Shows the keys that have a short word, in as many lines as they need; ``press`` is called with the one that is
    clicked, by urwid's name.
    """

    _sizing = frozenset([urwid.Sizing.FLOW])
    keys: Sequence[Key] = ()

    def __init__(self, press: Callable[[str], object]):
        super().__init__()
        self._press = press

    def show(self, keys: Sequence[Key]) -> None:
        """Replaces the keys by those of another screen."""
        self.keys = [key for key in keys if key.short]
        self._invalidate()

    def at(self, columns: int, column: int, row: int) -> Key | None:
        """Returns the key that is shown at a place, in a line of so many columns; None beside the keys."""
        parts = key_parts(self.keys)
        lines = indices_packed(parts, columns)
        for index in lines[row] if row < len(lines) else ():
            column -= width_of(parts[index])
            if column < 0:
                return self.keys[index]
        return None

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Presses the key that is clicked with the first button."""
        assert len(size) == 1
        key = self.at(size[0], col, row) if event == "mouse press" and button == 1 else None
        if key is None or not key.names:
            return False
        self._press(key.names[0])
        return True

    def rows(self, size: tuple[int], focus: bool = False) -> int:
        """How many lines the keys need in this width."""
        return len(packed(key_parts(self.keys), size[0]))

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the keys, as many a line as fit."""
        assert len(size) == 1
        lines = packed(key_parts(self.keys), size[0])
        return boxed(lines, size[0], len(lines))


class MainFrame(urwid.Frame[Any, Any, Any]):
    """The menu bar and the line on the machine above, a screen in the middle, the next step and the keys below.

    press   is called with a key that is clicked, by urwid's name
    screen  the one that is shown
    """

    screen: urwid.Widget

    def __init__(self, press: Callable[[str], object]) -> None:
        self.bar = MenuBar()
        self._machine = Text("", wrap="ellipsis")
        self._step = Text("")  # in a narrow terminal it takes a second row
        self._keys = KeyLine(press)
        self._window = Window(urwid.SolidFill())
        self._title: Line = []
        self._name = self._port = ""
        self._state: Line = []
        self._notice: Line = []
        self._shown: Line = []
        self._next: Line = []
        self._said = ""
        header = urwid.Pile([urwid.AttrMap(self.bar, "menu"), self._machine])
        super().__init__(self._window, header=header, footer=urwid.Pile([self._step, self._keys]))

    def show_screen(self, screen: urwid.Widget, lowest: bool = True) -> None:
        """Shows another screen and its keys. ``lowest``: no screen is below it, so Esc leads nowhere."""
        self.screen = screen
        self.body = self._window = Window(screen, _(getattr(screen, "title", "")))
        at_machine = getattr(screen, "has_windows", False)  # elsewhere the next step names the key while a job runs
        first = [EMERGENCY, *([STOP] if at_machine else [])]
        others = [key for key in FRAME_KEYS if key not in (EMERGENCY, STOP)]
        frame_keys = [key for key in others if not (lowest and key.method == "back")]
        self._keys.show([*first, *screen_keys(screen), *frame_keys])

    def show_step(self, step: Line) -> None:
        """Shows what the machine waits for, and the keys that do it."""
        if step != self._next:
            self._next = step
            self._invalidate()

    def say(self, text: str) -> None:
        """Shows a word in front of the next step, an empty text none; above it where both don't fit."""
        if text != self._said:
            self._said = text
            self._invalidate()

    def _fit_bottom(self, columns: int) -> None:
        said: Line = [("title", f" {self._said} ")] if self._said else []
        fits = width_of([*said, *self._next]) <= columns
        self._step.set_text([*said, *([] if fits or not said else ["\n"]), *self._next])

    def render(self, size: Size, focus: bool = False) -> urwid.CompositeCanvas:
        """Fits the line on the machine first: where the position would not be seen, the screen's title is left out,
        then the port, then the end of the machine's name.
        """
        assert len(size) == 2
        framed = layout(size[0], size[1] - FRAME_ROWS).framed
        self._window.show(framed and not getattr(self.screen, "has_windows", False))
        before: list[Line] = [[f" {self._name} | {self._port} | "], [f" {self._name} | "]]
        if not framed:
            before.insert(0, [*self._title, *before[0]])
        room = size[0] - width_of(self._state)
        fitting = next((line for line in before if width_of(line) <= room), [_shortened(self._name, room)])
        markup = [*fitting, *self._state, *self._notice]
        if (left := size[0] - width_of(markup) - 1) > 0:
            markup = [*markup, " ", ("border", lines().across * left)]
        self._fit_bottom(size[0])
        if markup != self._shown:
            self._shown = markup
            self._machine.set_text(list(markup))
        return super().render(size, focus)

    def show_machine(self, view: MachineView) -> None:
        """Draws the line on the machine: condition, position, newest notice."""
        attribute, word = CONDITIONS[view.condition]
        if view.paused:
            attribute, word = PAUSED
        elif view.condition == "ready" and view.moving:
            attribute, word = AT_WORK
        moving = _("moving") if view.moving else _("at rest")
        position = ("good", _("position known")) if view.position_known else ("warning", _("position not known"))
        tables = f" {_('(local)')}" if view.local else ""
        name, port = f"{view.machine}{tables}", _plant_or_port(view)
        shown = (attribute, f" {_(word)} ")
        title = ("title", f" {_(getattr(self.screen, 'title', ''))} ")
        state: Line = [shown, f" {moving} | ", position]
        notice: Line = [" | ", ("warning", translated(view.notices[-1]))] if view.notices else []
        known = (self._name, self._port, self._state, self._notice, self._title)
        if (name, port, state, notice, [title]) != known:
            self._name, self._port, self._state, self._notice, self._title = name, port, state, notice, [title]
            self._invalidate()


def _shortened(name: str, columns: int) -> str:
    """The beginning of a machine's name in so many columns; empty where there is room for less than a letter."""
    kept = columns - len(" … | ")
    return f" {name[:kept]}… | " if kept > 0 else ""


def _plant_or_port(view: MachineView) -> str:
    """The port; in its place the dynamic plant with the number of its faults, which the machine's window names."""
    if not view.plant:
        return view.port
    count = len(view.plant.split()) - 1
    return _("dynamic, faults: {count}").format(count=count) if count else _("dynamic")


def screen_keys(screen: urwid.Widget) -> Sequence[Key]:
    """The key table of a screen; an empty one for a screen without keys."""
    return getattr(screen, "keys", ())
