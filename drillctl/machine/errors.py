"""The error of every reader in this room; nothing is loaded when it is raised."""

from pathlib import Path


class TableError(Exception):
    """A table that can't be used. ``str()`` is one line: ``FILE:LINE: reason`` (LINE where one is known)."""

    def __init__(self, file: Path | str, reason: str, line: int | None = None):
        self.file, self.reason, self.line = str(file), reason, line
        place = f"{file}:{line}" if line else f"{file}"
        super().__init__(f"{place}: {reason}")
