"""The Configuration screen (the paper's Fig. 4): card, scale, work ranges, times, tick rate, for one machine's file.

Rule: every field says its unit, its bounds and what it means; what can't be taken is said below it as it is typed, and
nothing is saved while there is such a field.
"""

import urwid

from drillctl.language.words import N_, _, translated
from drillctl.ui.models.editing import History, Undoable
from drillctl.ui.models.machine_fields import ConfigurationDraft, words_of
from drillctl.ui.screens.field_form import FORM_KEYS, FieldForm
from drillctl.ui.screens.field_panel import (
    HINT_COLUMNS,
    LABEL_COLUMNS,
    TICK_RATE,
    VALUE_COLUMNS,
    about_field,
    carried_words,
    effect_lines,
    field_row,
    hint_of,
)  # fmt: skip
from drillctl.ui.screens.own_steps import CONFIGURATION_STEPS
from drillctl.ui.screens.scale_guide import ScaleGuide
from drillctl.ui.screens.shell import Shell
from drillctl.ui.screens.table_actions import TableActions, label_of
from drillctl.ui.screens.table_editor import Size
from drillctl.ui.widgets.keys import UNDO_KEYS, Key
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, with_panel
from drillctl.ui.widgets.texts import Edit, Line
from drillctl.viewmodel.bench import Bench
from drillctl.viewmodel.console import Console, Problems, Watch
from drillctl.viewmodel.tables import FieldView, TableEditing

MOST_EFFECTS = 3  # below the fields, where there is no panel


