"""Keys that are looked for before any widget sees them, so that they work over dialogs, menus and fields too.

Rule: with an emergency stop or a stop of the job no other key that was typed together with it reaches a widget.
"""

from typing import Protocol

from drillctl.ui.layers import Layers
from drillctl.ui.widgets.keys import COPY, EMERGENCY, STOP_IN_TEXT, STOP_LETTER, TYPED_STOP
from drillctl.viewmodel.console import Console

Pressed = str | tuple[str, int, int, int]  # a key's name, or a mouse event: its name, button, column and row
RESIZE = "window resize"


class Actions(Protocol):
    """What the program does for a key whatever is on top."""

    def emergency_stop(self) -> None:
        """Stops the machine immediately; the outputs go off."""

    def stop(self) -> None:
        """Ends the job; the position is kept."""

    def copy_screen(self) -> None:
        """Keeps a picture of the screen."""


class FirstKeys:
    """Calls ``actions`` for the keys they concern."""

    def __init__(self, console: Console, layers: Layers, actions: Actions):
        self._console, self._layers, self._actions = console, layers, actions

    def left_of(self, keys: list[Pressed]) -> list[Pressed]:
        """Does what these keys ask for; returns those that are left for the widgets."""
        typed = {TYPED_STOP} if TYPED_STOP in keys and self._typing_at_rest() else set()
        if ({*EMERGENCY.names} - typed).intersection(keys):
            self._actions.emergency_stop()
            return [key for key in keys if key == RESIZE]
        if COPY.names[0] in keys:
            self._actions.copy_screen()
        if self._stops_the_job(keys):
            self._actions.stop()
            return [key for key in keys if key == RESIZE]
        return [key for key in keys if key not in COPY.names]

    def _stops_the_job(self, keys: list[Pressed]) -> bool:
        """Whether a key that stops a job was pressed while something is under way. In a text field one is a letter."""
        names = {key.lower() for key in keys if isinstance(key, str)}
        asked = STOP_IN_TEXT in names or (STOP_LETTER in names and not self._layers.typing)
        return asked and (self._console.view().at_work or not self._at_rest())

    def _typing_at_rest(self) -> bool:
        """Whether a text field has the cursor while nothing moves or waits to be executed."""
        return self._layers.typing and self._at_rest()

    def _at_rest(self) -> bool:
        view = self._console.view()
        return not (view.moving or view.command or view.queued)
