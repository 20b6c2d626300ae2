"""One TOML file as text and as checked records, able to say on which line a fault stands.

Rule: nothing leaves here unchecked in shape; what the values mean is checked by the reader that asked.
Called by phase.py, ramp.py, motor.py and config.py.
"""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import msgspec

from drillctl.machine.errors import TableError

LARGEST_TABLE_BYTES = 256 * 1024
RecordT = TypeVar("RecordT", bound=msgspec.Struct)

_HEADER = re.compile(r"\s*\[\[?\s*([^\]]+?)\s*\]")
_KEY = re.compile(r"\s*(?:\"([^\"]+)\"|([A-Za-z0-9_-]+))\s*=")
_AT = re.compile(r"(.*?) - at `\$\.?(.*)`$", re.S)
_TOML_LINE = re.compile(r"(.*) \(at line (\d+), column \d+\)$")


@dataclass(frozen=True, slots=True)
class Source:
    """A table file: its path and its text."""

    file: Path
    text: str

    @classmethod
    def read(cls, file: Path) -> "Source":
        """Reads a file. Raises TableError where it can't be opened, is too large or is not UTF-8."""
        try:
            if file.stat().st_size > LARGEST_TABLE_BYTES:
                raise TableError(file, f"larger than {LARGEST_TABLE_BYTES // 1024} KiB: not a table")
            return cls(file, file.read_text("utf-8"))
        except OSError as error:
            raise TableError(file, f"can't be read: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise TableError(file, "not UTF-8 text, so not a table") from error

    def records(self, shape: type[RecordT]) -> RecordT:
        """The file as a record of the given shape. Raises TableError for bad TOML, unknown keys, wrong types."""
        try:
            return msgspec.convert(tomllib.loads(self.text), shape)
        except tomllib.TOMLDecodeError as error:
            found = _TOML_LINE.match(str(error))
            reason, line = (found[1], int(found[2])) if found else (str(error), None)
            raise TableError(self.file, f"not TOML: {reason}", line) from error
        except msgspec.ValidationError as error:
            raise self._shape_error(str(error)) from error

    def error(self, reason: str, *place: str | int) -> TableError:
        """A TableError at a place such as ``"state", 2, "brake"``: the key in the third ``[[state]]``."""
        return TableError(self.file, reason, self.line_of(*place))

    def line_of(self, *place: str | int) -> int | None:
        """The line, from 1, where a place stands; the nearest enclosing header where the key is not written."""
        index = next((part for part in place if isinstance(part, int)), 0)
        names = [part for part in place if isinstance(part, str)]
        header, seen, best = "", -1, None
        for number, line in enumerate(self.text.splitlines(), start=1):
            if found := _HEADER.match(line):
                header = found[1]
                seen += header == names[0]
                if header == names[0] and seen == index:
                    best = number
            elif found := _KEY.match(line):
                key = found[1] or found[2]
                if names == [key] and not header:
                    return number
                if header == names[0] and seen == index and key == names[-1]:
                    return number
        return best

    def _shape_error(self, message: str) -> TableError:
        found = _AT.match(message)
        reason, path = (found[1], found[2]) if found else (message, "")
        place = [int(p) if p.isdigit() else p for p in re.split(r"[.\[\]]+", path) if p and p != "..."]
        unknown = re.search(r"unknown field `(.+)`", reason)
        line = self.line_of(*place, *([unknown[1]] if unknown else [])) if place or unknown else None
        where = f"{path}: " if path else ""
        return TableError(self.file, f"{where}{reason[:1].lower()}{reason[1:].replace('`', '')}", line)
