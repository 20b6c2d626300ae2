"""What the editors of tables do with a text beyond editing it: save, reset, delete, compare, copy, drive.

Rule: a refusal is told and nothing follows; ``then`` is called only after success. Used by table_editor, configuration
and table_list.
"""

from collections.abc import Callable

from drillctl.panel.console import Console, Problems
from drillctl.panel.tables import Kind, TableDesk
from drillctl.ui.screens.compare import differences
from drillctl.ui.shell import Shell
from drillctl.ui.told import told
from drillctl.ui.words import _

Then = Callable[[], None]


class Shelf:
    """The tables of one kind, with the dialogs that go with them."""

    def __init__(self, console: Console, shell: Shell, desk: TableDesk, kind: Kind):
        self._console, self._shell, self._desk, self._kind = console, shell, desk, kind

    def save(self, name: str, text: str, machine: str, then: Then) -> None:
        """To the user's own copy; where it drives the machine at hand, ``machine`` can then be started anew with it."""
        if self._refused(_("Not saved"), self._desk.save(self._kind, name, text)):
            return
        then()
        if any(entry.name == name and entry.in_use for entry in self._desk.tables(self._kind)):
            question = _("Saved. Drive the machine with it now? The position will be lost.")
            self._shell.ask(question, lambda: self.drive(machine))
        else:
            self._shell.message(_("Saved"), [_("The machine at hand is driven by other tables.")])

    def reset(self, name: str, then: Then) -> None:
        """Asks first where there is something to go back to; else the refusal is all there is to say."""

        def yes() -> None:
            if not self._refused(_("Nothing changed"), self._desk.reset(self._kind, name)):
                then()

        if any(entry.name == name and entry.ships for entry in self._desk.tables(self._kind)):
            self._shell.ask(_("Take your own copy away and go back to the shipped table?"), yes)
        else:
            yes()

    def delete(self, name: str, then: Then) -> None:
        """Asks first; there is no way back."""

        def yes() -> None:
            if not self._refused(_("Nothing changed"), self._desk.delete(self._kind, name)):
                then()

        self._shell.ask(_("Delete {name}, which is your own, for good?").format(name=name), yes)

    def compare(self, name: str) -> None:
        """Asks with which."""

        def accept(other: str) -> None:
            if other not in {entry.name for entry in self._desk.tables(self._kind)}:
                self._shell.message(_("Not compared"), [_("there is no table named {name!r}").format(name=other)])
                return
            lines = differences(self._desk, self._kind, name, other)
            self._shell.message(_("Differences"), lines or [_("none: they are alike")])

        self._shell.ask_text(_("Compare"), _("{name} with:").format(name=name), "", accept)

    def diff(self, name: str, text: str) -> None:
        """Against the shipped table."""
        lines = self._desk.diff(self._kind, name, text)
        self._shell.message(_("Differences"), lines or [_("none: this is the shipped table")])

    def copy(self, name: str, then: Callable[[str], None]) -> None:
        """Asks for the new name, which ``then`` is given."""

        def accept(new_name: str) -> None:
            if not self._refused(_("Not copied"), self._desk.copy(self._kind, name, new_name)):
                then(new_name)

        self._shell.ask_text(_("Copy"), _("New name:"), f"my-{name}", accept)

    def drive(self, machine: str) -> None:
        """The machine starts anew, with the tables as they are saved. Refused while something moves."""
        self._refused(_("Not loaded"), self._console.choose_machine(machine))

    def _refused(self, title: str, problems: Problems) -> bool:
        if problems:
            self._shell.message(title, [told(problem) for problem in problems])
        return bool(problems)
