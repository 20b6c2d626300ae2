"""The boxes over the frame: dialogs and menus, each over the ones before it.

Rule: only the topmost gets keys. Where a box lies is worked out anew whenever one comes, goes, or the terminal's size
changes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import urwid

from drillctl.language.words import _
from drillctl.ui.widgets import dialogs
from drillctl.ui.widgets.dialogs import Accept, Act, ChoiceDialog, Field, FieldsDialog, offer
from drillctl.ui.widgets.finder import COLUMNS, ROWS, Finder
from drillctl.ui.widgets.menus import PullDown
from drillctl.ui.widgets.texts import Size, Text

LEAST = (50, 15)  # columns and rows below which the screen can't be used


@dataclass(frozen=True)
class Layer:
    """A box, and how it is laid over what is below in a terminal of so many columns and rows."""

    box: urwid.Widget
    over: Callable[[urwid.Widget, int, int], urwid.Widget]


class TooSmall(urwid.WidgetWrap[urwid.Widget]):
    """What a terminal of too few columns or rows shows in place of everything. It takes keys, and does nothing."""

    def __init__(self, columns: int, rows: int):
        template = _(
            "This terminal has {columns} columns and {rows} rows. The screen needs {least_columns} and {least_rows}, "
            "and is made for 80 and 24. The machine goes on as it was; X ends the job, F10 is the emergency stop."
        )
        text = template.format(columns=columns, rows=rows, least_columns=LEAST[0], least_rows=LEAST[1])
        super().__init__(urwid.AttrMap(urwid.Filler(Text(text), "top"), "body"))

    def selectable(self) -> bool:
        """True: no key goes elsewhere."""
        return True

    def keypress(self, size: Size, key: str) -> None:
        """Does nothing: what a key would do can't be seen."""

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Takes a click away from what can't be seen; nothing is done."""
        return True


class Layers(urwid.WidgetPlaceholder[urwid.Widget]):
    """The widget of the whole terminal. ``size`` gives the terminal's columns and rows."""

    def __init__(self, base: urwid.Widget, size: Callable[[], tuple[int, int]]):
        super().__init__(base)
        self._base, self._size = base, size
        self._layers: list[Layer] = []
        self.restack()

    @property
    def top(self) -> urwid.Widget | None:
        """The box that gets the keys; None where the screen gets them."""
        return self._layers[-1].box if self._layers else None

    @property
    def entered(self) -> str:
        """The action of a screen that Enter does in the topmost box; empty where there is none."""
        return self.top.entered if isinstance(self.top, dialogs.Dialog) else ""

    @property
    def typing(self) -> bool:
        """Whether a text field has the cursor."""
        widget: urwid.Widget | None = self
        while widget is not None and (inside := _place_of_inside(type(widget))):
            widget = getattr(widget, inside, None)
        found = isinstance(self.top, Finder) and not isinstance(self.original_widget, TooSmall)
        return widget is not None or found

    def push_dialog(self, dialog: dialogs.Dialog) -> None:
        """Lays a dialog over everything, in the middle of the terminal."""
        self._push(Layer(dialog, lambda below, columns, rows: dialogs.over(dialog, below, columns, rows)))

    def push_menu(self, box: PullDown, left: int, top: int) -> None:
        """Lays a menu over everything, its corner at this place as far as the terminal has room."""
        self._push(Layer(box, lambda below, columns, rows: _placed(box, below, left, top, columns, rows)))

    def push_finder(self, finder: Finder) -> None:
        """Lays a box that finds lines over everything, in the middle of the terminal."""
        self._push(Layer(finder, lambda below, columns, rows: _middle(finder, below, columns, rows)))

    def pop(self) -> None:
        """Takes the topmost box away."""
        del self._layers[-1:]
        self.restack()

    def drop(self, box: urwid.Widget) -> None:
        """Takes a box away wherever it lies; does nothing if it is gone already."""
        self._layers = [layer for layer in self._layers if layer.box is not box]
        self.restack()

    def close_menus(self) -> None:
        """Takes all menus away; dialogs stay."""
        self._layers = [layer for layer in self._layers if not isinstance(layer.box, PullDown)]
        self.restack()

    def restack(self) -> None:
        """Lays every box over the ones below it anew, for the present size of the terminal."""
        columns, rows = self._size()
        if columns < LEAST[0] or rows < LEAST[1]:
            self.original_widget = TooSmall(columns, rows)
            return
        widget = self._base
        for layer in self._layers:
            widget = layer.over(widget, columns, rows)
        self.original_widget = widget

    def _push(self, layer: Layer) -> None:
        self._layers.append(layer)
        self.restack()


