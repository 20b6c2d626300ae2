"""Work that may take seconds, done beside the screen: it goes on drawing and hearing keys, the emergency stop first.

Rule: one piece of work at a time, in a thread that changes nothing the screen shows until it ends. After a second a
dialog shows how far it is; given up there, the work ends at its next step and has changed nothing.
"""

import time
from collections.abc import Callable
from threading import Thread

from drillctl.language import Message
from drillctl.language.words import _
from drillctl.ui.layers import Layers
from drillctl.ui.widgets import dialogs
from drillctl.ui.widgets.texts import Text
from drillctl.ui.widgets.work_part import WorkPart
from drillctl.viewmodel.console import Problems, Watch

SHOWN_AFTER_S = 1.0


class GivenUp(Exception):
    """The operator does not wait for the work any more."""


class Background:
    """Does a piece of work, and shows it in a dialog on ``layers``; ``say`` shows a word in the bottom lines."""

    def __init__(self, layers: Layers, say: Callable[[str], object]):
        self._layers, self._say = layers, say
        self._task: _Task | None = None
        self._box: dialogs.Dialog | None = None
        self._text = Text("\n")

    def run(self, work: Callable[[Watch], Problems], then: Callable[[Problems], object]) -> None:
        """Begins the work; ``then`` is called with its result, within this call where that takes less than a second."""
        assert self._task is None, "a dialog is over everything while something is done"
        self._task = _Task(work, then)
        self._task.join(SHOWN_AFTER_S)
        if self._task.is_alive():
            self._text = Text("\n")
            button = (_("Give up"), dialogs.nothing)
            self._box = dialogs.Dialog(_("Please wait"), [self._text], [button], self._task.give_up)
            self._layers.push_dialog(self._box)
        self.turn()

    def turn(self) -> None:
        """Shows how far the work is; ends it where it is done. Raises what the work raised."""
        task = self._task
        if task is None:
            return
        if task.is_alive():
            self._text.set_text(task.line(time.monotonic()))
            return
        if self._box is not None:
            self._layers.drop(self._box)
        self._task = self._box = None
        if isinstance(task.error, GivenUp):
            self._say(_("given up: nothing was changed"))
        elif task.error is not None:
            raise task.error
        else:
            task.then(task.problems)


class _Task(Thread):
    """The work in its thread: ``problems`` is its result, ``error`` what it raised."""

    def __init__(self, work: Callable[[Watch], Problems], then: Callable[[Problems], object]):
        super().__init__(daemon=True)
        self.then = then
        self.problems: Problems = ()
        self.error: Exception | None = None
        self._work, self._part, self._unwanted = work, WorkPart(Message("")), False
        self.start()

    def run(self) -> None:
        """Does the work; runs in the thread beside the screen."""
        try:
            self.problems = self._work(self._begin)
        except Exception as error:  # raised again where the screen's loop sees it
            self.error = error

    def give_up(self) -> None:
        """Asks the work to end at its next step."""
        self._unwanted = True

    def line(self, now_s: float) -> str:
        """What is done, and for how long still."""
        return _("Giving up; this takes a moment.") if self._unwanted else self._part.line(now_s)

    def _begin(self, what: Message) -> Callable[[int, int], None]:
        part = WorkPart(what)
        self._part = part

        def advance(done: int, total: int) -> None:
            if self._unwanted:
                raise GivenUp
            part(done, total)

        advance(0, 0)
        return advance
