"""Figures of seven segments, three rows high: hexadecimal digits, ``-`` and space, as on the machine."""

from collections.abc import Mapping

# The segments that are lit: a above, b and c at the right, d below, e and f at the left, g in the middle.
SEGMENTS: Mapping[str, str] = {
    "0": "abcdef", "1": "bc", "2": "abged", "3": "abgcd", "4": "fgbc", "5": "afgcd", "6": "afgedc", "7": "abc",
    "8": "abcdefg", "9": "abcdfg", "A": "abcefg", "B": "cdefg", "C": "adef", "D": "bcdeg", "E": "adefg", "F": "aefg",
    "-": "g", " ": "",
}  # fmt: skip
ROWS = ((" ", "a", " "), ("f", "g", "b"), ("e", "d", "c"))
STROKES: Mapping[str, str] = {"a": "_", "g": "_", "d": "_", "b": "|", "c": "|", "e": "|", "f": "|"}


def figures(text: str) -> tuple[str, str, str]:
    """Three rows that show the figures of a text, a column between each two."""
    top, middle, bottom = (" ".join(_row(SEGMENTS[sign], row) for sign in text) for row in ROWS)
    return top, middle, bottom


def _row(lit: str, row: tuple[str, ...]) -> str:
    return "".join(STROKES[segment] if segment in lit else " " for segment in row)
