"""One TOML file as text and as checked records, which knows the line of a fault.

Rule: only data of the right shape leaves here; what the values mean is checked by the reader that asked.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from drillctl.files.inputs import read_bytes, toml_of
from drillctl.language import Message, message_of, verbatim
from drillctl.language.words import N_
from drillctl.machine.errors import TableError
from drillctl.machine.positions import key_lines

LARGEST_TABLE_BYTES = 1024 * 1024  # a ramp of 4096 states, each both ways in rows of its own, has 0.7 MB
Value = str | int | float
RecordT = TypeVar("RecordT", bound=msgspec.Struct)

_AT = re.compile(r"(.*?) - at `\$\.?(.*)`$", re.S)
_TOML_LINE = re.compile(r"(.*) \(at (?:line (\d+), column \d+|end of document)\)$", re.S)
_UNKNOWN = re.compile(r"Object contains unknown field `(.+)`", re.S)
# Sentences of msgspec, which has no codes, and the templates that say the same to an instructor.
_PLAINLY = (
    (re.compile(r"Object contains unknown field `(?P<name>.+)`", re.S), N_("unknown key {name}")),
    (re.compile(r"Object missing required field `(?P<name>.+)`"), N_("{name} is missing")),
    (re.compile(r"Expected `str` matching regex .*", re.S), N_("a name is letters, digits, - and _, no - or _ first")),
    (re.compile(r"Expected `(?P<wanted>.+)`, got `(?P<found>.+)`", re.S), N_("expected {wanted}, got {found}")),
    (re.compile(r"Expected (?P<wanted>.+)", re.S), N_("expected {wanted}")),
    (re.compile(r"Invalid enum value (?P<value>.+)", re.S), N_("invalid enum value {value}")),
)


@dataclass(frozen=True, slots=True)
class Source:
    """A table file: its path and its text."""

    file: Path
    text: str

    @classmethod
    def read(cls, file: Path) -> "Source":
        """Reads a file. Raises TableError where it can't be opened, is too large or is not UTF-8."""
        try:
            data = read_bytes(file, LARGEST_TABLE_BYTES, Message("a table"))
        except OSError as error:
            raise TableError(file, Message("can't be read: {why}", why=message_of(error))) from error
        try:
            return cls(file, data.decode("utf-8-sig"))
        except UnicodeDecodeError as error:
            line = data.count(b"\n", 0, error.start) + 1
            raise TableError(file, Message("not UTF-8 text, so not a table"), line) from error

    def tree(self) -> dict[str, Any]:
        """Returns the file as plain tables, lists and values. Raises TableError for what is not TOML."""
        try:
            return toml_of(self.text)
        except tomllib.TOMLDecodeError as error:
            found = _TOML_LINE.match(str(error))
            reason = found[1] if found else str(error)
            line = int(found[2] or self.text.count("\n") + 1) if found else None
            raise TableError(self.file, Message("not TOML: {reason}", reason=reason), line) from error
        except ValueError as error:
            raise TableError(self.file, message_of(error)) from error

    def records(self, shape: type[RecordT]) -> RecordT:
        """Returns the file as a record of the given shape. Raises TableError for bad TOML, unknown
        keys, wrong types.
        """
        try:
            return msgspec.convert(self.tree(), shape)
        except msgspec.ValidationError as error:
            raise self._shape_error(str(error)) from error

    def numbers(self, table: Mapping[str, Any], kind: Any, *place: str) -> dict[str, int]:
        """Returns a table of free keys, each value checked to be of ``kind``. Raises TableError on
        the line of its key.
        """
        checked = {}
        for key, value in table.items():
            try:
                checked[key] = msgspec.convert(value, kind)
            except msgspec.ValidationError as error:
                raise self.error(
                    plainly(str(error)).at(f'"{key}"').at(place[-1]),
                    *place,
                    key,
                ) from error
        return checked

    def error(self, reason: Message, *place: str | int) -> TableError:
        """Returns a TableError at a place such as ``"state", 2, "brake"``: the key in the third ``[[state]]``."""
        return TableError(self.file, reason, self.line_of(*place))

    def line_of(self, *place: str | int) -> int | None:
        """Returns the line, from 1, of a place of this valid TOML text.

        Where its key is not written: that of the nearest table around it, None where there is none.
        """
        lines = key_lines(self.text)
        outer = (place[:length] for length in range(len(place), 0, -1))
        return next((lines[found] for found in outer if found in lines), None)

    def _shape_error(self, message: str) -> TableError:
        reason, path = _divided(message)
        place = [int(p) if p.isdigit() else p for p in re.split(r"[.\[\]]+", path) if p and p != "..."]
        unknown = _UNKNOWN.search(reason)
        line = self.line_of(*place, *([unknown[1]] if unknown else [])) if place or unknown else None
        return TableError(self.file, plainly(message), line)


def plainly(sentence: str) -> Message:
    """Returns what msgspec says as a message, with the place that it names. What no pattern knows is left as it is,
    from a small letter on.
    """
    reason, place = _divided(sentence)
    return _said(reason).at(place) if place else _said(reason)


def _divided(sentence: str) -> tuple[str, str]:
    """What is wrong, and where: ``axis[0].range``; empty where it is the whole."""
    found = _AT.match(sentence)
    return (found[1], found[2]) if found else (sentence, "")


def _said(reason: str) -> Message:
    for pattern, template in _PLAINLY:
        if found := pattern.fullmatch(reason):
            return Message(template, **{name: part.replace("`", "") for name, part in found.groupdict().items()})
    return verbatim(f"{reason[:1].lower()}{reason[1:].replace('`', '')}")
