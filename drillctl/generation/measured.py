"""Holes measured on a board that lies on the machine, and the file that lists them.

Rule: a line is four numbers in millimetres, or it is refused by file, line and column. Called by alignment, which finds
out how the board lies.
"""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Millimetres = NDArray[np.float64]

COLUMNS = ("file_x", "file_y", "machine_x", "machine_y")
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
MAX_BYTES = 1_000_000
MAX_MM = 10_000.0  # ten metres: beyond any machine, so a number like that is a slip


class AlignmentError(ValueError):
    """The measured holes, or the file that lists them, cannot be used; the text says which and why."""


@dataclass(frozen=True)
class Measured:
    """Holes known in both coordinates: file and machine millimetres, each float64 (n, 2)."""

    file_xy_mm: Millimetres
    machine_xy_mm: Millimetres


def parse(data: bytes, *, name: str) -> Measured:
    """Lines `file_x file_y machine_x machine_y` in mm; `#` starts a comment. Raises AlignmentError."""
    if len(data) > MAX_BYTES:
        raise AlignmentError(f"{name}:1:1: longer than {MAX_BYTES} bytes, too long for a list of holes")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise AlignmentError(f"{name}:{line}:1: not a text file (UTF-8)") from error
    rows = [_row(line, f"{name}:{number}") for number, line in enumerate(text.split("\n"), 1)]
    found = np.array([row for row in rows if row], np.float64).reshape(-1, len(COLUMNS))
    return Measured(found[:, :2], found[:, 2:])


def _row(line: str, where: str) -> list[float]:
    words = list(re.finditer(r"\S+", line.partition("#")[0]))
    if not words:
        return []
    if len(words) != len(COLUMNS):
        wanted = len(COLUMNS)
        column = words[wanted].start() + 1 if len(words) > wanted else words[-1].end() + 1
        raise AlignmentError(f"{where}:{column}: {len(words)} numbers where {' '.join(COLUMNS)} are meant")
    return [_number(word, what, where) for word, what in zip(words, COLUMNS, strict=True)]


def _number(word: re.Match[str], what: str, where: str) -> float:
    place = f"{where}:{word.start() + 1}"
    if not NUMBER.fullmatch(word.group()):
        hint = "; write a point, not a comma" if "," in word.group() else ""
        raise AlignmentError(f"{place}: {what} {word.group()[:20]!r} is not a number{hint}")
    value_mm = float(word.group())
    if abs(value_mm) > MAX_MM:
        raise AlignmentError(f"{place}: {what} {word.group()[:20]} is not within {MAX_MM:.0f} mm")
    return value_mm
