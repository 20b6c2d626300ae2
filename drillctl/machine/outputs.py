"""The output side of a machine's file: named outputs, their levels at each kind of stop, and words of several bits.

Rule: a bit has one owner, a wire or an output; a word lies on one card. ``[outputs]`` is the short form of rows that go
to 0 at every stop.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from drillctl.language import Message
from drillctl.machine.levels import OutputLevels, Word
from drillctl.machine.phase import NAME
from drillctl.machine.shape import Bit, MachineFile, OutputRow, WordBits
from drillctl.machine.source import Source
from drillctl.ports import CARD_BITS, bits_of

KEPT_BITS = 2 * CARD_BITS  # the guard is told the outputs of the first two cards

Place = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Outputs:
    """All outputs beside the axes: single bits by name, the levels of those that have a row, and the words."""

    bits: tuple[tuple[str, int], ...]
    levels: tuple[OutputLevels, ...]
    words: tuple[Word, ...]


def outputs_of(source: Source, raw: MachineFile, wiring: Mapping[str, int]) -> Outputs:
    """Returns the outputs of a machine's file. Raises TableError."""
    short = source.numbers(raw.outputs, Bit, "outputs")
    _check_names(source, raw)
    taken: dict[int, str] = {}
    for name, bit in wiring.items():
        _take(source, taken, name, 1 << bit, ("wiring", name))
    for name, bit in short.items():
        _take(source, taken, name, 1 << bit, ("outputs", name))
    levels, words = [], []
    bits = dict(short)
    for index, row in enumerate(raw.output):
        word = _word(source, row, index)
        if word is not None:
            words.append(word)
        else:
            assert row.bit is not None
            bits[row.name] = row.bit
        mask = word.mask if word is not None else 1 << bits[row.name]
        _take(source, taken, row.name, mask, ("output", index))
        levels.append(_levels(source, row, index, mask))
    return Outputs(tuple(bits.items()), tuple(levels), tuple(words))


def word_of(source: Source, name: str, place: WordBits, where: Place) -> Word:
    """Returns a word from its first bit and its length. Raises TableError for one that leaves its card."""
    first, bits = place
    if first % CARD_BITS + bits > CARD_BITS:
        fields = {"name": name, "first": first, "last": first + bits - 1}
        raise source.error(Message("{name}: bits {first} to {last} are not of one card", **fields), *where)
    return Word(name, first, bits)


def _word(source: Source, row: OutputRow, index: int) -> Word | None:
    """Returns the word of a row; None for one of a single bit."""
    if (row.bit is None) == (row.word is None):
        reason = Message("output {name}: it has either a bit, or a word of several", name=row.name)
        raise source.error(reason, "output", index)
    return None if row.word is None else word_of(source, row.name, row.word, ("output", index, "word"))


def _levels(source: Source, row: OutputRow, index: int, mask: int) -> OutputLevels:
    at = (row.power_on, row.stop, row.fault, row.estop)
    if row.word is not None and 1 in at:
        reason = Message('output {name}: a word goes to 0 or is kept ("keep"), it can\'t go to 1', name=row.name)
        raise source.error(reason, "output", index)
    if at != (0, 0, 0, 0) and mask >> KEPT_BITS:
        reason = Message("output {name}: one that is kept or set has a bit below {most}", name=row.name, most=KEPT_BITS)
        raise source.error(reason, "output", index)
    return OutputLevels(row.name, mask, at)


def _check_names(source: Source, raw: MachineFile) -> None:
    for name in raw.outputs:
        if not NAME.fullmatch(name):
            reason = Message("outputs: {name!r}: a name is letters, digits, - and _, no - or _ first", name=name)
            raise source.error(reason, "outputs", name)
    seen = set(raw.outputs)
    for index, row in enumerate(raw.output):
        if row.name in seen:
            raise source.error(
                Message("{kind} {name}: a second one of this name", kind="output", name=row.name),
                "output", index, "name",
            )  # fmt: skip
        seen.add(row.name)


def _take(source: Source, taken: dict[int, str], name: str, mask: int, place: Place) -> None:
    """Notes the bits of an output. Raises TableError where one has an owner already."""
    for bit in bits_of(mask):
        if bit in taken:
            reason = Message('output bit {bit} of "{name}" is {other}\'s already', bit=bit, name=name, other=taken[bit])
            raise source.error(reason.at(str(place[0])), *place)
        taken[bit] = name
