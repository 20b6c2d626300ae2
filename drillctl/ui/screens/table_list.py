"""The tables of one kind: choose one to edit, or copy it. Rule: says of each whose it is, and whether it is in use."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import urwid

from drillctl.language.words import N_, _
from drillctl.ui.screens.configuration import ConfigurationScreen
from drillctl.ui.screens.own_steps import LIST_STEPS
from drillctl.ui.screens.phase_editor import PhaseEditor
from drillctl.ui.screens.ramp_editor import RampEditor
from drillctl.ui.screens.shell import Shell, unsaved
from drillctl.ui.screens.table_actions import TableActions
from drillctl.ui.screens.table_editor import ORIGINS, Size
from drillctl.ui.widgets.folding import folded
from drillctl.ui.widgets.keys import Key, called
from drillctl.ui.widgets.panel import BORDER_COLUMNS, panel_columns, with_panel
from drillctl.ui.widgets.texts import Icon, Line
from drillctl.viewmodel.bench import Bench
from drillctl.viewmodel.console import Console
from drillctl.viewmodel.tables import TableEditing, TableEntry, TableKind

Editor = Callable[[Console, Shell, TableEditing, str, bool, Bench | None], urwid.Widget]
EDITORS: Mapping[TableKind, Editor] = {"phase": PhaseEditor, "ramp": RampEditor, "machines": ConfigurationScreen}
TITLES: Mapping[TableKind, str] = {
    "phase": N_("Phase tables"),
    "ramp": N_("Ramps"),
    "machines": N_("Machines"),
}
ORIGIN_COLUMNS = 34  # with the motors


class TableList(urwid.WidgetWrap[urwid.Widget]):
    """The list of the tables of one kind."""

    own_steps = LIST_STEPS
    keys = (
        Key(("enter",), "Enter", "edit", N_("opens the table"), N_("Open")),
        Key(("f7",), "F7", "copy", N_("copies the table under another name"), N_("Copy")),
        Key(("f3",), "F3", "compare", N_("what differs between this table and another"), N_("Differences")),
        Key(("f8",), "F8", "reset", N_("takes your own copy away: the shipped table is in force again"), N_("Reset")),
        Key(("delete",), "Del", "delete", N_("deletes a table of your own that was never shipped"), N_("Delete")),
    )

    def __init__(
        self, console: Console, shell: Shell, tables: TableEditing, kind: TableKind, plain: bool = False,
        bench: Bench | None = None,
    ):  # fmt: skip
        self._bench = bench
        self._console, self._shell, self._tables, self._plain = console, shell, tables, plain
        self._actions = TableActions(console, shell, tables, kind)
        self.kind, self.title = kind, TITLES[kind]
        self._editors: dict[str, urwid.Widget] = {}
        self._rows: urwid.SimpleFocusListWalker[Any] = urwid.SimpleFocusListWalker([])
        self._list = urwid.ListBox(self._rows)
        super().__init__(self._list)
        self.fill()

    def keypress(self, size: Size, key: str) -> str | None:
        """Calls the method of a key in the table; the list handles the others."""
        return None if called(self, self.keys, key) else super().keypress(self._left(size), key)

    def mouse_event(self, size: Size, event: str, button: int, col: int, row: int, focus: bool) -> bool | None:
        """Hands an event to the list, unless it is on the panel."""
        left = self._left(size)
        return super().mouse_event(left, event, button, col, row, focus) if col < left[0] else False

    def render(self, size: Size, focus: bool = False) -> urwid.Canvas:
        """Draws the list, filled anew if a table was saved meanwhile, and the table under the cursor beside it."""
        if [*self._tables.tables(self.kind)] != self._entries:
            self.fill()
        left, rows = self._left(size)
        assert len(size) == 2
        beside = size[0] - left
        name = self._current if self._entries and beside else ""
        lines = self._about(name, beside - BORDER_COLUMNS) if name else []
        return with_panel(super().render((left, rows), focus), name, lines, beside, rows)

    def fill(self) -> None:
        """Fills the list anew; the cursor stays, and is at first on a table in use."""
        self._entries = [*self._tables.tables(self.kind)]
        self._texts: dict[str, list[Line]] = {}
        in_use = (row for row, entry in enumerate(self._entries) if entry.in_use)
        at = self._list.focus_position if self._rows else next(in_use, 0)
        lines = [_line(entry, self._name_columns) for entry in self._entries]
        self._rows[:] = [urwid.AttrMap(Icon(line, 0), "body", "focus") for line in lines]
        if lines:
            self._list.set_focus(min(at, len(lines) - 1))

    def edit(self) -> None:
        """Opens the editor of the table's kind; one that was left with something unsaved comes back as it was."""
        if not self._entries:
            return
        name = self._current
        if not unsaved(self._editors.get(name)):
            editor = EDITORS[self.kind]
            self._editors[name] = editor(self._console, self._shell, self._tables, name, self._plain, self._bench)
        self._shell.open(self._editors[name])

    def copy(self) -> None:
        """Asks for a name and copies the table."""
        if self._entries:
            self._actions.copy(self._current, lambda _name: self.fill())

    def compare(self) -> None:
        """Asks for another table and shows what differs."""
        if self._entries:
            self._actions.compare(self._current)

    def reset(self) -> None:
        """Asks, then goes back to the shipped table."""
        if self._entries:
            self._actions.reset(self._current, self.fill)

    def delete(self) -> None:
        """Asks, then deletes a table of the user's own."""
        if self._entries:
            self._actions.delete(self._current, self.fill)

    def _left(self, size: Size) -> tuple[int, int]:
        """The size of the list beside its panel."""
        assert len(size) == 2
        return size[0] - panel_columns(size[0], self._name_columns + ORIGIN_COLUMNS), size[1]

    def _about(self, name: str, columns: int) -> list[Line]:
        """The lines of the panel: the motors of all machines that have the table, then the table as it is written."""
        if name not in self._texts:
            users = [] if self.kind == "machines" else self._tables.users(self.kind, name)
            motors = [f"{machine}: {', '.join(map(str.upper, axes))}" for machine, axes in users]
            heading = _("Motors with this table") if motors else _("No motor of any machine has this table.")
            heading_lines: list[Line] = [[("title", heading)], *_each(motors), [""]] if self.kind != "machines" else []
            self._texts[name] = [*heading_lines, *_each(self._tables.read(self.kind, name).splitlines())]
        return folded(self._texts[name], columns)

    @property
    def _name_columns(self) -> int:
        return max((len(entry.name) for entry in self._entries), default=0) + 2

    @property
    def _current(self) -> str:
        return self._entries[self._list.focus_position].name


def _line(entry: TableEntry, name_columns: int) -> str:
    """The line of a table: a sign and a word if it is in use, its name, and whose it is."""
    sign, word = ("*", _(", in use")) if entry.in_use else (" ", "")
    if entry.motors:
        word = _(", in use: {motors}").format(motors=" ".join(map(str.upper, entry.motors)))
    return f"{sign} {entry.name:{name_columns}}{_(ORIGINS[entry.origin])}{word}"


def _each(texts: Iterable[str]) -> list[Line]:
    """A line for each text; comments of a table darker."""
    return [[("dark" if text.startswith("#") else "body", text)] for text in texts]
