"""The list of what happened at the machine, the newest at the bottom."""

import urwid

from drillctl.ui.models.events import Event, Events
from drillctl.ui.widgets.texts import Line, Size, boxed
from drillctl.viewmodel.console import MachineView


class EventList(urwid.Widget):
    """The last events that fit into a box."""

    _sizing = frozenset([urwid.Sizing.BOX])

    def __init__(self) -> None:
        super().__init__()
        self._events = Events()

    def see(self, view: MachineView) -> None:
        """Takes a new view of the machine; redraws only if something happened."""
        if self._events.see(view):
            self._invalidate()

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the newest events, one a line."""
        assert len(size) == 2
        columns, rows = size
        return boxed([_line(event) for event in list(self._events.listed)[-rows:]], columns, rows)


def _line(event: Event) -> Line:
    time, attribute, text = event
    return [("dark", f" {time}  "), (attribute, text)]
