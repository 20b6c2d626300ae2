"""What follows a command's name in the text form: read from its words, and written from its record, by ArgumentForm.

Rule: two tables at the end are the whole of it; a word that is wrong is a LineError, which knows its column.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from drillctl.kmd.commands import MOST_ARGUMENT, ArgumentForm, Names, Spec
from drillctl.language import Counted, Message, Refusal, joined, known_words

Written = np.void | Mapping[str, Any]  # a record, or as much of one by name as its text says
WORD = re.compile(r"\S+")
_INTEGER = re.compile(r"[+-]?[0-9]{1,10}$")


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a line, and the column of its first character, from 1."""

    text: str
    column: int


class LineError(Refusal):
    """A line that is no command: the word that is wrong, and why."""

    def __init__(self, word: Word, reason: Message):
        self.word, self.reason = word, reason
        super().__init__(reason)


def read_arguments(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    """Returns the axis mask and the arguments that the words after a command's name say. Raises LineError."""
    return _IN[spec.form](spec, name, rest, names)


def written_arguments(spec: Spec, record: Written, names: Names) -> list[str]:
    """Returns the words that ``read_arguments`` reads the same record from."""
    return _OUT[spec.form](record, names)


def words_of(line: str) -> list[Word]:
    """Returns the words of a line."""
    return [Word(found[0], found.start() + 1) for found in WORD.finditer(line)]


def _count(spec: Spec, name: Word, rest: list[Word], wanted: int) -> None:
    if len(rest) != wanted:
        word = rest[wanted] if len(rest) > wanted else name
        written = joined(" ", [spec.name, spec.usage] if spec.usage else [spec.name])
        count = Counted("{count} argument", "{count} arguments", len(rest))
        raise LineError(word, Message("{count}; it is written {command}", count=count, command=written))


def _integer(word: Word, least: int = -MOST_ARGUMENT) -> int:
    value = int(word.text) if _INTEGER.match(word.text) else None
    if value is None or not least <= value <= MOST_ARGUMENT:
        text = word.text[:40]
        wanted = (
            Message("{word!r} is not a whole number", word=text)
            if least < 0
            else Message("{word!r} is not a whole number from {least}", word=text, least=least)
        )
        raise LineError(word, wanted)
    return value


def _axis(word: Word, name: str, names: Names) -> int:
    if name not in names.axes:
        raise LineError(
            word, Message("no axis is named {name!r}; {words}", name=name[:40], words=known_words(name, names.axes))
        )
    return names.axes.index(name)


def _known(word: Word, table: Mapping[str, int], kind: Message) -> int:
    if word.text not in table:
        there = known_words(word.text, table) if table else Message("this machine has none")
        raise LineError(
            word, Message("no {kind} is named {name!r}; {others}", kind=kind, name=word.text[:40], others=there)
        )
    return table[word.text]


def _level(word: Word) -> int:
    if word.text not in ("0", "1"):
        raise LineError(word, Message("{word!r} is not 0 or 1", word=word.text[:40]))
    return int(word.text)


def _nothing_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 0)
    return 0, []


def _xy_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 2)
    indexes = [_axis(name, axis, names) for axis in ("x", "y")]
    args = [0] * len(names.axes)
    for index, word in zip(indexes, rest, strict=True):
        args[index] = _integer(word)
    return sum(1 << index for index in indexes), args


def _moves_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    if not rest:
        _count(spec, name, rest, 1)
    args, axes = [0] * len(names.axes), 0
    for word in rest:
        axis, equals, value = word.text.partition("=")
        if not equals:
            raise LineError(word, Message("{word!r} is not axis=steps", word=word.text[:40]))
        index = _once(word, axis, axes, names)
        axes |= 1 << index
        args[index] = _integer(Word(value, word.column + len(axis) + 1))
    return axes, args


def _once(word: Word, axis: str, axes: int, names: Names) -> int:
    """The index of an axis that isn't among those in the mask ``axes`` yet."""
    index = _axis(word, axis, names)
    if axes >> index & 1:
        raise LineError(word, Message("axis {name} is named twice", name=axis))
    return index


def _heads_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    args, axes = [0] * len(names.axes), 0
    for word in rest:
        axis, equals, ticks = word.text.partition("=")
        index = _once(word, axis, axes if equals else 0, names)
        axes |= 1 << index
        if equals:
            args[index] = _integer(Word(ticks, word.column + len(axis) + 1), 0)
    return axes, args


