"""What the frame offers to a screen. A screen is made with a Console and a Shell, and knows no more.

Rule: the shell owns the terminal, the menus and the dialogs; a screen owns its own widgets and its own keys.
Implemented by app.py; the tests have a shell of their own.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol, runtime_checkable

import urwid

from drillctl.language.words import _
from drillctl.ui.widgets.dialogs import Accept, Field
from drillctl.ui.widgets.menus import Item
from drillctl.viewmodel.console import Console, MachineView, Problems, Watch
from drillctl.viewmodel.signals import ManualControl


class Shell(Protocol):
    """Where a screen stands: it can tell, ask, and lead on to another screen and back."""

    def message(self, title: str, lines: Sequence[str]) -> None:
        """Opens a dialog that tells something, until Enter or Esc."""

    def say(self, text: str) -> None:
        """Shows a word in the bottom lines, until the next key."""

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        """Opens a dialog of yes and no; ``yes`` is called on a yes. Enter and Esc mean no."""

    def open(self, screen: urwid.Widget) -> None:
        """Puts another screen on top."""

    def back(self) -> None:
        """Closes the screen on top; the first one stays."""

    def show(self, name: str) -> urwid.Widget | None:
        """Opens one of the program's screens by its name in the menus; None if there is no such screen."""

    def work(self, work: Callable[[Watch], Problems], then: Callable[[Problems], object]) -> None:
        """Does work that may take seconds: a dialog shows how far it is, and lets the operator give it up. ``then`` is
        called with its problems where it was not given up.
        """

    def ask_fields(self, title: str, fields: Sequence[Field], accept: Accept) -> None:
        """Opens a dialog of several lines to type in; it stays, and says why, while ``accept`` finds problems."""

    def choose(self, title: str, lines: Sequence[str], chosen: Callable[[int], object]) -> None:
        """Opens a dialog of several lines; ``chosen`` is called with the number of one, from 0."""

    def offer(self, title: str, lines: Sequence[str], ways: Sequence[tuple[str, Callable[[], object]]]) -> None:
        """Opens a dialog that tells something, with a button that does nothing and one for each of ``ways``."""

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        """Opens a dialog with a line to type in, first ``text``; ``accept`` is called with what was typed."""


class Step(NamedTuple):
    """What the machine waits for. ``text`` names each action that does it as a field: ``{initialise} initialises``.

    attribute  the role that its meaning has: good, warning, danger
    actions    for each field a screen and its method, as the menus name them
    values     what else stands in the text
    refuses    why no motion can be begun before that; empty where one can
    """

    attribute: str
    text: str
    actions: Mapping[str, tuple[str, str]] = {}
    values: Mapping[str, str] = {}
    refuses: str = ""


class MachineScreens(NamedTuple):
    """The screens and menus of a family of machines: a row of ui/machines.py.

    recognises  whether a machine belongs to the family
    menus       the menu bar, from left to right
    makers      the family's own screens, by the names that the menus use; made with ``plain`` without UTF-8
    first       the screen that is in front to begin with, and is never closed
    next_step   what the machine waits for just now
    at_start    is called once when the first screen is drawn
    initialise  what to initialise means, where it is no motion to the limit sensors: said in the box of every fault
    """

    recognises: Callable[[MachineView], bool]
    menus: tuple[Item, ...]
    makers: Mapping[str, Callable[[Console, Shell, bool], urwid.Widget]]
    first: str
    at_start: Callable[[Console, Shell], object]
    next_step: Callable[[Console, MachineView], Step]
    initialise: str = ""


@runtime_checkable
class Live(Protocol):
    """A screen that shows the machine: it is handed the newest view some twenty times a second."""

    def refresh(self, view: MachineView) -> None:
        """Redraws what changed in the view."""


def unsaved(screen: urwid.Widget | None) -> bool:
    """Whether a screen holds something that would be lost with it: those that can, have ``changed``."""
    return bool(getattr(screen, "changed", False))


def asked_to_leave(screen: urwid.Widget, shell: Shell, key: str, give_up: Callable[[], None]) -> bool:
    """Whether ``key`` is Esc and would lose something: then it was asked about, and ``give_up`` follows on a yes."""
    if key != "esc" or not unsaved(screen):
        return False
    shell.ask(_("Leave without saving?"), give_up)
    return True


def choose_another(
    shell: Shell, title: str, lines: Sequence[str], now: int | None, chosen: Callable[[int], object]
) -> None:
    """Offers lines to choose from; the one in force, number ``now``, is marked ``*``. ``chosen`` is called with the
    number of any other one.
    """
    marked = [f"{'*' if index == now else ' '} {line}" for index, line in enumerate(lines)]
    shell.choose(title, marked, lambda index: None if index == now else chosen(index))


def asked_if_real(control: ManualControl, shell: Shell, what: str, act: Callable[[], None], warning: str = "") -> None:
    """Calls ``act`` after a yes; without a question on a simulated machine if there is no ``warning``."""
    port = control.real_port()
    real = _("A real machine is connected to {port}.").format(port=port) if port else ""
    reasons = " ".join(filter(None, (real, warning)))
    if reasons:
        shell.ask(f"{reasons} {what}", act)
    else:
        act()
