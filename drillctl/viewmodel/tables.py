"""What the editors of tables and queues may see and ask: texts, what is wrong with them, what can be drawn of them.

Rule: as console.py has it: nothing raises for what a person did. A table is its text; an edit is a new text, and
nothing reaches a file before ``save`` has found it sound. Edits go to the user's own folder, never to the shipped one.
"""

from collections.abc import Sequence
from typing import Literal, Protocol

import msgspec

from drillctl.language import Message
from drillctl.viewmodel.console import Problems

TableKind = Literal["phase", "ramp", "motor", "machines"]
FieldPath = tuple[str | int, ...]


class TableEntry(msgspec.Struct, frozen=True):
    """A table that can be opened. ``origin``: shipped, yours (a copy that wins), or other (a folder named first).

    ``ships``: one of this name comes with the program, to go back to. ``in_use``: the machine at hand is driven by it,
    ``motors`` are those of its axes that have this table.
    """

    name: str
    origin: str
    ships: bool = True
    in_use: bool = False
    motors: tuple[str, ...] = ()


class TextFinding(msgspec.Struct, frozen=True):
    """Something about a text: its line from 1 (None: the whole), its column from 1 where one is known."""

    line: int | None
    text: Message
    column: int | None = None

    @property
    def message(self) -> Message:
        """The text with its place before it: ``LINE:COLUMN: ``, as much of it as is known."""
        if self.line is None:
            return self.text
        if self.column is None:
            return Message("{line}: {reason}", line=self.line, reason=self.text)
        return Message("{line}:{column}: {reason}", line=self.line, column=self.column, reason=self.text)


class Checked(msgspec.Struct, frozen=True):
    """What a check found. Problems forbid saving; warnings are for a valid but dangerous table."""

    problems: tuple[TextFinding, ...] = ()
    warnings: tuple[TextFinding, ...] = ()


class PhaseRow(msgspec.Struct, frozen=True):
    """A wire of a phase table: ``x`` on, ``.`` off; ``reverse`` is its row for motion backwards, None for the same."""

    name: str
    volts: float
    pattern: str
    reverse: str | None = None


class StateRow(msgspec.Struct, frozen=True):
    """A state of a ramp as its file has it, and what stopping from it takes (None while the ramp is unsound)."""

    state: int
    accelerate: int
    brake: int
    interval: int
    stop_steps: int | None = None
    stop_ticks: int | None = None


class RampDrawing(msgspec.Struct, frozen=True):
    """The states from -n to n, and the ticks before each step of a long move (none while the ramp is unsound)."""

    states: tuple[StateRow, ...]
    intervals: tuple[int, ...] = ()


class FieldView(msgspec.Struct, frozen=True):
    """One value of a machine's file: its place there, its axis ("" for none), as text, and what it may be."""

    place: FieldPath
    axis: str
    value: str
    choices: tuple[str, ...] = ()
    bounds: str = ""  # such as "1..100000"
    locked: bool = False  # in the file, by whoever keeps it


class RowEditing(Protocol):
    """Phase tables and ramps as rows: read from a text, or changed in it."""

    def phase_rows(self, text: str) -> tuple[PhaseRow, ...]:
        """The wires of a phase table; none for a text that is no phase table."""

    def with_phase_rows(self, text: str, rows: Sequence[PhaseRow]) -> str:
        """The text with these patterns; its wires are the same."""

    def ramp(self, text: str) -> RampDrawing:
        """The ramp of a text; no states for a text that is no ramp."""

    def with_state(self, text: str, state: int, field: str, value: int) -> str:
        """The text with one number of a state changed: accelerate, brake or interval."""

    def with_top(self, text: str, higher: bool) -> str:
        """The text with a pair of states more, numbers proposed, or with its outermost pair less; a ramp keeps three
        states. The same text where that can't be.
        """


class TableEditing(Protocol):
    """Tables as screens edit them. What takes a text draws or changes that text; files change by save and reset."""

    @property
    def rows(self) -> RowEditing:
        """What reads and changes single rows of a text."""

    def tables(self, kind: TableKind) -> Sequence[TableEntry]:
        """All tables of a kind, sorted by name."""

    def users(self, kind: TableKind, name: str) -> Sequence[tuple[str, tuple[str, ...]]]:
        """The machines that have a table, each with its motors that have it. Reads every machine's file."""

    def effects(self, before: str, after: str) -> Sequence[Message]:
        """What becomes of a machine with another text of its file, a sentence each; none where one can't be read."""

    def read(self, kind: TableKind, name: str) -> str:
        """The text that is in force; empty where the file can't be read, which ``check`` then tells."""

    def check(self, kind: TableKind, text: str) -> Checked:
        """Problems and warnings of a text."""

    def save(self, kind: TableKind, name: str, text: str) -> Problems:
        """Saves to the user's own copy, whole or not at all; an invalid text is refused."""

    def reset(self, kind: TableKind, name: str) -> Problems:
        """Removes the user's copy; the shipped table is in force again."""

    def delete(self, kind: TableKind, name: str) -> Problems:
        """Deletes a table of the user's own that does not come with the program, for good."""

    def diff(self, kind: TableKind, name: str, text: str) -> tuple[str, ...]:
        """The lines of a unified difference from the shipped table to this text; none where they are the same."""

    def copy(self, kind: TableKind, name: str, new_name: str) -> Problems:
        """Copies a table to one of the user's own, under a name that is free."""

    def fields(self, text: str) -> tuple[FieldView, ...]:
        """What can be configured in a machine's text; none for a text that is no machine."""

    def wires(self, text: str) -> tuple[FieldView, ...]:
        """The output bit of every motor's wire in a machine's text; none for a text that is no machine."""

    def with_field(self, text: str, place: FieldPath, typed: str) -> tuple[str, Problems]:
        """The text with what was typed at a place; the same text and the reason where it can't be."""


class CommandHelp(msgspec.Struct, frozen=True):
    """A command: its name, how its arguments are written, and what it does."""

    name: str
    usage: str
    meaning: str


class QueueEditing(Protocol):
    """Reads, checks and saves queues of commands as text."""

    def commands(self) -> Sequence[CommandHelp]:
        """All commands, in the order of the reference."""

    def words(self) -> Sequence[str]:
        """What may stand behind a command on this machine: names of axes, outputs and sensors."""

    def check_queue(self, text: str) -> tuple[TextFinding, ...]:
        """What is wrong, line by line, each with its column; none for a queue that can run."""

    def too_far(self, text: str) -> tuple[TextFinding, ...]:
        """The moves of a sound queue that end beyond the range wherever they begin: each will be a fault."""

    def open_queue(self, file: str) -> tuple[str, Problems]:
        """The text of a file; empty, with the reason, where it can't be read."""

    def save_queue(self, file: str, text: str) -> Problems:
        """Saves a queue to a file, whole or not at all."""
