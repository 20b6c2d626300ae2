"""Lines to words. Rule: one grammar; a run of plain coordinate lines is only its commonest sentence.

`program` takes whole runs by `split_run`, every other line by `split_words`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from .errors import Complaint
from .numbers import NUMBER

PLACE = f"(?:X{NUMBER}(?:Y{NUMBER})?+|Y{NUMBER})"
PARTS = f"(?:X({NUMBER}))?+(?:Y({NUMBER}))?+"
RUN_LINES = 20_000  # taken at once: each of their numbers is a string of its own for a moment
RUN = re.compile(rf"(?:{PLACE}(?:G85{PLACE})?+\n){{1,{RUN_LINES}}}+")
HOLES = re.compile(rf"{PARTS}\n")  # (x, y) of every line of a run without slots
SLOTS = re.compile(rf"{PARTS}(?:G85{PARTS})?+\n")  # (x, y, x, y) of every line of a run with slots
LETTERS_TO_SPACES = str.maketrans("XY", "  ")

# A diameter may name its unit (mm per unit); no other number may.
UNITS_BEHIND = {"MM": 1.0, "INCH": 25.4, "IN": 25.4, '"': 25.4, "MILS": 0.0254, "MIL": 0.0254}
WORD = re.compile(rf"(C)({NUMBER}(?:{'|'.join(UNITS_BEHIND)}))|([A-Z])({NUMBER})?")
KEYWORD = re.compile(
    r"[A-Z]{2,}|[A-Z](?=,)|M(?:19|45|47|96|97|98|99)(?!\d)|M7[12](?=[ \t]*,)|%(?=%*$)|/$|Z(?=[-+]?[.\d]+$)"
)
REMARK = re.compile(r";(.*)|\([^()]*\)")
SPACE = re.compile(r"[ \t]+")
TORN_NUMBER = re.compile(r"[.\d][ \t]+[.\d]")


class Word(NamedTuple):
    """A letter and the number behind it ('' where none is written)."""

    letter: str
    number: str

    def __str__(self) -> str:
        return self.letter + self.number


def split_run(text: str, at: int) -> tuple[int, list[Sequence[str]]]:
    """The plain coordinate lines that begin at a line's start, at most RUN_LINES: where they end, and their numbers in
    columns.

    Columns are x, y, or x, y, x, y where some lines are slots; '' is an axis not written. No columns where
    there is no such line.
    """
    run = RUN.match(text, at)
    if not run:
        return at, []
    slots = "G" in run[0]
    numbers = [] if slots else run[0].translate(LETTERS_TO_SPACES).split()
    if len(numbers) == 2 * run[0].count("\n"):  # X and Y in every line, as in most files: four times as quick
        return run.end(), [numbers[0::2], numbers[1::2]]
    return run.end(), list(zip(*(SLOTS if slots else HOLES).findall(run[0]), strict=True))


def split_comment(line: str) -> tuple[str, str]:
    """The line's command, in capitals and stripped, and its comment."""
    found = REMARK.search(line)
    if not found:
        return line.strip().upper(), ""
    return REMARK.sub("", line).strip().upper(), found[1] or found[0]


def split_words(command: str) -> list[Word]:
    """The words of a command line; spaces mean nothing, but two numbers with a space between are never one."""
    if TORN_NUMBER.search(command):
        raise Complaint("torn-number", command)
    packed = SPACE.sub("", command)
    words: list[Word] = []
    at = 0
    while at < len(packed):
        match = WORD.match(packed, at)
        if not match:
            raise Complaint(_blame(words, packed, at), command)
        words.append(Word(match[1] or match[3], match[2] or match[4] or ""))
        at = match.end()
    return words


def _blame(words: list[Word], packed: str, at: int) -> str:
    """What is wrong where no word begins: a number that goes on, or no command at all."""
    if not words or words[0].letter not in "XYGR":
        return "unknown-command"
    return "coordinate-out-of-range" if packed[at].isdigit() else "bad-number"


def take_axes(words: list[Word], letters: str) -> dict[str, str]:
    """The coordinates that come next, of the axes in letters."""
    axes: dict[str, str] = {}
    while words and words[0].letter in letters:
        word = words.pop(0)
        if not word.number:
            raise Complaint("bad-number", f"{word.letter} without a number")
        if word.letter in axes:
            raise Complaint("duplicate-axis", str(word))
        axes[word.letter] = word.number
    if axes and words and words[0].letter not in "GMTRFSN":
        raise Complaint("bad-number", "".join(map(str, words)))
    return axes


def take_end(words: list[Word]) -> dict[str, str]:
    """The second point of a slot, which must have an axis."""
    axes = take_axes(words, "XY")
    if not axes:
        raise Complaint("bad-number", "G85 without an end")
    return axes
