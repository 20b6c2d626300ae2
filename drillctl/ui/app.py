"""The program on the screen: one loop that lets the machine's news in, shows them, and hands keys to whom they concern.

Rule: nothing here blocks.
"""

import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import urwid

from drillctl.language.words import _, translated
from drillctl.ui.alerts import Alerts
from drillctl.ui.background import Background
from drillctl.ui.dropping import Dropping
from drillctl.ui.explanations import explanation_of
from drillctl.ui.first_keys import RESIZE, FirstKeys, Pressed
from drillctl.ui.frame import MainFrame, screen_keys
from drillctl.ui.layers import Boxes, Layers
from drillctl.ui.machines import screens_of
from drillctl.ui.next_step import step_line
from drillctl.ui.open_screens import OpenScreens
from drillctl.ui.painter import Painter
from drillctl.ui.palette import Action, actions
from drillctl.ui.screen_copy import keep_copy
from drillctl.ui.screens.own_steps import shown_step
from drillctl.ui.screens.shell import Live, MachineScreens, Shell
from drillctl.ui.widgets import borders
from drillctl.ui.widgets.finder import Finder
from drillctl.ui.widgets.keys import FRAME_KEYS, Key, called, wheel_key
from drillctl.ui.widgets.menus import Item
from drillctl.ui.widgets.themes import DEFAULT_THEME, depth_of, palette
from drillctl.viewmodel.console import Console, Problems, Watch

BEAT_S = 0.05
REST_BEAT_S = 0.35  # at rest, until a key is pressed; at work a desk silent for 0.4 s is taken for lost
FIRST_LOOK_S = 0.1  # the first frame stands before the disk is looked over for jobs that were cut off
TURNING_S = 0.035  # of a beat that a machine gets which runs free and is at work; keys and picture have the rest

Maker = Callable[[Console, Shell], urwid.Widget]


