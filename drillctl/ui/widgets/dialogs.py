"""Dialogs: tell something, ask yes or no, ask for lines of text, offer a choice. Boxes over what was there before.

Rule: a dialog is closed by every way out of it, before its answer is acted upon. A form's OK is the exception: its
answers are looked at first, and while anything is wrong with them the box stays open and says so.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import urwid

from drillctl.language import Message
from drillctl.language.words import _, translated
from drillctl.ui.widgets.texts import Box, Button, Edit, Link, Pick, Size, Text

WIDEST = 72
LEAST_BUTTON = 14
YES = "y"  # means yes in every language, beside the letter of the word
LEAVING = ("q", "Q")  # close a dialog where they are not typed into a field

Act = Callable[[], object]
Part = Text | urwid.AttrMap[Any]  # text, or a field or a line to be picked, in its colours


class Dialog(urwid.WidgetWrap[urwid.Widget]):
    """A framed box of text with buttons below; ``closing`` is called before a button's own act. Esc and q only close.

    answers  the first two buttons mean no and yes: they can be pressed by the first letters of these words
    yes      a further key that means yes: that by which a screen does the same
    entered  the action of a screen that Enter does here, by its name; empty where there is none
    """

    entered = ""

    def __init__(
        self, title: str, body: Sequence[Part], buttons: Sequence[tuple[str, Act]], closing: Act,
        answers: bool = False, yes: str = YES,
    ):  # fmt: skip
        self._closing = closing
        self._first = self._closed_by(buttons[0][1])
        letters = (_("No")[0], _("Yes")[0]) if answers else ()
        marked = [f"{label} ({letter})" for (label, _act), letter in zip(buttons, letters, strict=False)]
        labels = [*marked, *(label for label, _act in buttons[len(marked) :])]
        acts = [act for _label, act in buttons]
        self._answers = {letter.lower(): self._closed_by(act) for letter, act in zip(letters, acts, strict=False)}
        if answers:
            self._answers |= {key: self._closed_by(acts[1]) for key in (YES, yes)}
        width = max(LEAST_BUTTON, max(map(len, labels)) + len("<  >"))
        cells = [self._button(*button) for button in zip(labels, acts, strict=True)]
        self._row = urwid.GridFlow(cells, width, 1, 0, "center")
        self._parts: list[Part | urwid.Divider | urwid.GridFlow] = [*body, urwid.Divider(), self._row]
        self._list = urwid.ListBox(urwid.SimpleFocusListWalker(self._parts))
        self._list.set_focus(_first_selectable(body, len(body) + 1))
        self._title = title
        self._frame = Box(urwid.Padding(self._list, left=1, right=1), title)
        super().__init__(urwid.AttrMap(self._frame, "body"))

    def keypress(self, size: Size, key: str) -> str | None:
        """Handles every key: no key passes a dialog. Down from the text leads to the first button."""
        above = self._list.focus is not self._row
        left = None if key == "esc" else super().keypress(size, key)
        if key == "esc" or left in LEAVING:
            self._closing()
        elif left == "enter":
            self._first()
        elif left is not None and left.lower() in self._answers:
            self._answers[left.lower()]()
        elif above and self._list.focus is self._row:
            self._row.focus_position = 0
        return None

    def from_the_top(self) -> None:
        """Shows the first line of a text that is longer than the terminal; Enter is the first button."""
        self._list.set_focus(0)
        self._frame.set_title(_("{title} (PgDn: more)").format(title=self._title))

    def wanted_rows(self, columns: int) -> int:
        """How many rows the whole dialog needs in this width."""
        inner = (columns - 4,)
        return sum(widget.rows(inner) for widget in self._parts) + 2

    def _button(self, label: str, act: Act) -> urwid.AttrMap[Button]:
        pressed = self._closed_by(act)
        return urwid.AttrMap(Button(label, lambda _button: pressed()), "key", "focus")

    def _closed_by(self, act: Act) -> Act:
        def both() -> None:
            self._closing()
            act()

        return both


def nothing() -> None:
    """Does nothing: the action of a button that only closes its dialog."""


def message(title: str, lines: Sequence[str], closing: Act, then: Act = nothing, entered: str = "") -> Dialog:
    """A dialog that tells something; ``then`` is called after Enter, and is the action ``entered`` of a screen."""
    dialog = Dialog(title, [Text(line) for line in lines], [(_("OK"), then)], closing)
    dialog.entered = entered
    return dialog


def explanation(
    title: str, before: Sequence[str], links: Sequence[tuple[str, Act]], after: Sequence[str], closing: Act
) -> Dialog:
    """A dialog that tells something; ``links`` in the middle are lines that close it and act when they are clicked."""

    def line(text: str, act: Act) -> Link:
        def clicked() -> None:
            closing()
            act()

        return Link(text, clicked)

    body = [*map(Text, before), Text(""), *(line(*link) for link in links), Text(""), *map(Text, after)]
    return Dialog(title, body, [(_("OK"), nothing)], closing)


def question(text: str, yes: Act, closing: Act) -> Dialog:
    """A dialog of No and Yes; No stands first, so that Enter alone does nothing."""
    body = [Text(text), Text(("dark", _("Enter and Esc mean no.")))]
    return Dialog(_("Question"), body, [(_("No"), nothing), (_("Yes"), yes)], closing, answers=True)


def entry(title: str, prompt: str, text: str, accept: Callable[[str], None], closing: Act) -> Dialog:
    """A dialog that asks for a line of text; Enter in the field, or OK, hands it to ``accept``."""
    field = _Field(("body", f"{prompt} "), text)
    dialog = Dialog(
        title,
        [urwid.AttrMap(field, "field")],
        [(_("OK"), lambda: accept(field.edit_text)), (_("Cancel"), nothing)],
        closing,
    )

    def entered() -> None:
        closing()
        accept(field.edit_text)

    field.entered = entered
    return dialog


class _Field(Edit):
    """A line of text with something to do on Enter. A character typed first takes the place of what was proposed."""

    entered: Act = staticmethod(nothing)
    _untouched = True

    def keypress(self, size: Size, key: str) -> str | None:
        assert len(size) == 1
        if key == "enter":
            self.entered()
            return None
        if self._untouched and self.valid_char(key):
            self.set_edit_text("")
        self._untouched = False
        return super().keypress(size, key)


def _first_selectable(body: Sequence[Part], otherwise: int) -> int:
    return next((i for i, widget in enumerate(body) if widget.selectable()), otherwise)


def over(dialog: Dialog, below: urwid.Widget, columns: int, rows: int) -> urwid.Widget:
    """The dialog in the middle of a terminal of this size, as high as its text needs and the terminal allows."""
    width = min(WIDEST, columns - 2)
    wanted = dialog.wanted_rows(width)
    height = min(wanted, rows - 2)
    if height < wanted:
        dialog.from_the_top()
    return urwid.Overlay(dialog, below, "center", width, "middle", height)


PROBLEM_ROWS = 3


class Field(NamedTuple):
    """A line to be filled in: what is asked, and what stands there to begin with."""

    label: str
    text: str


Answered = Callable[[Sequence[Message]], object]  # is called with what is wrong; empty for nothing
Accept = Callable[[list[str], Answered], object]


class FieldsDialog(Dialog):
    """``accept`` gets what was typed, in the order of the fields, and answers, at once or later, with what is wrong."""

    def __init__(self, title: str, fields: Sequence[Field], accept: Accept, closing: Act):
        widest = max(len(field.label) for field in fields)
        self._edits = [Edit(("body", f"{field.label:{widest}} "), field.text) for field in fields]
        self._accept = accept
        self._problems = Text("\n" * (PROBLEM_ROWS - 1))
        boxes: list[Part] = [urwid.AttrMap(edit, "field", "focus") for edit in self._edits]
        super().__init__(title, [*boxes, self._problems], [(_("OK"), self.submit), (_("Cancel"), nothing)], closing)

    def keypress(self, size: Size, key: str) -> str | None:
        """Handles a key; Tab goes to the next field as Down does."""
        return super().keypress(size, "down" if key == "tab" else key)

    def submit(self) -> None:
        """Hands the texts to ``accept``."""
        self._accept([edit.edit_text for edit in self._edits], self._answered)

    def _answered(self, problems: Sequence[Message]) -> None:
        """Closes if there are no problems, else shows them."""
        if problems:
            self._problems.set_text(("danger", "\n".join(map(translated, problems[:PROBLEM_ROWS]))))
        else:
            self._closing()

    def _closed_by(self, act: Act) -> Act:
        return act if act == self.submit else super()._closed_by(act)


class ChoiceDialog(Dialog):
    """``chosen`` is called with the number, from 0, of the line that was picked: with Enter, a click, or its digit."""

    def __init__(self, title: str, lines: Sequence[str], chosen: Callable[[int], object], closing: Act):
        self._acts = [self._closed_by(_call(chosen, index)) for index in range(len(lines))]
        marked = [f"{index} {line}" if index < 10 else f"  {line}" for index, line in enumerate(lines, start=1)]
        picks = [Pick(line, act) for line, act in zip(marked, self._acts, strict=True)]
        rows: list[Part] = [urwid.AttrMap(pick, "body", "focus") for pick in picks]
        super().__init__(title, rows, [(_("Cancel"), nothing)], closing)

    def keypress(self, size: Size, key: str) -> str | None:
        """Handles a key; a digit picks its line immediately."""
        if key.isdecimal() and 1 <= int(key) <= len(self._acts):
            self._acts[int(key) - 1]()
            return None
        return super().keypress(size, key)


def offer(title: str, lines: Sequence[str], ways: Sequence[tuple[str, Act]], closing: Act) -> Dialog:
    """A dialog with a button for each of ``ways``; the first button, which Enter means, and Esc do nothing."""
    body = [*map(Text, lines), Text(("dark", _("Enter and Esc: not now. Right, then Enter: another button.")))]
    return Dialog(title, body, [(_("Not now"), nothing), *ways], closing)


def _call(chosen: Callable[[int], object], index: int) -> Act:
    return lambda: chosen(index)
