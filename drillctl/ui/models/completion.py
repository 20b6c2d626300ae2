"""What Tab makes of a half-written command. Rule: only what is left of the cursor counts. Used by the queue editor."""

from collections.abc import Sequence
from itertools import takewhile

from drillctl.viewmodel.queues import CommandHelp


def completed(before: str, commands: Sequence[CommandHelp], words: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The line before the cursor with its last word completed, and what that may become where several begin alike.

    A single fit is completed whole and followed by a space; several as far as they agree. Case is put right.
    """
    kept, space, started = before.rpartition(" ")
    names = words if kept.strip() else [command.name for command in commands]
    fits = sorted({name for name in names if name.lower().startswith(started.lower())})
    if not fits:
        return before, ()
    if len(fits) == 1:
        return f"{kept}{space}{fits[0]} ", ()
    common = _beginning(fits)
    return f"{kept}{space}{common if len(common) > len(started) else started}", tuple(fits)


def _beginning(names: Sequence[str]) -> str:
    """As far as all agree."""
    alike = takewhile(lambda letters: len(set(letters)) == 1, zip(*names, strict=False))
    return "".join(letters[0] for letters in alike)


def usage(line: str, commands: Sequence[CommandHelp]) -> str:
    """How the command of a line is written and what it does; empty for none."""
    name = line.split(maxsplit=1)[:1]
    found = next((command for command in commands if [command.name] == name), None)
    return f"{found.name} {found.usage}".strip() + f": {found.meaning}" if found else ""
