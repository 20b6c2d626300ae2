"""Undo and redo of any value. Rule: a new state after an undo ends what could be redone. Used by every editor."""

from typing import Generic, TypeVar

MOST_STATES = 500
StateT = TypeVar("StateT")


class History(Generic[StateT]):
    """The states that a value went through; ``now`` is the one on the screen."""

    def __init__(self, first: StateT):
        self._states, self._at = [first], 0

    @property
    def now(self) -> StateT:
        """The state that is shown."""
        return self._states[self._at]

    def do(self, state: StateT) -> None:
        """A new state; the same one again is no step. The oldest is forgotten when there are too many."""
        if state == self.now:
            return
        self._states = [*self._states[: self._at + 1], state][-MOST_STATES:]
        self._at = len(self._states) - 1

    def undo(self) -> bool:
        """One state back; False at the first one."""
        return self._move(-1)

    def redo(self) -> bool:
        """One state forward again; False at the last one."""
        return self._move(1)

    def _move(self, by: int) -> bool:
        if not 0 <= self._at + by < len(self._states):
            return False
        self._at += by
        return True
