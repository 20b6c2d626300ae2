"""Holes measured on a board that lies on the machine, and the file that lists them.

Rule: a line is four numbers in millimetres, or it is refused by file, line and column. How the board lies is
found out in alignment.py.
"""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Counted, Message, Refusal
from drillctl.viewmodel.job_options import MAX_MM

Millimetres = NDArray[np.float64]

COLUMNS = ("file_x", "file_y", "machine_x", "machine_y")
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
MAX_BYTES = 1_000_000


class AlignmentError(Refusal):
    """The measured holes, or the file that lists them, cannot be used; the text says which and why."""

    kind = "alignment"


@dataclass(frozen=True)
class Measured:
    """Holes known in both coordinates: file and machine millimetres, each float64 (n, 2)."""

    file_xy_mm: Millimetres
    machine_xy_mm: Millimetres


def parse(data: bytes, *, name: str) -> Measured:
    """Lines `file_x file_y machine_x machine_y` in mm; `#` starts a comment. Raises AlignmentError."""
    if len(data) > MAX_BYTES:
        raise AlignmentError(
            Message("longer than {size} bytes, too long for a list of holes", size=MAX_BYTES).at(name, 1, 1)
        )
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise AlignmentError(Message("not a text file (UTF-8)").at(name, line, 1)) from error
    rows = [_row(line, name, number) for number, line in enumerate(text.split("\n"), 1)]
    found = np.array([row for row in rows if row], np.float64).reshape(-1, len(COLUMNS))
    return Measured(found[:, :2], found[:, 2:])


def _row(line: str, name: str, number: int) -> list[float]:
    words = list(re.finditer(r"\S+", line.partition("#")[0]))
    if not words:
        return []
    if len(words) != len(COLUMNS):
        wanted = len(COLUMNS)
        column = words[wanted].start() + 1 if len(words) > wanted else words[-1].end() + 1
        raise AlignmentError(
            Counted(
                "{count} number where {wanted} are expected",
                "{count} numbers where {wanted} are expected",
                len(words),
                wanted=" ".join(COLUMNS),
            ).at(name, number, column)
        )
    return [_number(word, what, name, number) for word, what in zip(words, COLUMNS, strict=True)]


def _number(word: re.Match[str], what: str, name: str, number: int) -> float:
    place = (name, number, word.start() + 1)
    if not NUMBER.fullmatch(word.group()):
        hint = Message("; write a point, not a comma") if "," in word.group() else ""
        raise AlignmentError(
            Message("{what} {text!r} is not a number{hint}", what=what, text=word.group()[:20], hint=hint).at(*place)
        )
    value_mm = float(word.group())
    if abs(value_mm) > MAX_MM:
        raise AlignmentError(
            Message("{what} {text} is not within {mm:.0f} mm", what=what, text=word.group()[:20], mm=MAX_MM).at(*place)
        )
    return value_mm
