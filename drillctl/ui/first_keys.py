"""Keys that are looked for before any widget sees them, so that they work over dialogs, menus and fields too.

Rule: with an emergency stop or a stop of the job no other key that was typed together with it reaches a widget.
"""

from collections.abc import Callable
from typing import Protocol

from drillctl.language.words import _
from drillctl.ui.layers import Layers
from drillctl.ui.widgets.dialogs import Dialog
from drillctl.ui.widgets.keys import COPY, EMERGENCY, STOP_JOB, TYPED_STOP
from drillctl.viewmodel.console import Console

Pressed = str | tuple[str, int, int, int]  # a key's name, or a mouse event: its name, button, column and row
RESIZE = "window resize"


class Actions(Protocol):
    """What the program does for a key whatever is on top."""

    def emergency_stop(self) -> None:
        """Stops the machine immediately; the outputs go off."""

    def copy_screen(self) -> None:
        """Keeps a picture of the screen."""


class FirstKeys:
    """Calls ``actions`` and the console for the keys they concern; ``say`` shows a message on the frame."""

    def __init__(self, console: Console, layers: Layers, actions: Actions, say: Callable[[str], object]):
        self._console, self._layers = console, layers
        self._actions, self._say = actions, say

    def left_of(self, keys: list[Pressed]) -> list[Pressed]:
        """Does what these keys ask for; returns those that are left for the widgets."""
        typed = {TYPED_STOP} if TYPED_STOP in keys and self._typing_at_rest() else set()
        if ({*EMERGENCY.names} - typed).intersection(keys):
            self._actions.emergency_stop()
            return [key for key in keys if key == RESIZE]
        if COPY.names[0] in keys:
            self._actions.copy_screen()
        if self._stops_the_job(keys):
            self._console.stop()
            self._say(_("stop; the position is kept"))
            return [key for key in keys if key == RESIZE]
        return [key for key in keys if key not in COPY.names]

    def _stops_the_job(self, keys: list[Pressed]) -> bool:
        """Whether the key that stops a job was pressed over a box while a job runs. Typed into a text it is a letter;
        without a box it is a key of the screen.
        """
        asked = any(isinstance(key, str) and key.lower() == STOP_JOB for key in keys)
        boxed = isinstance(self._layers.top, Dialog) and not self._layers.typing
        return asked and boxed and self._console.view().at_work

    def _typing_at_rest(self) -> bool:
        """Whether a text field has the cursor while nothing moves or waits to be executed."""
        view = self._console.view()
        idle = not (view.moving or view.command or view.queued)
        return idle and self._layers.typing
