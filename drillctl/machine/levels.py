"""Outputs that have a level for each kind of stop, and numbers that lie on neighbouring bits of the port image.

Rule: masks and integers only; outputs.py reads them from a machine's file, execution and the processes use them.
"""

from collections.abc import Iterable
from dataclasses import dataclass

POWER_ON, STOP, FAULT, ESTOP = range(4)  # the events at which outputs take their levels
KEEP = "keep"
SPEED_WANTED, SPEED_ACTUAL = "spindle_wanted", "spindle_actual"  # words of a machine whose spindle has a speed, rev/min
Level = int | str  # 0, 1, or KEEP: what it has then


@dataclass(frozen=True, slots=True)
class OutputLevels:
    """One ``[[output]]`` row: its bits of the port image, and its level at each event, indexed by POWER_ON, STOP, FAULT
    and ESTOP. A word has 0 or KEEP.
    """

    name: str
    mask: int
    at: tuple[Level, Level, Level, Level]


@dataclass(frozen=True, slots=True)
class Word:
    """A number on neighbouring bits of one card: ``bit`` is its lowest, in the port image, ``bits`` how many."""

    name: str
    bit: int
    bits: int

    @property
    def greatest(self) -> int:
        """The greatest number that it holds."""
        return (1 << self.bits) - 1

    @property
    def mask(self) -> int:
        """Its bits of the port image."""
        return self.greatest << self.bit

    def value(self, image: int) -> int:
        """Returns the number in an image."""
        return image >> self.bit & self.greatest

    def put(self, image: int, value: int) -> int:
        """Returns the image with this number in it."""
        return image & ~self.mask | value << self.bit & self.mask


def masks_at(rows: Iterable[OutputLevels], event: int) -> tuple[int, int]:
    """Returns the output bits that an event leaves as they are, and those that it sets. It clears all others."""
    rows = tuple(rows)
    kept, on = (sum(row.mask for row in rows if row.at[event] == level) for level in (KEEP, 1))
    return kept, on
