"""What text editors share: undo and redo of any value, and what Tab makes of a half-written command.

Rule: a new state after an undo ends what could be redone; a completion looks at what is left of the cursor only.
"""

from collections.abc import Sequence
from itertools import takewhile
from typing import Generic, TypeVar

from drillctl.language.words import translated
from drillctl.viewmodel.tables import CommandHelp

MOST_STATES = 500
StateT = TypeVar("StateT")


class History(Generic[StateT]):
    """The states that a value went through; ``now`` is the one on the screen."""

    def __init__(self, first: StateT):
        self._states, self._at = [first], 0

    @property
    def now(self) -> StateT:
        """The state that is shown at present."""
        return self._states[self._at]

    def do(self, state: StateT) -> None:
        """Adds a new state; the same state again is no step. The oldest is forgotten when there are too many."""
        if state == self.now:
            return
        self._states = [*self._states[: self._at + 1], state][-MOST_STATES:]
        self._at = len(self._states) - 1

    def undo(self) -> bool:
        """Goes one state back; False at the first one."""
        return self._move(-1)

    def redo(self) -> bool:
        """Goes one state forward again; False at the last one."""
        return self._move(1)

    def _move(self, by: int) -> bool:
        if not 0 <= self._at + by < len(self._states):
            return False
        self._at += by
        return True


class Undoable(Generic[StateT]):
    """A screen or a model whose states are kept in ``_history``. A subclass makes the history and adds its states;
    ``_restore`` takes the state that was gone back to.
    """

    _history: History[StateT]

    def undo(self) -> None:
        """Takes the last change back; at the first state nothing happens."""
        if self._history.undo():
            self._restore()

    def redo(self) -> None:
        """Makes the change again that was undone last; where there is none nothing happens."""
        if self._history.redo():
            self._restore()

    def _restore(self) -> None:
        raise NotImplementedError  # by whatever can be undone


def completed(before: str, commands: Sequence[CommandHelp], words: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The line before the cursor with its last word completed, and what that may become where several begin alike.

    A single fit is completed whole and followed by a space; several as far as they agree. Case is put right.
    """
    before_word, space, started = before.rpartition(" ")
    names = words if before_word.strip() else [command.name for command in commands]
    fits = sorted({name for name in names if name.lower().startswith(started.lower())})
    if not fits:
        return before, ()
    if len(fits) == 1:
        return f"{before_word}{space}{fits[0]} ", ()
    common = _beginning(fits)
    return f"{before_word}{space}{common if len(common) > len(started) else started}", tuple(fits)


def _beginning(names: Sequence[str]) -> str:
    """The letters with which all the names begin."""
    alike = takewhile(lambda letters: len(set(letters)) == 1, zip(*names, strict=False))
    return "".join(letters[0] for letters in alike)


def usage(line: str, commands: Sequence[CommandHelp]) -> str:
    """How the command of a line is written and what it does; an empty text for no command."""
    name = line.split(maxsplit=1)[:1]
    found = next((command for command in commands if [command.name] == name), None)
    return f"{written(found)}: {translated(found.meaning)}" if found else ""


def written(command: CommandHelp) -> str:
    """How a command is written: its name, then its arguments in the operator's language."""
    return f"{command.name} {translated(command.usage)}".strip()
