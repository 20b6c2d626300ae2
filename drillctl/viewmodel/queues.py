"""What the queue editor may see and ask: the commands there are, what is wrong with a queue, and its files.

Rule: as console.py has it: nothing raises for what a person did.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.tables import Finding


@dataclass(frozen=True, slots=True)
class CommandHelp:
    """A command: its name, how its arguments are written, what it does."""

    name: str
    usage: str
    meaning: str


class QueueEditing(Protocol):
    """Queues of commands as text."""

    def commands(self) -> Sequence[CommandHelp]:
        """All commands, in the order of the reference."""

    def words(self) -> Sequence[str]:
        """What may stand behind a command on this machine: names of axes, outputs and sensors."""

    def check_queue(self, text: str) -> tuple[Finding, ...]:
        """What is wrong, line by line, each with its column; none for a queue that can run."""

    def too_far(self, text: str) -> tuple[Finding, ...]:
        """The moves of a sound queue that end beyond the range wherever they begin: each will be a fault."""

    def open_queue(self, file: str) -> tuple[str, Problems]:
        """The text of a file; empty, with the reason, where it can't be read."""

    def save_queue(self, file: str, text: str) -> Problems:
        """To a file, whole or not at all."""