def _xy_heads_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    if len(rest) < 2:
        _count(spec, name, rest, 2)
    if taken := {"x", "y"} & set(names.heads):
        raise LineError(name, Message("{axis} is a head of this machine", axis=min(taken)))
    axes, args = _xy_in(spec, name, rest[:2], names)
    for word in rest[2:]:
        axis = word.text.partition("=")[0]
        if axes >> _axis(word, axis, names) & 1 or axis not in (names.heads or names.axes):
            raise LineError(word, Message("{name} is no head", name=axis))
    heads, floors = _heads_in(spec, name, rest[2:], names)
    return axes | heads, [place + floor for place, floor in zip(args, floors, strict=True)]


def _axes_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    return sum({1 << _axis(word, word.text, names) for word in rest}), []


def _number_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 1)
    return 0, [_integer(rest[0], spec.least)]


def _output_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 2)
    return 0, [_known(rest[0], names.outputs, Message("output")), _level(rest[1])]


def _input_in(spec: Spec, name: Word, rest: list[Word], names: Names) -> tuple[int, list[int]]:
    _count(spec, name, rest, 3)
    return 0, [_known(rest[0], names.inputs, Message("input")), _level(rest[1]), _integer(rest[2], 1)]


def _masked(record: Written, names: Names) -> list[int]:
    return [index for index in range(len(names.axes)) if int(record["axes"]) >> index & 1]


def _moves_out(record: Written, names: Names) -> list[str]:
    return [f"{names.axes[index]}={record['args'][index]}" for index in _masked(record, names)]


def _xy_out(record: Written, names: Names) -> list[str]:
    return [str(record["args"][names.axes.index(axis)]) for axis in ("x", "y")]


def _heads_out(record: Written, names: Names, plane: int = 0) -> list[str]:
    """The heads in the mask. Without any, all heads are meant: they are named where one has an interval of its own.
    ``plane``: the axes that are no heads here.
    """
    known = [index for index, name in enumerate(names.axes) if name in (names.heads or names.axes)]
    heads = [index for index in known if not plane >> index & 1]
    masked = [index for index in _masked(record, names) if not plane >> index & 1]
    own = any(int(record["args"][index]) for index in heads)
    floors = {index: int(record["args"][index]) for index in masked or (heads if own else ())}
    return [f"{names.axes[index]}={ticks}" if ticks else names.axes[index] for index, ticks in floors.items()]


def _xy_heads_out(record: Written, names: Names) -> list[str]:
    plane = sum(1 << names.axes.index(axis) for axis in ("x", "y"))
    return [*_xy_out(record, names), *_heads_out(record, names, plane)]


def _switch_out(table: Mapping[str, int], record: Written, count: int) -> list[str]:
    by_bit = {bit: name for name, bit in table.items()}
    return [by_bit[int(record["args"][0])], *(str(value) for value in record["args"][1:count])]


_Reader = Callable[[Spec, Word, list[Word], Names], tuple[int, list[int]]]
_IN: Mapping[ArgumentForm, _Reader] = {
    ArgumentForm.NOTHING: _nothing_in,
    ArgumentForm.XY: _xy_in,
    ArgumentForm.MOVES: _moves_in,
    ArgumentForm.AXES: _axes_in,
    ArgumentForm.NUMBER: _number_in,
    ArgumentForm.OUTPUT: _output_in,
    ArgumentForm.INPUT: _input_in,
    ArgumentForm.HEADS: _heads_in,
    ArgumentForm.XY_HEADS: _xy_heads_in,
}
_OUT: Mapping[ArgumentForm, Callable[[Written, Names], list[str]]] = {
    ArgumentForm.NOTHING: lambda record, names: [],
    ArgumentForm.XY: _xy_out,
    ArgumentForm.MOVES: _moves_out,
    ArgumentForm.AXES: lambda record, names: [names.axes[index] for index in _masked(record, names)],
    ArgumentForm.NUMBER: lambda record, names: [str(record["args"][0])],
    ArgumentForm.OUTPUT: lambda record, names: _switch_out(names.outputs, record, 2),
    ArgumentForm.INPUT: lambda record, names: _switch_out(names.inputs, record, 3),
    ArgumentForm.HEADS: _heads_out,
    ArgumentForm.XY_HEADS: _xy_heads_out,
}
