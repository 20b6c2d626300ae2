"""What the editors of tables do with a text beyond editing it: save, reset, delete, compare, copy, drive.

Rule: a refusal is told and nothing follows; ``then`` is called only after success.
"""

import difflib
from collections.abc import Callable

from drillctl.language.words import _, translated
from drillctl.ui.models.machine_fields import words_of
from drillctl.ui.screens.shell import Shell
from drillctl.viewmodel.console import Console, Problems
from drillctl.viewmodel.tables import FieldView, TableEditing, TableKind

Then = Callable[[], None]


class TableActions:
    """What can be done with the tables of one kind, and the dialogs for it."""

    def __init__(self, console: Console, shell: Shell, tables: TableEditing, kind: TableKind):
        self._console, self._shell, self._tables, self._kind = console, shell, tables, kind

    def save(self, name: str, text: str, machine: str, then: Then) -> None:
        """Saves to the user's own copy; offers to start ``machine`` anew if the table is in use."""
        if self._refused(_("Not saved"), self._tables.save(self._kind, name, text)):
            return
        then()
        if any(entry.name == name and entry.in_use for entry in self._tables.tables(self._kind)):
            question = _("Saved. Drive the machine with it now? The position will be lost.")
            self._shell.ask(question, lambda: self.drive(machine))
        else:
            self._shell.message(_("Saved"), [_("The machine in use has other tables.")])

    def reset(self, name: str, then: Then) -> None:
        """Asks, then removes the user's copy; refused where the table does not come with the program."""

        def yes() -> None:
            if not self._refused(_("Nothing changed"), self._tables.reset(self._kind, name)):
                then()

        if any(entry.name == name and entry.ships for entry in self._tables.tables(self._kind)):
            self._shell.ask(_("Take your own copy away and go back to the shipped table?"), yes)
        else:
            yes()

    def delete(self, name: str, then: Then) -> None:
        """Asks, then deletes a table of the user's own for good."""

        def yes() -> None:
            if not self._refused(_("Nothing changed"), self._tables.delete(self._kind, name)):
                then()

        self._shell.ask(_("Delete {name}, which is your own, for good?").format(name=name), yes)

    def compare(self, name: str) -> None:
        """Asks for another table, and shows what differs."""

        def accept(other: str) -> None:
            if other not in {entry.name for entry in self._tables.tables(self._kind)}:
                self._shell.message(_("Not compared"), [_("there is no table named {name!r}").format(name=other)])
                return
            lines = differences(self._tables, self._kind, name, other)
            self._shell.message(_("Differences"), lines or [_("none: they are alike")])

        self._shell.ask_text(_("Compare"), _("{name} with:").format(name=name), "", accept)

    def diff(self, name: str, text: str) -> None:
        """Shows what differs between a text and the shipped table."""
        lines = self._tables.diff(self._kind, name, text)
        self._shell.message(_("Differences"), lines or [_("none: this is the shipped table")])

    def copy(self, name: str, then: Callable[[str], None]) -> None:
        """Asks for a new name, copies the table, and calls ``then`` with the name."""

        def accept(new_name: str) -> None:
            if not self._refused(_("Not copied"), self._tables.copy(self._kind, name, new_name)):
                then(new_name)

        self._shell.ask_text(_("Copy"), _("New name:"), f"my-{name}", accept)

    def drive(self, machine: str) -> None:
        """Starts the machine anew with the saved tables; refused while something moves."""
        self._refused(_("Not loaded"), self._console.choose_machine(machine))

    def _refused(self, title: str, problems: Problems) -> bool:
        if problems:
            self._shell.message(title, [translated(problem) for problem in problems])
        return bool(problems)


LABEL_COLUMNS, VALUE_COLUMNS = 26, 18


def differences(tables: TableEditing, kind: TableKind, name: str, other: str) -> list[str]:
    """A line for each difference between two tables; none for two that are alike."""
    here, there = tables.read(kind, name), tables.read(kind, other)
    if kind == "machines" and tables.fields(here) and tables.fields(there):
        return _of_fields(tables.fields(here), tables.fields(there), name, other)
    return list(difflib.unified_diff(here.splitlines(), there.splitlines(), name, other, lineterm=""))


def label_of(field: FieldView) -> str:
    """What a field is called on the screen, its axis first."""
    label = _(words_of(field).label)
    return f"{field.axis.upper()}: {label}" if field.axis else label


def _of_fields(first: tuple[FieldView, ...], second: tuple[FieldView, ...], name: str, other: str) -> list[str]:
    here, there = ({label_of(field): field.value for field in fields} for fields in (first, second))
    labels = [*here, *(label for label in there if label not in here)]
    pairs = [(label, here.get(label, "-"), there.get(label, "-")) for label in labels]
    rows = [_row(*pair) for pair in pairs if pair[1] != pair[2]]
    return [_row("", name, other), *rows] if rows else []


def _row(label: str, value: str, other: str) -> str:
    return f"{label:{LABEL_COLUMNS}} {value:{VALUE_COLUMNS}} {other}"
