"""A form: a list of fields to type into, a line above it, and below it what the field under the cursor is about.

Rule: it knows how the cursor moves and how a value is chosen or typed; what a field is, and what becomes of what is
typed, says the screen that is made of it (configuration.py, eight_axis/parameters.py).
"""

from collections.abc import Sequence
from typing import Any, Generic, Protocol, TypeVar

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.screens.shell import Shell, asked_to_leave, choose_another
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.texts import Edit, Line, Size, Text

FORM_KEYS = (
    Key(("up",), N_("Up"), "go", N_("the field above"), argument=-1),
    Key(("down", "enter", "tab"), N_("Down"), "go", N_("the field below"), argument=1),
    Key(("f6",), "F6", "choose_value", N_("another value, from a list, where a field has choices"), N_("Choice")),
)


class FormField(Protocol):
    """What a form must know of a field: its value as it was read, and the values to choose from, none for free text."""

    @property
    def value(self) -> str:
        """The value as text."""

    @property
    def choices(self) -> tuple[str, ...]:
        """The values that it can have, if they are few."""


FieldT = TypeVar("FieldT", bound=FormField)


class FieldForm(urwid.WidgetWrap[urwid.Widget], Generic[FieldT]):
    """A subclass shows its fields by ``_show``, and says what they are by the methods that raise here."""

    keys: tuple[Key, ...] = FORM_KEYS

    def __init__(self, shell: Shell):
        self._shell = shell
        self._fields: Sequence[FieldT] = ()
        self._edits: list[Edit] = []
        self._head, self._below = Text(""), Text("")
        self._rows: urwid.SimpleFocusListWalker[Any] = urwid.SimpleFocusListWalker([])
        self._list = urwid.ListBox(self._rows)
        super().__init__(urwid.Frame(self._list, header=urwid.AttrMap(self._head, "title"), footer=self._below))

    @property
    def changed(self) -> bool:
        """Whether something typed would be lost when the form is closed."""
        raise NotImplementedError

    def keypress(self, size: Size, key: str) -> str | None:
        """The form's keys, then the field's own; Esc asks first where something would be lost."""
        if asked_to_leave(self, self._shell, key, self._give_up) or self._called(key):
            return None
        left = super().keypress(self._room(size), key)
        self._take()
        return left

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool:
        """Goes to the field that is clicked, through the fields with the wheel; what stands beside takes nothing."""
        room = self._room(size)
        taken = col < room[0] and bool(super().mouse_event(room, event, button, col, row, focus))
        self._look()
        return taken

    def go(self, by: int) -> None:
        """Moves the cursor by so many fields; it stops at the ends."""
        if self._fields:
            self._list.set_focus(max(0, min(self._list.focus_position + by, len(self._fields) - 1)))
            self._look()

    def choose_value(self) -> None:
        """Offers the values of a field that has choices."""
        field = self._field
        if field is None or not field.choices:
            self._shell.say(_("this field has no list of values: type one"))
            return
        edit, choices = self._edits[self._list.focus_position], field.choices
        now = str(edit.edit_text)

        def chosen(index: int) -> None:
            edit.set_edit_text(choices[index])
            self._take()

        choose_another(self._shell, self._label(field), choices, choices.index(now) if now in choices else None, chosen)

    @property
    def _field(self) -> FieldT | None:
        """The field under the cursor."""
        return self._fields[self._list.focus_position] if self._fields else None

    def _show(self, fields: Sequence[FieldT]) -> None:
        """Shows these fields with their values as they were read; the cursor stays where it is."""
        self._fields = fields
        self._edits = [Edit(edit_text=field.value) for field in fields]
        self._draw_rows()

    def _draw_rows(self) -> None:
        """Makes the rows anew, with what is typed."""
        at = self._list.focus_position if self._rows else 0
        self._rows[:] = [self._row(field, edit) for field, edit in zip(self._fields, self._edits, strict=True)]
        if self._rows:
            self._list.set_focus(min(at, len(self._rows) - 1))

    def _tell(self, heading: str, lines: Sequence[Line]) -> None:
        """Shows the line above the fields, and those below."""
        self._head.set_text(heading + (_(", changed") if self.changed else ""))
        self._below.set_text([part for line in lines for part in [*line, "\n"]][:-1])

    def _room(self, size: Size) -> tuple[int, int]:
        """The columns and rows that the fields have of a screen: all, where nothing stands beside."""
        assert len(size) == 2
        return size

    def _called(self, key: str) -> bool:
        """Whether a key was one of the form's, and its method was called."""
        return called(self, self.keys, key)

    def _give_up(self) -> None:
        """Discards what is typed and closes the form."""
        self._open()
        self._shell.back()

    def _open(self) -> None:
        """Reads the fields anew and shows them; what is typed is lost."""
        raise NotImplementedError

    def _row(self, field: FieldT, edit: Edit) -> urwid.Widget:
        """The row of a field."""
        raise NotImplementedError

    def _label(self, field: FieldT) -> str:
        """What a field is called."""
        raise NotImplementedError

    def _take(self) -> None:
        """Takes what is typed in the field under the cursor, after each key."""
        self._look()

    def _look(self) -> None:
        """Shows what the field under the cursor is about, by ``_tell``."""
        raise NotImplementedError
