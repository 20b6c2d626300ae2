"""The ``.kmd`` text form of commands: UTF-8, one command a line, ``#`` to the end of the line. Reader and writer.

Rule: a text gives a whole program, or an error and nothing.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd.commands import BY_OP, COMMANDS, MOST_ARGUMENT, MOST_AXES, RECORD, ArgumentForm, Names, Op, Spec
from drillctl.language import Counted, Message, Refusal, joined, known_words, nearest

MOST_COMMANDS = 5_000_000
LONGEST_LINE = 1000
LINES_REMEMBERED = 4096
TEXTS_REMEMBERED = 1024
_WORD = re.compile(r"\S+")
_PREFIX = "KMD_"
_INTEGER = re.compile(r"[+-]?[0-9]{1,10}$")


class KmdError(Refusal):
    """A fault in a queue's text. ``str()`` is ``FILE:LINE:COLUMN: reason``."""

    kind = "queue"

    def __init__(self, file: str, line: int, column: int, reason: Message):
        self.file, self.line, self.column, self.reason = file, line, column, reason
        super().__init__(reason.at(file, line, column))


@dataclass(frozen=True, slots=True)
class _Word:
    text: str
    column: int


class _LineError(Refusal):
    def __init__(self, word: _Word, reason: Message):
        self.word, self.reason = word, reason
        super().__init__(reason)


def parse_program(text: str, names: Names, file: str = "<queue>") -> NDArray[np.void]:
    """Reads a program: dtype RECORD, shape (n,), numbered from 1. A missing KMD_KONIEC is added. Raises KmdError."""
    program = np.zeros(min(text.count("\n") + 2, MOST_COMMANDS + 1), RECORD)  # pages not written to take no memory
    count = floor_ticks = 0
    ended = False
    parsed = lru_cache(LINES_REMEMBERED)(lambda line: _parse_line(_words(line), names))  # boards repeat their lines
    for number, line in _lines(text, file):
        try:
            if ended:
                raise _LineError(_words(line)[0], Message("nothing may follow KMD_KONIEC"))
            spec, axes, args = parsed(line)
        except _LineError as error:
            raise KmdError(file, number, error.word.column, error.reason) from None
        if count == MOST_COMMANDS:
            raise KmdError(file, number, 1, Message("more than {count} commands", count=MOST_COMMANDS))
        if spec.op is Op.PREDKOSC:
            floor_ticks = args[0]
        moves = spec.form in (ArgumentForm.XY, ArgumentForm.MOVES) or spec.op in (Op.WIERTLO_DOL, Op.WIERTLO_GORA)
        program[count] = (count + 1, 0, spec.op, spec.flags, axes, floor_ticks if moves else 0, 0, args)
        count += 1
        ended = spec.op is Op.KONIEC
    if not count:
        raise KmdError(file, 1, 1, Message("no command in it; a queue that does nothing is KMD_KONIEC alone"))
    if not ended:
        program[count] = (count + 1, 0, Op.KONIEC, 0, 0, 0, 0, (0,) * MOST_AXES)
    return program[: count + (not ended)]


def to_text(record: np.void, names: Names) -> str:
    """Returns one record as a line of text, without a line end; ``parse_program`` reads the same record from it."""
    spec = BY_OP[Op(int(record["opcode"]))]
    return " ".join([spec.name, *_ARGUMENTS_OUT[spec.form](record, names)])


def program_texts(program: NDArray[np.void], names: Names) -> Iterator[str]:
    """Yields each record of a program (n,) as ``to_text`` has it. Commands that come again, as all strokes of a board
    do, are made into text once.
    """

    @lru_cache(TEXTS_REMEMBERED)
    def text(command: bytes) -> str:
        return to_text(np.frombuffer(command, RECORD)[0], names)

    plain = program.copy()
    for counted in ("sequence", "epoch", "tag"):  # not part of the text
        plain[counted] = 0
    data, size = plain.tobytes(), plain.itemsize
    yield from (text(data[begin : begin + size]) for begin in range(0, len(data), size))


def _lines(text: str, file: str) -> Iterator[tuple[int, str]]:
    """Yields the lines that hold a command, with their numbers and without their comments."""
    for number, line in enumerate(_split(text.removeprefix("\ufeff")), start=1):
        if len(line) > LONGEST_LINE:
            raise KmdError(
                file, number, LONGEST_LINE + 1, Message("a line of more than {count} characters", count=LONGEST_LINE)
            )
        said = line.partition("#")[0]
        if _WORD.search(said):
            yield number, said


def _split(text: str) -> Iterator[str]:
    """Yields the lines one after the other: a list of all of them would take many times the text."""
    begin = 0
    while (end := text.find("\n", begin)) >= 0:
        yield text[begin:end]
        begin = end + 1
    yield text[begin:]


def _words(line: str) -> list[_Word]:
    return [_Word(found[0], found.start() + 1) for found in _WORD.finditer(line)]


def _parse_line(words: list[_Word], names: Names) -> tuple[Spec, int, tuple[int, ...]]:
    """Command, mask of its axes, and as many arguments as a record has."""
    name, rest = words[0], words[1:]
    spec = COMMANDS.get(name.text)
    if spec is None:
        raise _LineError(name, _unknown(name.text[:40]))
    axes, args = _ARGUMENTS_IN[spec.form](spec, name, rest, names)
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