class ConfigurationScreen(Undoable[tuple[str, ...]], FieldForm[FieldView]):
    """The fields of one machine. Not live: the machine takes them when it is chosen."""

    title = N_("Configuration")
    own_steps = CONFIGURATION_STEPS
    _has_panel = _narrow = False  # as drawn last
    keys = (
        *FORM_KEYS,
        Key(("f2",), "F2", "save", N_("saves to your own copy; a wrong value is never saved"), N_("Save")),
        Key(("f3",), "F3", "diff", N_("what differs from the shipped file"), N_("Diff")),
        Key(("f5",), "F5", "choose", N_("drives this machine, as it was saved"), N_("Drive it")),
        Key(("f7",), "F7", "copy", N_("copies this machine's file under another name"), N_("Copy")),
        Key(("f8",), "F8", "reset", N_("takes your own copy away: the shipped file is in force again"), N_("Reset")),
        *UNDO_KEYS,
        Key(
            ("f12",), "F12", "measure",
            N_("measures the axis's scale; on the tick rate: what this computer carries"), N_("Measure"),
        ),
    )

    def __init__(
        self, console: Console, shell: Shell, tables: TableEditing, name: str, plain: bool = False,
        bench: Bench | None = None,
    ):  # fmt: skip
        super().__init__(shell)
        self._bench = bench
        self._hz: int | None = None  # what this computer carries, once it was measured
        self._console, self._tables, self._name = console, tables, name
        self._actions = TableActions(console, shell, tables, "machines")
        self._open()

    @property
    def draft(self) -> ConfigurationDraft:
        """The machine's fields with what is typed over them."""
        return self._draft

    @property
    def changed(self) -> bool:
        """Whether something typed would be lost when the screen is closed."""
        return self._draft.changed

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the fields, and beside them what the field under the cursor means and what a change will do."""
        left, rows = self._room(size)
        assert len(size) == 2
        beside = size[0] - left
        narrow = left - LABEL_COLUMNS - VALUE_COLUMNS < HINT_COLUMNS
        if (bool(beside), narrow) != (self._has_panel, self._narrow):
            self._has_panel, self._narrow = bool(beside), narrow
            self._look()
        lines = about_field(self._draft, self._field, self._hz, beside - BORDER_COLUMNS) if beside else []
        return with_panel(super().render((left, rows), focus), _("This field"), lines, beside, rows)

    def save(self) -> None:
        """Saves all fields, or none if one of them can't be taken."""
        text, refused = self._draft.candidate()
        if refused:
            self._shell.message(_("Not saved"), refused)
        else:
            self._actions.save(self._name, text, self._name, self._open)

    def diff(self) -> None:
        """Shows what differs from the shipped file, with what is typed."""
        self._actions.diff(self._name, self._draft.candidate()[0])

    def choose(self) -> None:
        """Changes to this machine as it was saved; what is only typed is left out."""
        self._actions.drive(self._name)

    def copy(self) -> None:
        """Copies the saved file under another name, and shows the copy; refused while unsaved."""
        if self.changed:
            self._shell.message(_("Not copied"), [_("Save first, or take back, what is typed.")])
        else:
            self._actions.copy(self._name, self._go_on_with)

    def reset(self) -> None:
        """Asks, then takes the user's copy away, and what is typed with it."""
        self._actions.reset(self._name, self._open)

    def measure(self) -> None:
        """Measures the scale of the axis under the cursor; refused while something is not saved."""
        field = self._field
        if field is not None and field.place == TICK_RATE:
            self._measure_computer(field)
        elif field is None or not field.axis:
            self._shell.message(_("Not measured"), [_("Go to a field of the axis that is to be measured.")])
        elif self.changed:
            self._shell.message(_("Not measured"), [_("Save first, or take back, what is typed.")])
        else:
            ScaleGuide(self._console, self._shell, self._tables, self._name, field.axis, self._open).begin()

    def _measure_computer(self, field: FieldView) -> None:
        """Measures what tick rate this computer carries; refused while the machine works, which it would disturb."""
        typed, bench = self._draft.shown(field), self._bench
        if bench is None or self._console.view().at_work:
            self._shell.message(_("Not measured"), [_("Ticks are measured while the machine is at rest.")])
            return
        found: list[int | None] = []

        def work(watch: Watch) -> Problems:
            hz, problems = bench.carried_hz(int(typed) if typed.isdecimal() else int(field.value), watch)
            found.append(hz)
            return problems

        def measured(problems: Problems) -> None:
            if problems:
                self._shell.message(_("Not measured"), [translated(problem) for problem in problems])
            elif found and found[0] is not None:
                self._hz = found[0]
                self._draw_rows()
                self._look()

        self._shell.work(work, measured)

    def _room(self, size: Size) -> tuple[int, int]:
        """The size of the list of fields beside its panel."""
        assert len(size) == 2
        return size[0] - panel_columns(size[0]), size[1]

    def _open(self) -> None:
        self._draft = ConfigurationDraft(self._tables, self._tables.read("machines", self._name))
        self._show(self._draft.fields)
        self._history = History(self._typed())
        self._look()

    def _label(self, field: FieldView) -> str:
        return label_of(field)

    def _take(self) -> None:
        """Takes the text of the field under the cursor; a locked field gets its value back."""
        field = self._field
        if field is None:
            return
        edit = self._edits[self._list.focus_position]
        if field.locked and edit.edit_text != field.value:
            refusal = self._draft.refusal(field, str(edit.edit_text))
            self._shell.message(_("Locked"), [translated(problem) for problem in refusal])
            edit.set_edit_text(field.value)
        self._draft.type(field, str(edit.edit_text))
        self._history.do(self._typed())
        self._look()

    def _row(self, field: FieldView, edit: Edit) -> urwid.Widget:
        return field_row(field, edit, self._hz)

    def _typed(self) -> tuple[str, ...]:
        return tuple(str(edit.edit_text) for edit in self._edits)

    def _restore(self) -> None:
        """Puts the texts of the history back into the fields, the cursor to the one that changed."""
        for at, (field, text) in enumerate(zip(self._draft.fields, self._history.now, strict=True)):
            if self._edits[at].edit_text != text:
                self._edits[at].set_edit_text(text)
                self._edits[at].set_edit_pos(len(text))
                self._draft.type(field, text)
                self._list.set_focus(at)
        self._look()

    def _go_on_with(self, name: str) -> None:
        self._name = name
        self._open()

    def _look(self) -> None:
        self._tell(f"{_(self.title)}: {self._name}", self._lines())

    def _lines(self) -> list[Line]:
        field = self._field
        if field is None:
            return [[("danger", _("problem: ") + translated(found.message))] for found in self._draft.check().problems]
        refused = [(other, self._draft.problem(other)) for other in self._draft.fields]
        wrong = [f"{label_of(other)}: {translated(problem)}" for other, problem in refused if problem]
        wrong = wrong or [translated(found.message) for found in self._draft.check().problems]
        problems: list[Line] = [[("danger", _("problem: ") + problem)] for problem in wrong]
        lines: list[Line] = []
        if not self._has_panel:
            hint = hint_of(field, self._hz) if self._narrow else []
            lines = [[_(words_of(field).meaning)], *([hint] if hint else [])]
            carried: list[Line] = [[carried_words(self._hz)]] if self._hz and field.place == TICK_RATE else []
            effects = effect_lines(self._draft)[:MOST_EFFECTS] if self._draft.changed and not problems else []
            lines += [*carried, *effects]
        return [*lines, *(problems or [[("good", _("sound"))]])]
