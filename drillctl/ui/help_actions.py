"""What the menu Help and its keys do: explain a screen, find an action, keep a copy of the screen, tell notices.

Rule: they show and call what is there; nothing of the machine or of the screens changes here.
"""

from functools import partial
from pathlib import Path

import urwid

from drillctl.language.words import _, translated
from drillctl.ui.explanations import EXPLAINED, SIGNS
from drillctl.ui.frame import MainFrame, screen_keys
from drillctl.ui.layers import Boxes
from drillctl.ui.palette import actions
from drillctl.ui.screen_copy import keep_copy
from drillctl.ui.widgets.dialogs import nothing
from drillctl.ui.widgets.finder import Finder
from drillctl.ui.widgets.keys import FRAME_KEYS, Key, help_lines
from drillctl.ui.widgets.menus import Item
from drillctl.viewmodel.console import Console


class HelpActions(Boxes):
    """The part of the program that helps; the App is made of it, and has what is named here.

    screens  those that are open; ``_made``: every screen that was made, by its name
    """

    screens: list[urwid.Widget]
    frame: MainFrame
    loop: urwid.MainLoop
    _console: Console
    _made: dict[str, urwid.Widget]
    _theme: str

    def press(self, name: str) -> None:
        """Does what a key does, by urwid's name of it."""
        raise NotImplementedError  # by the App, as the three below

    def open(self, screen: urwid.Widget) -> None:
        """Puts a screen on top."""
        raise NotImplementedError

    def _choose(self, item: Item) -> None:
        raise NotImplementedError

    def _perform(self, target: object, does: Item | Key) -> None:
        raise NotImplementedError

    def help(self) -> None:
        """Explains the screen on top, then lists its keys, each of which can be clicked, and the rest of its signs."""
        screen = self.screens[-1]
        keys = [*screen_keys(screen), *FRAME_KEYS]
        acts = [partial(self.press, key.names[0]) if key.names else nothing for key in keys]
        title = getattr(screen, "title", "")
        first, last = (map(_, table.get(title, ())) for table in (EXPLAINED, SIGNS))
        links = [*zip(help_lines(keys), acts, strict=True)]
        self.explain(_(title) or _("Keys"), [*first], links, [*last])

    def find_action(self) -> None:
        """Opens a box that finds any action by its words."""
        found = actions(self.frame.bar.menus, self.screens[-1], [*self.screens, *self._made.values()])

        def chosen(index: int) -> None:
            _found, does, screen = found[index]
            if isinstance(does, Item):
                self._choose(does)
                return
            if screen is not None:
                self.open(screen)
            self._perform(screen or self, does)

        lines = [action.found for action in found]
        self.layers.push_finder(Finder(_("Find an action"), lines, chosen, self.layers.pop))

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