def _count(spec: Spec, name: _Word, rest: list[_Word], wanted: int) -> None:
    if len(rest) != wanted:
        word = rest[wanted] if len(rest) > wanted else name
        written = joined(" ", [spec.name, spec.usage] if spec.usage else [spec.name])
        count = Counted("{count} argument", "{count} arguments", len(rest))
        raise _LineError(word, Message("{count}; it is written {command}", count=count, command=written))


def _integer(word: _Word, least: int = -MOST_ARGUMENT) -> int:
    value = int(word.text) if _INTEGER.match(word.text) else None
    if value is None or not least <= value <= MOST_ARGUMENT:
        text = word.text[:40]
        wanted = (
            Message("{word!r} is not a whole number", word=text)
            if least < 0
            else Message("{word!r} is not a whole number from {least}", word=text, least=least)
        )
        raise _LineError(word, wanted)
    return value


def _axis(word: _Word, name: str, names: Names) -> int:
    if name not in names.axes:
        raise _LineError(
            word, Message("no axis is named {name!r}; {words}", name=name[:40], words=known_words(name, names.axes))
        )
    return names.axes.index(name)


def _known(word: _Word, table: Mapping[str, int], kind: Message) -> int:
    if word.text not in table:
        there = known_words(word.text, table) if table else Message("this machine has none")
        raise _LineError(
            word, Message("no {kind} is named {name!r}; {others}", kind=kind, name=word.text[:40], others=there)
        )
    return table[word.text]


def _level(word: _Word) -> int:
    if word.text not in ("0", "1"):
        raise _LineError(word, Message("{word!r} is not 0 or 1", word=word.text[:40]))
    return int(word.text)


def _nothing_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 0)
    return 0, []


def _xy_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 2)
    indexes = [_axis(name, axis, names) for axis in ("x", "y")]
    args = [0] * len(names.axes)
    for index, word in zip(indexes, rest, strict=True):
        args[index] = _integer(word)
    return sum(1 << index for index in indexes), args


def _moves_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    if not rest:
        _count(spec, name, rest, 1)
    args, axes = [0] * len(names.axes), 0
    for word in rest:
        axis, equals, value = word.text.partition("=")
        if not equals:
            raise _LineError(word, Message("{word!r} is not axis=steps", word=word.text[:40]))
        index = _axis(word, axis, names)
        if axes >> index & 1:
            raise _LineError(word, Message("axis {name} is named twice", name=axis))
        axes |= 1 << index
        args[index] = _integer(_Word(value, word.column + len(axis) + 1))
    return axes, args


def _axes_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    return sum({1 << _axis(word, word.text, names) for word in rest}), []


def _number_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 1)
    return 0, [_integer(rest[0], spec.least)]


def _output_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 2)
    return 0, [_known(rest[0], names.outputs, Message("output")), _level(rest[1])]


def _input_in(spec: Spec, name: _Word, rest: list[_Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 3)
    return 0, [_known(rest[0], names.inputs, Message("input")), _level(rest[1]), _integer(rest[2], 1)]


def _masked(record: np.void, names: Names) -> list[int]:
    return [index for index in range(len(names.axes)) if int(record["axes"]) >> index & 1]


def _moves_out(record: np.void, names: Names) -> list[str]:
    return [f"{names.axes[index]}={record['args'][index]}" for index in _masked(record, names)]


def _xy_out(record: np.void, names: Names) -> list[str]:
    return [str(record["args"][names.axes.index(axis)]) for axis in ("x", "y")]


def _switch_out(table: Mapping[str, int], record: np.void, count: int) -> list[str]:
    by_bit = {bit: name for name, bit in table.items()}
    return [by_bit[int(record["args"][0])], *(str(value) for value in record["args"][1:count])]


_In = Callable[[Spec, _Word, list[_Word], Names], tuple[int, list[int]]]
_ARGUMENTS_IN: Mapping[ArgumentForm, _In] = {
    ArgumentForm.NOTHING: _nothing_in,
    ArgumentForm.XY: _xy_in,
    ArgumentForm.MOVES: _moves_in,
    ArgumentForm.AXES: _axes_in,
    ArgumentForm.NUMBER: _number_in,
    ArgumentForm.OUTPUT: _output_in,
    ArgumentForm.INPUT: _input_in,
}
_ARGUMENTS_OUT: Mapping[ArgumentForm, Callable[[np.void, Names], list[str]]] = {
    ArgumentForm.NOTHING: lambda record, names: [],
    ArgumentForm.XY: _xy_out,
    ArgumentForm.MOVES: _moves_out,
    ArgumentForm.AXES: lambda record, names: [names.axes[index] for index in _masked(record, names)],
    ArgumentForm.NUMBER: lambda record, names: [str(record["args"][0])],
    ArgumentForm.OUTPUT: lambda record, names: _switch_out(names.outputs, record, 2),
    ArgumentForm.INPUT: lambda record, names: _switch_out(names.inputs, record, 3),
}
