"""One sentence of a part program: direction, gear and way, as six characters, as three bytes, and in plain words.

Rule: ``Sentence`` holds what is allowed and nothing else; ``fault`` finds what is not. Source: the paper, 3.2. Taken
here: the unit of the way is 0.1 mm; 4 and 6 are the large carriage, 2 and 8 the small one, as the arrows of a keypad.
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, LETTERS, MM_PER_M
from drillctl.language import Message

CHARACTERS = 6
CELLS = 3  # of a store: direction and gear, two of digits, all as they are printed in hexadecimal
LONGEST_TENTHS = 9999


class Direction(NamedTuple):
    """What the first digit of a sentence moves: an axis by its name, and the sign of its steps."""

    axis: str
    sign: int
    words: Message


DIRECTIONS: Mapping[str, Direction] = {
    "2": Direction("y", -1, Message("small carriage back (tool out)")),
    "4": Direction("x", -1, Message("large carriage back")),
    "6": Direction("x", 1, Message("large carriage on")),
    "8": Direction("y", 1, Message("small carriage on (tool in)")),
}
DIGIT_OF: Mapping[tuple[str, int], str] = {(way.axis, way.sign): digit for digit, way in DIRECTIONS.items()}
CARRIAGES: Mapping[str, Message] = {"x": Message("large carriage"), "y": Message("small carriage")}


class Sentence(NamedTuple):
    """Direction (one of DIRECTIONS), gear 0 to 15, way in tenths of a millimetre from 1 to 9999."""

    direction: str
    gear: int
    tenths: int

    @property
    def axis(self) -> str:
        """The name of the axis that the sentence moves."""
        return DIRECTIONS[self.direction].axis

    @property
    def signed_tenths(self) -> int:
        """The way with the sign of its direction."""
        return DIRECTIONS[self.direction].sign * self.tenths

    def __str__(self) -> str:
        return f"{self.direction}{LETTERS[self.gear]}{self.tenths:04d}"

    def cells(self) -> bytes:
        """Returns the three bytes of a store."""
        return bytes.fromhex(str(self))

    def words(self) -> Message:
        """Returns what the sentence does, in plain words."""
        return Message(
            "{carriage} by {way:.1f} mm, gear {gear} ({speed:g} m/min)",
            carriage=DIRECTIONS[self.direction].words,
            way=self.tenths / 10,
            gear=LETTERS[self.gear],
            speed=GEARS_MM_MIN[self.gear] / MM_PER_M,
        )


class Fault(NamedTuple):
    """What is wrong with six characters: at which of them, counted from 0, and why."""

    at: int
    reason: Message


_CHECKS = (  # characters, what they must be, reason
    (slice(0, 1), re.compile("[2468]"), Message("a direction is 2, 4, 6 or 8")),
    (slice(1, 2), re.compile("[0-9A-Fa-f]"), Message("a gear is 0 to 9 or A to F")),
    *((slice(at, at + 1), re.compile("[0-9]"), Message("the way is four decimal digits")) for at in range(2, 6)),
    (slice(2, 6), re.compile("(?!0000)"), Message("a way of 0000 is none; the shortest is 0001 (0.1 mm)")),
)


def fault(text: str) -> Fault | None:
    """Returns the first fault of a sentence's text, or None where it is one."""
    if len(text) != CHARACTERS:
        wanted = Message("a sentence is 6 characters (direction, gear, four digits); this is {count}", count=len(text))
        return Fault(min(len(text), CHARACTERS), wanted)
    return next((Fault(part.start, why) for part, wanted, why in _CHECKS if not wanted.match(text[part])), None)


def sentence_of(text: str) -> Sentence:
    """Returns the sentence of a text in which ``fault`` finds none."""
    return Sentence(text[0], int(text[1], 16), int(text[2:]))


def way(axis: str, tenths: int, gear: int) -> list[Sentence]:
    """Returns the sentences of a way of any length (signed tenths of a millimetre): several where one is too short."""
    direction = DIGIT_OF[axis, 1 if tenths > 0 else -1]
    whole, rest = divmod(abs(tenths), LONGEST_TENTHS)
    return [Sentence(direction, gear, part) for part in [LONGEST_TENTHS] * whole + [rest] * (rest > 0)]
