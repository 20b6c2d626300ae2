"""What is known about the file's format, and who said it. Rule: the strongest voice wins, a later one of
equal strength replaces the earlier; what was contradicted is remembered.

The header, comments.py and sidefiles.py declare; tools.py and recognise.py ask.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Generic, TypeVar

import numpy as np

from .errors import Remark
from .model import DEFAULT_DIGITS, MM_PER_UNIT, Floats

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
    """Declared units, digits and suppressed zeros of one file, and sizes of tools told apart.

    digits: each with the unit it was declared for, None where it was declared without one.
    """

    units: Fact[str] | None = None
    digits: list[tuple[str | None, Fact[tuple[int, int]]]] = field(default_factory=list)
    zeros: Fact[str] | None = None
    sizes: dict[int, Size] = field(default_factory=dict)
    remarks: list[Remark] = field(default_factory=list)

    def declare_units(self, fact: Fact[str]) -> None:
        """'inch' or 'mm'. A report beside the file in other units is of another export: its digits don't count."""
        before = self.units
        self.units = self._stronger(before, fact)
        if before and before.voice is Voice.SIDE_FILE and before.value != self.units.value:
            self.digits = [(meant, each) for meant, each in self.digits if each.voice is not Voice.SIDE_FILE]
            self.zeros = None if self.zeros and self.zeros.voice is Voice.SIDE_FILE else self.zeros

    def replace_units(self, fact: Fact[str]) -> None:
        """Other units than the header's, declared before anything was drilled in the header's."""
        self.units = fact

    def declare_digits(self, fact: Fact[tuple[int, int]], units: str | None = None) -> None:
        """Places before and after the implied point, for numbers in `units`; None: for any."""
        self._stronger(self.digits_for(units), fact)
        self.digits.append((units, fact))

    def digits_for(self, units: str | None) -> Fact[tuple[int, int]] | None:
        """The strongest, then latest, declaration of digits that holds for numbers in `units`; None: in any."""
        fitting = [fact for meant, fact in self.digits if units is None or meant in (None, units)]
        return min(reversed(fitting), key=lambda fact: fact.voice, default=None)

    def carried(self, units: str, new_units: str) -> Floats:
        """Factors (3,) by which a place's number triple changes when the units do (numbers.py)."""
        (integer, decimal), (new_integer, new_decimal) = (
            fact.value if (fact := self.digits_for(each)) else DEFAULT_DIGITS[each] for each in (units, new_units)
        )
        places = np.array([10.0 ** (new_decimal - decimal), 10.0 ** (integer - new_integer), 1.0])
        return places * MM_PER_UNIT[units] / MM_PER_UNIT[new_units]

    def declare_zeros(self, fact: Fact[str]) -> None:
        """Which zeros are left out: 'leading', 'trailing' or 'none'. 'none' contradicts no other word, as numbers
        with all their zeros read the same under each (KiCad writes "keep zeros" and TZ)."""
        if self.zeros and "none" in (self.zeros.value, fact.value):
            self.zeros = fact if self.zeros.value == "none" else self.zeros
        else:
            self.zeros = self._stronger(self.zeros, fact)

    def declare_size(self, number: int, size: Size) -> None:
        """A tool's diameter; the first of the strongest voice is kept (reports repeat themselves)."""
        known = self.sizes.get(number)
        if known is None or size.voice < known.voice:
            self.sizes[number] = size

    def sources(self) -> str:
        """All the words that declared something, for the reader's reason."""
        digits = self.digits_for(self.units.value if self.units else None)
        facts = [fact for fact in (self.units, self.zeros, digits) if fact]
        return " and ".join(dict.fromkeys(fact.source for fact in facts))

    def _stronger(self, old: Fact[Value] | None, new: Fact[Value]) -> Fact[Value]:
        if old is None or old.value == new.value:
            return old or new
        self.remarks.append(Remark("contradictory-format", new.line, f"{old.source} / {new.source}"))
        return new if new.voice <= old.voice else old
