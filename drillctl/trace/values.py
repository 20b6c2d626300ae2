"""What a signal's value means: four kinds of value in one table, each shown, read and checked.

Rule: a value is one integer in the record and one word without blanks in text, and `show` and `read` undo
each other.

| kind | in the record | in text |
|---|---|---|
| word | the 32 bits of a port | `0x0000002a` |
| count | a signed whole number | `-17` |
| name | an index into the signal's names | `HOLD` |
| command | sequence x 64 + opcode, 0 = idle | `12:KMD_GOTO_X_Y`, or `-` when idle |
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message

IDLE = "-"
OPCODES = 64  # a command's value is sequence x OPCODES + opcode; opcode 0 is no command
SEQUENCES = 10**9  # nine digits in text, and within a VCD `integer`
NAMES_LIMIT = 1024  # different words one signal may show in a file
WIDEST_BITS = 32  # a port word; also what a VCD `integer` holds

# What a reader takes a signal for, by its name alone: pattern, kind, derived by replay. First match counts.
NAMED_SIGNALS = (
    (re.compile(r"(out|in)\.\d+"), "word", False),
    (re.compile(r"kmd"), "command", False),
    (re.compile(r"request|hand|fault"), "name", False),
    (re.compile(r".+\.(column|position|state)|plant\..+"), "count", True),
    (re.compile(r".+"), "count", False),
)

Vocabulary = dict[str, int]  # the words of one signal met so far, each with its index
Values = NDArray[np.int64]
Whole = TypeVar("Whole", int, NDArray[np.int64])


@dataclass(frozen=True)
class Kind:
    """How values of one kind are shown, read back and checked.

    `show(value, names)` gives the word; `read(word, vocabulary)` the value, with new names added to the
    vocabulary, or raises ValueError with the reason; `valid(values, names, width_bits)` a mask of the values
    that have a meaning.
    """

    show: Callable[[int, Sequence[str]], str]
    read: Callable[[str, Vocabulary], int]
    valid: Callable[[Values, Sequence[str], int], NDArray[np.bool_]]


def named_signal_kind(name: str) -> tuple[str, bool]:
    """Returns the kind that a signal of this name has in a file, and whether replay derives it."""
    return next((kind, derived) for pattern, kind, derived in NAMED_SIGNALS if pattern.fullmatch(name))


def pack_command(sequence: Whole, opcode: Whole) -> Whole:
    """Returns the value of a `command` signal while command `sequence` is current, of one or of
    many (n,); idle is 0.
    """
    return sequence * OPCODES + opcode


def is_plain(text: str) -> bool:
    """Returns whether `text` survives as (part of) a line: printable, no blanks at its ends."""
    return text.isprintable() and text == text.strip()


def is_word(text: str) -> bool:
    """Returns whether `text` can stand as one word of a line."""
    return text != "" and text.isprintable() and " " not in text


def quoted(text: str) -> str:
    """Returns `text` for a message: ASCII, in quotes, never longer than a line."""
    return ascii(text if len(text) <= 40 else text[:37] + "...")


def _show_command(value: int, names: Sequence[str]) -> str:
    sequence, opcode = divmod(value, OPCODES)
    return f"{sequence}:{names[opcode]}" if value else IDLE


def _read_word(text: str, _: Vocabulary) -> int:
    if not re.fullmatch(r"0x[0-9a-f]{8}", text):
        raise ValueError(
            Message("{text} is no port word: expected 0x and eight hex digits, 0-9 a-f", text=quoted(text))
        )
    return int(text, 16)


def _read_count(text: str, _: Vocabulary) -> int:
    if not re.fullmatch(r"0|-?[1-9][0-9]*", text):
        raise ValueError(Message("{text} is no whole number", text=quoted(text)))
    highest = 1 << (WIDEST_BITS - 1)
    if len(text) > len(str(-highest)) or not -highest <= int(text) < highest:
        raise ValueError(
            Message(
                "{text} is too large: counts are {low}..{high}",
                text=quoted(text),
                low=-highest,
                high=highest - 1,
            )
        )
    return int(text)


def _read_name(text: str, vocabulary: Vocabulary, limit: int = NAMES_LIMIT) -> int:
    if not is_word(text):
        raise ValueError(Message("{text} is no word", text=quoted(text)))
    index = vocabulary.setdefault(text, len(vocabulary))
    if index >= limit:
        raise ValueError(
            Message(
                "{text} is one name too many: at most {limit} different ones are read", text=quoted(text), limit=limit
            )
        )
    return index


def _read_command(text: str, vocabulary: Vocabulary) -> int:
    if text == IDLE:
        return 0
    match = re.fullmatch(r"(0|[1-9][0-9]{0,8}):(.+)", text)
    if not match or match[2] == IDLE:
        raise ValueError(
            Message("{text} is no command: expected SEQUENCE:NAME, or {idle} when idle", text=quoted(text), idle=IDLE)
        )
    vocabulary.setdefault(IDLE, 0)  # opcode 0 is no command's
    return pack_command(int(match[1]), _read_name(match[2], vocabulary, OPCODES))


def _valid_commands(values: Values, names: Sequence[str], _: int) -> NDArray[np.bool_]:
    opcodes = values % OPCODES
    in_range = (values > 0) & (values < SEQUENCES * OPCODES)
    valid: NDArray[np.bool_] = (values == 0) | (in_range & (opcodes > 0) & (opcodes < len(names)))
    return valid


KINDS: dict[str, Kind] = {
    "word": Kind(
        show=lambda value, names: f"0x{value:08x}",
        read=_read_word,
        valid=lambda values, names, bits: (values >= 0) & (values < 1 << bits),
    ),
    "count": Kind(
        show=lambda value, names: str(value),
        read=_read_count,
        valid=lambda values, names, bits: (values >= -(1 << (bits - 1))) & (values < 1 << (bits - 1)),
    ),
    "name": Kind(
        show=lambda value, names: names[value],
        read=_read_name,
        valid=lambda values, names, bits: (values >= 0) & (values < len(names)),
    ),
    "command": Kind(
        show=_show_command,
        read=_read_command,
        valid=_valid_commands,
    ),
}
