"""The error of every reader in this room; nothing is loaded when it is raised."""

from pathlib import Path

from drillctl.language import Message, Refusal


class TableError(Refusal):
    """A table that can't be used. ``str()`` is one line: ``FILE:LINE: reason`` (LINE where one is known)."""

    kind = "table"

    def __init__(self, file: Path | str, reason: Message, line: int | None = None):
        self.file, self.reason, self.line = str(file), reason, line
        super().__init__(reason.at(file, line))
