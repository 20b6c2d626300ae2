"""The text form of part programs, ``.sentences``: UTF-8, one sentence a line, ``#`` to the end of the line.

Rule: a text gives all its sentences, or an error for each line that is wrong, with its column, and nothing.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from drillctl.files.inputs import read_bytes
from drillctl.generation.boiler_drum.sentence import CELLS, Fault, Sentence, fault, sentence_of
from drillctl.generation.errors import JobError
from drillctl.language import Message, message_of, one_line

LARGEST_BYTES = 1024 * 1024
LONGEST_LINE = 1000
MOST_SENTENCES = (8192 - 198 - 1) // CELLS  # what a store holds of one program (cells.py)
_WORD = re.compile(r"\S+")


@dataclass(frozen=True)
class Part:
    """A part program and where it stands: sentences, and by sentence its line in ``source`` or its first cell.

    source  a file, or a store and a number: ``RAM 03``
    """

    source: str
    sentences: tuple[Sentence, ...]
    lines: tuple[int, ...]
    in_store: bool = False

    def at(self, index: int, reason: Message) -> Message:
        """Returns a reason with the place of a sentence (index from 0) before it."""
        if not self.in_store:
            return reason.at(self.source, self.lines[index])
        number, cell = index + 1, f"{self.lines[index]:04X}"
        return Message("sentence {number}, cell {cell}: {reason}", number=number, cell=cell, reason=reason).at(
            self.source
        )


def read_part(path: Path) -> Part:
    """Reads a file. Raises JobError with file, line and column for each line that is wrong."""
    try:
        data = read_bytes(path, LARGEST_BYTES, Message("a part program"))
    except OSError as error:
        raise JobError(Message("can't be read: {why}", why=message_of(error)).at(path)) from error
    try:
        return parse_part(data.decode("utf-8-sig"), str(path))
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        column = error.start - (data.rfind(b"\n", 0, error.start) + 1) + 1
        raise JobError(Message("not UTF-8 text, so no part program").at(path, line, column)) from error


def parse_part(text: str, source: str) -> Part:
    """Like ``read_part``, from a text."""
    found: list[tuple[int, Sentence]] = []
    problems: list[Message] = []
    for number, line in enumerate(text.split("\n"), start=1):
        for wrong in _faults(line):
            problems.append(wrong.reason.at(source, number, wrong.at + 1))
        if not problems:
            found += [(number, sentence_of(word[0])) for word in _words(line)]
    if len(found) > MOST_SENTENCES:
        line_beyond = found[MOST_SENTENCES][0]
        problems.append(Message("more than {most} sentences", most=MOST_SENTENCES).at(source, line_beyond, 1))
    if not found and not problems:
        problems.append(Message("no sentence in it").at(source, 1, 1))
    if problems:
        raise JobError(*problems)
    lines, sentences = zip(*found, strict=True)
    return Part(source, sentences, lines)


def part_text(sentences: Iterable[Sentence], heading: str) -> str:
    """Returns a part program as text, a sentence a line with its meaning in English beside it."""
    return "\n".join([f"# {one_line(heading)}", *(f"{one}  # {one.words()}" for one in sentences), ""])


def _words(line: str) -> Iterator[re.Match[str]]:
    return _WORD.finditer(line.partition("#")[0])


def _faults(line: str) -> Iterator[Fault]:
    """Yields the first fault of a line, if it has one; ``at`` is counted from the line's begin."""
    if len(line) > LONGEST_LINE:
        yield Fault(LONGEST_LINE, Message("a line of more than {count} characters", count=LONGEST_LINE))
        return
    words = [*_words(line)]
    if words and (wrong := fault(words[0][0])):
        yield Fault(words[0].start() + wrong.at, wrong.reason)
    elif len(words) > 1:
        yield Fault(words[1].start(), Message("a second sentence on the line; each has a line of its own"))
