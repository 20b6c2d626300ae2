"""Tables as the screens' editors see them (viewmodel/tables.py).

Rule: a text is checked by the same readers that load it; a file changes whole or not at all, and only the user's own.
"""

import difflib
from collections.abc import Callable
from pathlib import Path

from drillctl.console.effects import effects
from drillctl.console.table_rows import TableRows, source_of
from drillctl.console.table_users import used_tables, users
from drillctl.console.views import field_view
from drillctl.files.outputs import write_text
from drillctl.language import Message, message_of
from drillctl.machine import Library, Machine, TableError, shipped_tables
from drillctl.machine.edit import set_value
from drillctl.machine.phase import NAME, parse_phase
from drillctl.machine.positions import Place
from drillctl.machine.settings import Setting, settings, wire_settings
from drillctl.machine.source import Source
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import Checked, FieldView, TableEntry, TableKind, TextFinding

# What makes a text a table of its kind: a key that only this kind has.
KEY_OF: dict[TableKind, tuple[str, ...]] = {
    "phase": ("wire",),
    "ramp": ("state", "computed"),
    "motor": ("windings", "pulse"),
    "machines": ("axis",),
}
LONGEST_NAME = 40
TABLES_OF_A_MOTOR = ("phase", "ramp")  # keys of an axis that name a table


