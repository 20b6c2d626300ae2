"""The tools of one file. Rule: a tool is an entry in order of definition; a number may be defined again by
a second header, and then names the newer entry. machine.py defines and selects, checks.py judges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .errors import Complaint
from .facts import Facts, Voice
from .model import Tool

NO_TOOL = -1
NUMBER_LIMIT = 9999
SAME_MM = 0.002  # two units and their rounding
LARGEST_MM = 500.0  # a routed opening listed as a tool may be wide (139.7 mm seen), a metre is an error


@dataclass
class Entry:
    """diameter in units of mm millimetres, 0 where none were declared yet; None where not told.

    places: decimals the diameter was written with; in_body: defined where it is used.
    """

    number: int
    diameter: float | None
    mm: float
    line: int
    places: int = 0
    in_body: bool = False

    def diameter_mm(self, default_mm: float) -> float | None:
        """Diameter in millimetres; default_mm: millimetres per unit of the file as a whole."""
        return None if self.diameter is None else round(self.diameter * (self.mm or default_mm), 6)

    def same_size(self, other: Entry) -> bool:
        """Whether both mean one drill, as far as their units are known."""
        assert self.diameter is not None and other.diameter is not None
        return math.isclose(self.diameter * (self.mm or 1.0), other.diameter * (other.mm or 1.0), abs_tol=SAME_MM)

    def usable(self, default_mm: float) -> bool:
        """Whether something of this diameter can drill; an unknown diameter can."""
        diameter_mm = self.diameter_mm(default_mm)
        return diameter_mm is None or 0 < diameter_mm <= LARGEST_MM


class Toolbox:
    """All definitions, and the tool in the spindle (index into entries or NO_TOOL)."""

    def __init__(self, facts: Facts) -> None:
        self.entries: list[Entry] = []
        self.current = NO_TOOL
        self._facts = facts
        self._latest: dict[int, int] = {}
        self._spelled: dict[str, int] = {}
        self._declared_any = self._selected_any = False
        self._announced = 0  # how many of the sizes announced without T numbers were taken

    def number(self, digits: str, *, defines: bool) -> int:
        """Which tool the digits behind T mean. Complaint for none, and for four that could mean two tools.

        T0302 is tool 3 with compensation index 2 (CNC-7 manual); T1000 is tool 1000 where tools beyond 99 are
        defined, or where a definition is spelled so.
        """
        if not digits.isdigit() or int(digits) > NUMBER_LIMIT:
            raise Complaint("bad-tool-number", f"T{digits}")
        if digits in self._spelled:
            return self._spelled[digits]
        whole, first = int(digits), int(digits[:2])
        if len(digits) < 4 or digits.startswith("00") or (defines and self._beyond_99()):
            return whole
        if defines or not self.known(whole):
            return first
        if self.known(first):
            raise Complaint("ambiguous-tool", f"T{digits}: T{first} or T{whole}")
        return whole

    def _beyond_99(self) -> bool:
        return any(number > 99 for number in self._latest) or any(len(digits) > 3 for digits in self._spelled)

    def define(self, entry: Entry, digits: str, *, replace: bool) -> bool:
        """A definition spelled with these digits; whether it gives the number another diameter.

        The same number with another diameter needs `replace` (a new header), or two definitions in the body.
        """
        self._declared_any = True
        self._spelled[digits] = entry.number
        at = self._latest.get(entry.number)
        if at is None:
            self._add(entry)
            return False
        known = self.entries[at]
        if known.diameter is None:
            self.entries[at] = entry
            return False
        if entry.diameter is None or known.same_size(entry):
            return False
        if not replace and not (known.in_body and entry.in_body):
            raise Complaint("tool-redefined", f"T{entry.number}")
        self._add(entry)
        return not replace

    def known(self, number: int) -> bool:
        """Whether the header, a comment or a report defines the number."""
        return number in self._latest or number in self._facts.sizes

    def select(self, number: int, line: int) -> None:
        """T in the body. An undefined T0 empties the spindle; a file without definitions defines by use."""
        self._selected_any = True
        if number == 0 and number not in self._latest:
            self.current = NO_TOOL
            return
        if number not in self._latest:
            self.current = NO_TOOL
            if self._declared_any and number not in self._facts.sizes:
                raise Complaint("undefined-tool", f"T{number}")
            self._add(Entry(number, None, 0.0, line))
        self.current = self._latest[number]

    def first_announced(self) -> None:
        """Before the first hole: Allegro leaves out every T where its comments list the tools in order of use."""
        if self._listed() and not (self._announced or self._selected_any or self._declared_any):
            self._announced = 1
            self._take_announced()

    def next_announced(self) -> None:
        """M00 in such a file: the next tool of the list."""
        if self._announced and not self._selected_any:
            self._announced += 1
            self._take_announced()

    def _listed(self) -> list[int]:
        """The tools that the comments list."""
        return sorted(number for number, size in self._facts.sizes.items() if size.voice == Voice.COMMENT)

    def _take_announced(self) -> None:
        numbers = self._listed()
        if self._announced > len(numbers):
            self.current = NO_TOOL
            return
        self._add(Entry(numbers[self._announced - 1], None, 0.0, 1))
        self.current = len(self.entries) - 1

    def _add(self, entry: Entry) -> None:
        self._latest[entry.number] = len(self.entries)
        self.entries.append(entry)

    def complete(self) -> None:
        """Give tools without a diameter the one that comments or reports tell."""
        for entry in self.entries:
            size = self._facts.sizes.get(entry.number)
            if entry.diameter is None and size:
                entry.diameter, entry.mm = size.diameter, size.mm

    def finished(self, default_mm: float) -> tuple[Tool, ...]:
        """The tools with their diameters in millimetres; unusable ones have none."""
        return tuple(
            Tool(entry.number, entry.diameter_mm(default_mm) if entry.usable(default_mm) else None)
            for entry in self.entries
        )
