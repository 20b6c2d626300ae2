"""The form of a group of parameters: a field each with what it may be, below what the one under the cursor means and
does, and what is wrong.

Rule: what can't be is said as it is typed, and nothing is saved while there is such a field. What is saved is taken by
the machine, which is started anew.
"""

from collections.abc import Callable
from typing import Any

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.screens.field_form import FORM_KEYS, FieldForm
from drillctl.ui.screens.shell import Shell
from drillctl.ui.widgets.keys import Key
from drillctl.ui.widgets.texts import Edit, Line, Size, Text, WholeText
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.production import ParameterView, Production

VALUE_COLUMNS, RANGE_COLUMNS = 12, 26
LEAST_COLUMNS = 76  # in fewer there is no room for the range beside the longest name
NUMBERED = ("tool", "magazine")  # groups whose rows can be added and removed
MOST_PROBLEMS = 3
COSTS = N_("The machine is started anew with it, and must be initialised again.")


class ParameterForm(FieldForm[ParameterView]):
    """The parameters of one group. Not live: the machine has them once they are saved."""

    title = N_("Parameters")
    keys = (
        *FORM_KEYS,
        Key(("f2",), "F2", "save", N_("saves, and starts the machine anew with it"), N_("Save")),
        Key(("insert",), "Ins", "add", N_("one more tool, or place of the magazine"), N_("Add")),
        Key(("delete",), "Del", "remove", N_("takes a tool or place away; asks first"), N_("Remove")),
    )

    def __init__(self, production: Production, shell: Shell, group: str, heading: str):
        super().__init__(shell)
        self._production, self._group, self._heading = production, group, heading
        self._narrow = False  # as drawn last
        self._open()

    @property
    def changed(self) -> bool:
        """Whether something typed would be lost when the form is closed."""
        return bool(self._typed())

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the fields; where there are few columns what a field may be is said below alone."""
        assert len(size) == 2
        if (size[0] < LEAST_COLUMNS) != self._narrow:
            self._narrow = size[0] < LEAST_COLUMNS
            self._draw_rows()
        return super().render(size, focus)

    def save(self) -> None:
        """Saves all fields, or none if one of them can't be taken."""
        if not self.changed:
            self._shell.say(_("nothing has changed"))
            return
        typed = self._typed()
        self._once_sure(lambda: self._done(self._production.enter(typed), _("saved; the machine was started anew")))

    def add(self) -> None:
        """Asks for the number of one more tool or place, and saves it with everything else unset."""
        if self._group not in NUMBERED:
            self._shell.say(_("tools and places of the magazine can be added"))
        elif self._is_settled():
            numbers = [int(field.name.split(".")[1]) for field in self._fields]
            proposed = str(max(numbers, default=0) + 1)
            self._shell.ask_text(_("Add"), _("Number:"), proposed, self._add)

    def remove(self) -> None:
        """Asks, then takes away the tool or place that the cursor is in."""
        field = self._field
        if field is not None and self._group in NUMBERED and self._is_settled():
            row = field.name.rpartition(".")[0]
            number = int(row.partition(".")[2])
            costs = f" {_(COSTS)}" if self._production.position_known else ""
            self._shell.ask(
                _("Remove {row}?").format(row=row) + costs,
                lambda: self._done(self._production.remove(self._group, number), _("removed")),
            )

    def _add(self, text: str) -> None:
        if text.strip().isdecimal():
            number = int(text)
            answer = _("added; its parameters are unset")
            self._once_sure(lambda: self._done(self._production.add(self._group, number), answer))
        else:
            self._shell.message(_("Refused"), [_("a number is wanted, not {text!r}").format(text=text)])

    def _once_sure(self, save: Callable[[], None]) -> None:
        """Saves; asks first where that costs a position."""
        if self._production.position_known:
            self._shell.ask(f"{_('Save?')} {_(COSTS)}", save)
        else:
            save()

    def _is_settled(self) -> bool:
        """Whether nothing is typed that a change of the rows would lose; where something is, it is said."""
        if self.changed:
            self._shell.message(_("Refused"), [_("Save first, or take back, what is typed.")])
        return not self.changed

    def _done(self, problems: Problems, answer: str) -> None:
        if problems:
            self._shell.message(_("Not saved"), [translated(problem) for problem in problems])
        else:
            self._open()
            self._shell.say(answer)

    def _open(self) -> None:
        self._show(self._production.parameters(self._group))
        self._look()

    def _row(self, field: ParameterView, edit: Edit) -> urwid.Widget:
        box = urwid.AttrMap(edit, "field", "focus")
        cells: list[Any] = [Text(field.name, wrap="clip"), (VALUE_COLUMNS, box)]
        return urwid.Columns(
            cells if self._narrow else [*cells, (RANGE_COLUMNS, WholeText([("dark", field.allowed)]))], 1
        )

    def _label(self, field: ParameterView) -> str:
        return field.name

    def _called(self, key: str) -> bool:
        return (key != "delete" or self._group in NUMBERED) and super()._called(key)

    def _look(self) -> None:
        self._tell(self._heading, self._lines())

    def _typed(self) -> dict[str, str]:
        """What differs from the machine's file, by the parameters' names."""
        pairs = zip(self._fields, self._edits, strict=True)
        return {field.name: str(edit.edit_text) for field, edit in pairs if edit.edit_text != field.value}

    def _lines(self) -> list[Line]:
        field = self._field
        if field is None:
            return [[_("Nothing is entered yet: Ins adds a row.")]]
        wrong = [
            translated(problem)
            for name, typed in self._typed().items()
            for problem in self._production.problem(name, typed)
        ]
        problems: list[Line] = [[("danger", _("problem: ") + problem)] for problem in wrong[:MOST_PROBLEMS]]
        return [
            [("title", field.name), f"  {field.allowed}"],
            [_(field.meaning)],
            [("dark", _(field.effect))],
            *(problems or [[("good", _("sound"))]]),
        ]
