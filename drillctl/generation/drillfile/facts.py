"""What is known about the file's format, and who said it. Rule: the strongest voice wins, a later one of
equal strength replaces the earlier; what was contradicted is remembered.

The header, comments.py and sidefiles.py declare; tools.py and recognise.py ask.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Generic, TypeVar

from .errors import Remark

Value = TypeVar("Value")


class Voice(IntEnum):
    """Who speaks, the strongest first."""

    HEADER = 0
    COMMENT = 1
    SIDE_FILE = 2


@dataclass(frozen=True)
class Fact(Generic[Value]):
    """A declared value, where it stands (source line, None outside the file) and in which words."""

    value: Value
    voice: Voice
    line: int | None
    source: str


@dataclass(frozen=True)
class Size:
    """A tool's diameter from outside its definition: mm is millimetres per unit, 0 where not told.

    count is the number of holes announced for it, None where not told.
    """

    diameter: float
    mm: float
    count: int | None
    voice: Voice


@dataclass
class Facts:
    """Declared units, digits and suppressed zeros of one file, and sizes of tools told apart."""

    units: Fact[str] | None = None
    digits: Fact[tuple[int, int]] | None = None
    zeros: Fact[str] | None = None
    sizes: dict[int, Size] = field(default_factory=dict)
    remarks: list[Remark] = field(default_factory=list)

    def declare_units(self, fact: Fact[str]) -> None:
        """'inch' or 'mm'. A report beside the file in other units is of another export: its digits don't count."""
        before = self.units
        self.units = self._stronger(before, fact)
        if before and before.voice is Voice.SIDE_FILE and before.value != self.units.value:
            self.digits = None if self.digits and self.digits.voice is Voice.SIDE_FILE else self.digits
            self.zeros = None if self.zeros and self.zeros.voice is Voice.SIDE_FILE else self.zeros

    def declare_digits(self, fact: Fact[tuple[int, int]]) -> None:
        """Places before and after the implied point."""
        self.digits = self._stronger(self.digits, fact)

    def declare_zeros(self, fact: Fact[str]) -> None:
        """Which zeros are left out: 'leading', 'trailing' or 'none'."""
        self.zeros = self._stronger(self.zeros, fact)

    def declare_size(self, number: int, size: Size) -> None:
        """A tool's diameter; the first of the strongest voice is kept (reports repeat themselves)."""
        known = self.sizes.get(number)
        if known is None or size.voice < known.voice:
            self.sizes[number] = size

    def sources(self) -> str:
        """All the words that declared something, for the reader's reason."""
        facts = [fact for fact in (self.units, self.zeros, self.digits) if fact]
        return " and ".join(dict.fromkeys(fact.source for fact in facts))

    def _stronger(self, old: Fact[Value] | None, new: Fact[Value]) -> Fact[Value]:
        if old is None or old.value == new.value:
            return old or new
        self.remarks.append(Remark("contradictory-format", new.line, f"{old.source} / {new.source}"))
        return new if new.voice <= old.voice else old
