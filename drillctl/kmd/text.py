"""The ``.kmd`` text form of commands: UTF-8, one command a line, ``#`` to the end of the line. Reader and writer.

Rule: a text gives a whole program, or an error and nothing.
"""

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd.arguments import WORD, LineError, Word, Written, read_arguments, words_of, written_arguments
from drillctl.kmd.commands import BY_OP, COMMANDS, MOST_AXES, MOVING, RECORD, Names, Op, Spec
from drillctl.language import Message, Refusal, nearest

MOST_COMMANDS = 5_000_000
LONGEST_LINE = 1000
LINES_REMEMBERED = 4096
TEXTS_REMEMBERED = 1024
WRITTEN = ("opcode", "flags", "axes", "floor_ticks", "args")  # the fields that a command's text says, args last
_PREFIX = "KMD_"


class KmdError(Refusal):
    """A fault in a queue's text. ``str()`` is ``FILE:LINE:COLUMN: reason``."""

    kind = "queue"

    def __init__(self, file: str, line: int, column: int, reason: Message):
        self.file, self.line, self.column, self.reason = file, line, column, reason
        super().__init__(reason.at(file, line, column))


def parse_program(text: str, names: Names, file: str = "<queue>") -> NDArray[np.void]:
    """Reads a program: dtype RECORD, shape (n,), numbered from 1. A missing KMD_KONIEC is added. Raises KmdError."""
    program = np.zeros(min(text.count("\n") + 2, MOST_COMMANDS + 1), RECORD)  # pages not written to take no memory
    count = floor_ticks = 0
    ended = False
    parsed = lru_cache(LINES_REMEMBERED)(lambda line: _parse_line(words_of(line), names))  # boards repeat their lines
    for number, line in _lines(text, file):
        try:
            if ended:
                raise LineError(words_of(line)[0], Message("nothing may follow KMD_KONIEC"))
            spec, axes, args = parsed(line)
        except LineError as error:
            raise KmdError(file, number, error.word.column, error.reason) from None
        if count == MOST_COMMANDS:
            raise KmdError(file, number, 1, Message("more than {count} commands", count=MOST_COMMANDS))
        if spec.op is Op.PREDKOSC:
            floor_ticks = args[0]
        program[count] = (count + 1, 0, spec.op, spec.flags, axes, floor_ticks if spec.form in MOVING else 0, 0, args)
        count += 1
        ended = spec.op is Op.KONIEC
    if not count:
        raise KmdError(file, 1, 1, Message("no command in it; a queue that does nothing is KMD_KONIEC alone"))
    if not ended:
        program[count] = (count + 1, 0, Op.KONIEC, 0, 0, 0, 0, (0,) * MOST_AXES)
    return program[: count + (not ended)]


def to_text(record: Written, names: Names) -> str:
    """Returns one record as a line of text, without a line end; ``parse_program`` reads the same record from it."""
    spec = BY_OP[Op(int(record["opcode"]))]
    return " ".join([spec.name, *written_arguments(spec, record, names)])


def program_texts(program: NDArray[np.void], names: Names) -> Iterator[str]:
    """Yields each record of a program (n,) as ``to_text`` has it. Commands that come again, as all strokes of a board
    do, are made into text once.
    """

    known: dict[tuple[Any, ...], str] = {}
    for begin in range(0, len(program), TEXTS_REMEMBERED):
        part = program[begin : begin + TEXTS_REMEMBERED]
        columns = [part[name].tolist() for name in WRITTEN]  # plain numbers: quicker to look at than a record's
        for *numbers, args in zip(*columns, strict=True):
            command = (*numbers, *args)
            if command not in known:
                known[command] = to_text(dict(zip(WRITTEN, (*numbers, args), strict=True)), names)
            yield known[command]
        if len(known) > TEXTS_REMEMBERED:
            known.clear()


def _lines(text: str, file: str) -> Iterator[tuple[int, str]]:
    """Yields the lines that hold a command, with their numbers and without their comments."""
    for number, line in enumerate(_split(text.removeprefix("\ufeff")), start=1):
        if len(line) > LONGEST_LINE:
            raise KmdError(
                file, number, LONGEST_LINE + 1, Message("a line of more than {count} characters", count=LONGEST_LINE)
            )
        said = line.partition("#")[0]
        if WORD.search(said):
            yield number, said


def _split(text: str) -> Iterator[str]:
    """Yields the lines one after the other: a list of all of them would take many times the text."""
    begin = 0
    while (end := text.find("\n", begin)) >= 0:
        yield text[begin:end]
        begin = end + 1
    yield text[begin:]


def _parse_line(words: list[Word], names: Names) -> tuple[Spec, int, tuple[int, ...]]:
    """Command, mask of its axes, and as many arguments as a record has."""
    name, rest = words[0], words[1:]
    spec = COMMANDS.get(name.text)
    if spec is None:
        raise LineError(name, _unknown(name.text[:40]))
    axes, args = read_arguments(spec, name, rest, names)
    return spec, axes, (*args, *[0] * (MOST_AXES - len(args)))


def _unknown(name: str) -> Message:
    """The reason of refusal, with the command that was probably meant. The prefix that all commands share doesn't
    count.
    """
    known = {command.removeprefix(_PREFIX).upper(): command for command in COMMANDS}
    close = nearest(name.upper().removeprefix(_PREFIX), known)
    if close:
        return Message("unknown command {name!r}; did you mean {other}?", name=name, other=known[close])
    return Message("unknown command {name!r}", name=name)