class App(Boxes):
    """The shell of the screens. ``makers`` gives the screens that every machine has, by the names that the menus use;
    ``keep_theme`` is called with a theme that was chosen.
    """

    def __init__(
        self, console: Console, theme: str = DEFAULT_THEME, plain: bool = False,
        makers: Mapping[str, Maker] | None = None, terminal: urwid.display.common.BaseScreen | None = None,
        keep_theme: Callable[[str], object] = lambda theme: None,
    ):  # fmt: skip
        borders.use(plain)
        self._theme, self._keep_theme = theme, keep_theme
        self._console, self._plain = console, plain
        self._open = OpenScreens({name: partial(maker, console, self) for name, maker in (makers or {}).items()})
        self._at_work = False
        self._next_beat: object = None
        self.frame = MainFrame(self.press)
        self._use(screens_of(console.view()))
        terminal = terminal or _terminal()
        super().__init__(Layers(self.frame, terminal.get_cols_rows), self.frame.say)
        self._menus = Dropping(self.frame.bar, self.layers, self._choose)
        self._alerts = Alerts(console, self.layers, lambda: self._family.initialise)
        self._background = Background(self.layers, self.frame.say)
        self._first_keys = FirstKeys(console, self.layers, self)
        self.loop = urwid.MainLoop(
            self.layers, palette(theme), terminal, input_filter=self.filtered, unhandled_input=self.unhandled
        )
        self._refresh_top()

    @property
    def screens(self) -> Sequence[urwid.Widget]:
        """The screens that are open; the last is on top."""
        return self._open.stack

    def run(self, interrupts: Sequence[int] = ()) -> None:
        """Until the operator leaves. ``interrupts``: signals that came; one whose exception was lost ends it too."""
        self._interrupts = interrupts
        urwid.set_encoding("ascii" if self._plain else "utf-8")  # of what it writes to, whatever the locale says
        self._next_beat = self.loop.set_alarm_in(0, self._beat)
        self.loop.set_alarm_in(FIRST_LOOK_S, lambda _loop, _data: self._family.at_start(self._console, self))
        self.loop.run()

    def turn(self) -> None:
        """Lets the console get on for a moment, then redraws what changed in the machine."""
        until_s = time.monotonic() + TURNING_S
        while time.monotonic() < until_s and self._console.turn():
            pass
        view = self._console.view()
        if (family := screens_of(view)) is not self._family:  # by the menu, or by a table that was put in force
            self._use(family)
            self.frame.show_screen(self._open.top, lowest=self._open.top_is_lowest)
        self._at_work = view.moving or view.at_work or bool(view.command)
        self.frame.show_machine(view)
        step = shown_step(self._family.next_step(self._console, view), self._open.top, view)
        typing, entered = self.layers.typing, self.layers.entered
        self.frame.show_step(step_line(step, self._open.top, self._family.menus, typing, entered))
        if isinstance(self._open.top, Live):
            self._open.top.refresh(view)
        self._alerts.show(view)
        self._background.turn()

    def filtered(self, keys: list[Pressed], _raw: list[int]) -> list[Pressed]:
        """Looks at the keys before any widget does (first_keys.py); returns those that are left."""
        if RESIZE in keys:
            self.layers.restack()
        if not self._at_work:
            self._hasten()
        if any(isinstance(key, str) and key != RESIZE for key in keys):
            self.frame.say("")
        return self._first_keys.left_of(keys)

    def unhandled(self, pressed: Pressed) -> bool:
        """What no widget wanted: the frame's keys, hot letters, and clicks on the bar or beside a menu."""
        if not isinstance(pressed, str):
            event, button, column, row = pressed
            return self._wheel(event, button) or self._menus.clicked(event, column, row)
        if pressed.startswith("meta "):
            return self._menus.drop(self.frame.bar.lettered(pressed.removeprefix("meta ")))
        return called(self, FRAME_KEYS, pressed)

    def press(self, name: str) -> None:
        """Does what a key does, by urwid's name of it: it was clicked."""
        self.loop.process_input(self.filtered([name], []))

    def _wheel(self, event: str, button: int) -> bool:
        """Moves the cursor of the screen on top by a turn of the wheel that no widget took; False for other events."""
        key = wheel_key(screen_keys(self._open.top), button) if event == "mouse press" else None
        if key is None or self.layers.top is not None:
            return False
        self.press(key)
        return True

    def open(self, screen: urwid.Widget) -> None:
        """Puts a screen on top; one that is open already comes to the top."""
        self._open.put_on_top(screen)
        self._refresh_top()

    def back(self) -> None:
        """Closes the screen on top. The first screen is not closed: it goes to the bottom again."""
        if not self._open.top_is_lowest:
            self._open.close_top()
            self._refresh_top()

    def leave_top(self) -> None:
        """Does what Esc does on the screen on top; on the first screen, leaves the program."""
        if not self._open.top_is_lowest:
            self.loop.process_input(["esc"])
        else:
            self.leave()

    def show(self, name: str) -> urwid.Widget | None:
        """Opens a screen by its name in the menus; None, and a message, where it is not to be had."""
        screen = self._open.named(name)
        if screen is None:
            self.message(_("Not here"), [_("This screen is not part of this program.")])
        else:
            self.open(screen)
        return screen

    def work(self, work: Callable[[Watch], Problems], then: Callable[[Problems], object]) -> None:
        """Does work beside the screen; ``then`` is called with its problems."""
        self._background.run(work, then)

    def emergency_stop(self) -> None:
        """Stops the machine immediately; the outputs go off."""
        self._console.emergency_stop()

    def stop(self) -> None:
        """Ends the job; the position is kept. A refusal, or that nothing is under way, is told."""
        view = self._console.view()
        under_way = view.moving or view.at_work or view.command or view.queued
        said = _("stop; the position is kept") if under_way else _("nothing is under way that could be stopped")
        self.frame.say(" ".join(map(translated, self._console.stop())) or said)

    def menu(self) -> None:
        """Opens the first menu of the bar."""
        self._menus.drop(0)

    def help(self) -> None:
        """Explains the screen on top, with its keys."""
        self.explain(*explanation_of(self._open.top, self.press))

    def find_action(self) -> None:
        """Opens a box that finds any action by its words."""
        found = actions(self.frame.bar.menus, self._open.top, self._open.every)
        lines = [action.found for action in found]
        title = _("Find an action")
        self.layers.push_finder(Finder(title, lines, lambda index: self._act(found[index]), self.layers.pop))

    def copy_screen(self) -> None:
        """Keeps the screen as a picture, in a new file of the current folder, and says its name."""
        canvas = self.layers.render(self.loop.screen.get_cols_rows(), focus=True)
        file, problems = keep_copy(canvas, self._theme, Path.cwd())
        self.frame.say(" ".join(map(translated, problems)) or _("the screen is kept as {file}").format(file=file.name))

    def notices(self) -> None:
        """Shows all notices of the machine; the line on the machine has room for the last one only."""
        notices = self._console.view().notices
        self.message(_("Notices"), [translated(notice) for notice in notices] or [_("There are no notices.")])

    def about(self) -> None:
        """Says what the program is."""
        self.message(_("About"), [_("drillctl drives and simulates stepper-motor drilling machines.")])

    def leave(self) -> None:
        """Ends the program; asks first if the machine is at work or something is not saved."""
        view = self._console.view()
        reasons = [_("The machine is at work. Stop it and leave?")] if view.moving or view.at_work else []
        lost = {_(getattr(screen, "title", "")) for screen in self._open.unsaved}
        if lost:
            reasons.append(_("Not saved: {screens}. Leave without saving?").format(screens=", ".join(sorted(lost))))
        if reasons:
            self.ask("\n".join(reasons), _leave)
        else:
            _leave()

    def set_theme(self, theme: str) -> None:
        """Changes the colours to those of another theme."""
        self.loop.screen.register_palette(palette(theme))
        self.loop.screen.clear()
        self._theme = theme
        self._keep_theme(theme)

    def choose_machine(self) -> None:
        """Opens a menu of the machines that can be chosen."""
        items = [Item(name, "", "take_machine", name) for name, _description in self._console.machines()]
        self._menus.pull(items, len(_("Machine")), 2)

    def take_machine(self, name: str) -> None:
        """Changes to another machine, at its start position, and to the screens of its family."""
        if problems := self._console.choose_machine(name):
            self.message(_("Refused"), [translated(problem) for problem in problems])
            return
        self._refresh_top()

    def _use(self, family: MachineScreens) -> None:
        """Takes the menus and the first screen of a family of machines; closes the screens of the family before."""
        self._family = family
        makers = {name: partial(make, self._console, self, self._plain) for name, make in family.makers.items()}
        self._open.use(makers, family.first)
        self.frame.bar.show(family.menus)

    def _beat(self, loop: urwid.MainLoop, _data: object = None) -> None:
        """Runs one turn of the loop; the next one is due a beat after this one began."""
        if self._interrupts:
            raise KeyboardInterrupt(self._interrupts[0])
        rested = not self._at_work
        self._next_beat = loop.set_alarm_in(REST_BEAT_S if rested else BEAT_S, self._beat)
        self.turn()
        if rested and self._at_work:
            self._hasten()  # a desk that is silent for a beat at rest is nearly taken for lost at work

    def _hasten(self) -> None:
        """Brings the next beat forward: what a key has asked for is seen as soon as while the machine is at work."""
        if self._next_beat is not None and self.loop.remove_alarm(self._next_beat):
            self._next_beat = self.loop.set_alarm_in(BEAT_S, self._beat)

    def _refresh_top(self) -> None:
        self.frame.show_screen(self._open.top, lowest=self._open.top_is_lowest)
        self.turn()

    def _choose(self, item: Item) -> None:
        self._perform(self.show(item.screen) if item.screen else self, item)

    def _act(self, action: Action) -> None:
        """Does what was found: chooses a menu's entry, or presses a screen's key with that screen on top."""
        if isinstance(action.does, Item):
            self._choose(action.does)
            return
        if action.screen is not None:
            self.open(action.screen)
        self._perform(action.screen or self, action.does)

    def _perform(self, target: object, does: Item | Key) -> None:
        """Calls the method of an entry or a key; only opens the screen for an entry without one."""
        if target is not None and does.method:
            method = getattr(target, does.method)
            method() if does.argument is None else method(does.argument)


def _leave() -> None:
    raise urwid.ExitMainLoop


def _terminal() -> Painter:
    """The terminal, with as many colours as it says it has. Drawn on another stream than that of the verbs, which
    escapes what moves the cursor.
    """
    terminal = Painter(output=sys.__stdout__ or sys.stdout)
    terminal.set_terminal_properties(depth_of(os.environ))
    return terminal