class TableFiles:
    """A TableEditing over ``library``; edits go to ``user_folder``, which is one of the library's folders. ``machine``
    returns the machine in use, None for none.
    """

    def __init__(self, library: Library, user_folder: Path, machine: Callable[[], Machine | None] = lambda: None):
        self._library, self._user_folder, self._machine = library, user_folder, machine
        self.rows = TableRows(lambda text: not self.check("ramp", text).problems)

    def tables(self, kind: TableKind) -> list[TableEntry]:
        """All tables of a kind, by name: where each comes from, and whether the machine in use has it."""
        used = used_tables(kind, self._machine())
        return [
            TableEntry(
                name, self._origin(kind, name), self._shipped(kind, name).is_file(), name in used, used.get(name, ())
            )
            for name in self._library.names(kind)
        ]

    def users(self, kind: TableKind, name: str) -> list[tuple[str, tuple[str, ...]]]:
        """Every machine of the library that can be read and has the table, with the motors that have it."""
        return users(self._library, kind, name)

    def effects(self, before: str, after: str) -> list[Message]:
        """What differs between the machines of two texts (effects.py); none where one of them can't be read."""
        own = self._own("machines", "unsaved")
        try:
            was, will_be = (self._library.machine_of(Source(own, text)) for text in (before, after))
        except TableError:
            return []
        return effects(was, will_be)

    def read(self, kind: TableKind, name: str) -> str:
        """The text of a table, from the first folder that has it; empty where it can't be read."""
        file = self._library.find(kind, name)
        try:
            return Source.read(file).text if file else ""
        except TableError:
            return ""

    def check(self, kind: TableKind, text: str) -> Checked:
        """Errors and warnings of a text, from the readers that load tables."""
        return self._check(kind, Source(self._own(kind, "unsaved"), text))

    def save(self, kind: TableKind, name: str, text: str) -> Problems:
        """Writes a sound text to the user's folder. Refused where an earlier folder has that name: it would win."""
        own = self._own(kind, name)
        if problems := self._check(kind, Source(own, text)).problems:
            return tuple(problem.message for problem in problems)
        found = self._library.find(kind, name)
        if found is not None and self._origin(kind, name) == "other":
            return (
                Message(
                    "{file} is looked at before your own copy; change it there, or start without that folder",
                    file=found,
                ),
            )
        return write_text(own, text)

    def reset(self, kind: TableKind, name: str) -> Problems:
        """Deletes the user's copy of a table, where there is a shipped one to go back to."""
        own = self._own(kind, name)
        if not own.is_file():
            return (Message("there is no copy of your own to take away"),)
        if not self._shipped(kind, name).is_file():
            return (Message("{name} does not come with the program; there is nothing to go back to", name=name),)
        return _unlinked(own)

    def delete(self, kind: TableKind, name: str) -> Problems:
        """Deletes a table of the user's own; one that comes with the program is reset instead."""
        if self._shipped(kind, name).is_file():
            return (Message("{name} comes with the program and stays; your own copy goes by a reset", name=name),)
        if self._origin(kind, name) != "yours":
            return (Message("not in your own folder; it is not deleted from here").at(self._library.find(kind, name)),)
        return _unlinked(self._own(kind, name))

    def diff(self, kind: TableKind, name: str, text: str) -> tuple[str, ...]:
        """The lines of a unified diff from the shipped table; from an empty file where there is none."""
        shipped = self._shipped(kind, name)
        before = Source.read(shipped).text if shipped.is_file() else ""
        names = (f"shipped {name}", f"this {name}")
        return tuple(difflib.unified_diff(before.splitlines(), text.splitlines(), *names, lineterm=""))

    def copy(self, kind: TableKind, name: str, new_name: str) -> Problems:
        """Saves a table under another name, which stands in its text as well."""
        if not NAME.fullmatch(new_name) or len(new_name) > LONGEST_NAME:
            return (
                Message("a name is at most {most} letters, digits, - and _, no - or _ first", most=LONGEST_NAME).at(
                    repr(new_name)
                ),
            )
        if self._library.find(kind, new_name) is not None:
            return (Message("there is a table named {name} already", name=new_name),)
        try:
            return self.save(kind, new_name, set_value(self.read(kind, name), ("name",), new_name))
        except TableError as error:
            return error.messages

    def fields(self, text: str) -> tuple[FieldView, ...]:
        """The settings of a machine's file, in the order of the paper's screen; none where they can't be read."""
        try:
            return tuple(map(self._field_view, settings(source_of(text))))
        except TableError:
            return ()

    def wires(self, text: str) -> tuple[FieldView, ...]:
        """The bits of a machine's wires, in the order of its file; none where they can't be read."""
        try:
            return tuple(map(self._field_view, wire_settings(source_of(text))))
        except TableError:
            return ()

    def with_field(self, text: str, place: Place, typed: str) -> tuple[str, Problems]:
        """The text with a field set as typed, or as it was and why not. Comments, layout and hexadecimal stay."""
        try:
            source = source_of(text)
            fields = (*settings(source), *wire_settings(source))
            setting = next(setting for setting in fields if setting.place == place)
            if setting.locked:
                return text, (_locked(source, setting),)
            return set_value(text, place, setting.parsed(typed)), ()
        except (TableError, ValueError) as error:
            return text, (message_of(error),)

    def _field_view(self, setting: Setting) -> FieldView:
        choices = self._tables_for(setting) if setting.key in TABLES_OF_A_MOTOR else setting.choices
        return field_view(setting, choices)

    def _tables_for(self, setting: Setting) -> tuple[str, ...]:
        """The tables that a motor may have in place of its own: every ramp, and phase tables of the same wires."""
        names = self._library.names(setting.key)
        wires = {name: self._wire_names(name) for name in names} if setting.key == "phase" else {}
        own = wires.get(str(setting.value))
        return tuple(name for name in names if wires.get(name) == own)

    def _wire_names(self, phase: str) -> frozenset[str] | None:
        """None for a table that can't be read."""
        file = self._library.find("phase", phase)
        try:
            return frozenset(parse_phase(Source.read(file)).wire_names()) if file else None
        except TableError:
            return None

    def _check(self, kind: TableKind, source: Source) -> Checked:
        try:
            if not set(KEY_OF[kind]) & source.tree().keys():
                return Checked(
                    (
                        TextFinding(
                            None, Message("[{section}] is missing: not a table of this kind", section=KEY_OF[kind][0])
                        ),
                    )
                )
            return Checked((), tuple(TextFinding(None, hazard) for hazard in self._library.check_source(source)))
        except TableError as error:
            ours = error.file == str(source.file)
            return Checked((TextFinding(error.line, error.reason) if ours else TextFinding(None, error.message),))

    def _origin(self, kind: TableKind, name: str) -> str:
        places = {self._own(kind, name): "yours", self._shipped(kind, name): "shipped"}
        found = self._library.find(kind, name)
        return places.get(found, "other") if found else "other"

    def _own(self, kind: TableKind, name: str) -> Path:
        return self._user_folder / kind / f"{name}.toml"

    def _shipped(self, kind: TableKind, name: str) -> Path:
        return shipped_tables() / kind / f"{name}.toml"


def _unlinked(own: Path) -> Problems:
    try:
        own.unlink()
    except OSError as error:
        return (Message("can't be taken away: {why}", why=message_of(error)).at(own),)
    return ()


def _locked(source: Source, setting: Setting) -> Message:
    line = source.line_of("locked")
    return Message(
        "{field} is locked in line {line} of the machine's file; it can be unlocked only there",
        field=setting.key,
        line=line,
    )