@cache  # asked at every beat, and urwid's classes are slow to ask
def _place_of_inside(kind: type[urwid.Widget]) -> str:
    """Under which name a widget of this kind has the one inside it that has the focus; empty for a text field."""
    if issubclass(kind, urwid.Edit):
        return ""
    if issubclass(kind, urwid.WidgetWrap):
        return "_w"
    return "original_widget" if issubclass(kind, urwid.WidgetDecoration) else "focus"


def _placed(box: PullDown, below: urwid.Widget, left: int, top: int, columns: int, rows: int) -> urwid.Widget:
    """Lays a menu over what is below it, moved to the left so far that it is within the terminal."""
    width, height = min(box.columns, columns), min(box.rows_wanted, rows - top)
    shifted = max(0, min(left, columns - width))
    return urwid.Overlay(box, below, "left", width, "top", height, left=shifted, top=top)


def _middle(finder: Finder, below: urwid.Widget, columns: int, rows: int) -> urwid.Widget:
    return urwid.Overlay(finder, below, "center", min(COLUMNS, columns - 2), "middle", min(ROWS, rows - 2))


class Boxes:
    """The part of a Shell that opens dialogs: lays them on ``layers``; ``say`` shows a word in the bottom lines."""

    def __init__(self, layers: Layers, say: Callable[[str], object]):
        self.layers, self._say = layers, say

    def message(self, title: str, lines: Sequence[str]) -> None:
        """Opens a dialog that tells something."""
        self.layers.push_dialog(dialogs.message(title, lines, self.layers.pop))

    def explain(
        self, title: str, before: Sequence[str], links: Sequence[tuple[str, Act]], after: Sequence[str]
    ) -> None:
        """Opens a dialog that tells something; a line of ``links``, which stand in the middle, acts when clicked."""
        self.layers.push_dialog(dialogs.explanation(title, before, links, after, self.layers.pop))

    def say(self, text: str) -> None:
        """Shows a word in the bottom lines, until the next key."""
        self._say(text)

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        """Opens a dialog of yes and no; every answer leaves a word in the bottom lines."""

        def closed() -> None:
            self.layers.pop()
            self._say(_("answered no: nothing was started or changed"))

        def answered() -> None:
            self._say(_("answered yes"))
            yes()

        self.layers.push_dialog(dialogs.question(question, answered, closed))

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        """Opens a dialog with a line to type in."""
        self.layers.push_dialog(dialogs.entry(title, prompt, text, accept, self.layers.pop))

    def ask_fields(self, title: str, fields: Sequence[Field], accept: Accept) -> None:
        """Opens a dialog with several lines to type in; whatever lies over it when it closes stays."""
        form = FieldsDialog(title, fields, accept, lambda: self.layers.drop(form))
        self.layers.push_dialog(form)

    def choose(self, title: str, lines: Sequence[str], chosen: Callable[[int], object]) -> None:
        """Opens a dialog with lines of which one is chosen."""
        self.layers.push_dialog(ChoiceDialog(title, lines, chosen, self.layers.pop))

    def offer(self, title: str, lines: Sequence[str], ways: Sequence[tuple[str, Callable[[], object]]]) -> None:
        """Opens a dialog with several buttons, the first of which does nothing."""
        self.layers.push_dialog(offer(title, lines, ways, self.layers.pop))
