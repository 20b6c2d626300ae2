"""The tools of one file. Rule: a tool is an entry in order of definition; a number may be defined again by
a second header, and then names the newer entry. machine.py defines and selects, checks.py judges.
"""

from __future__ import annotations

from dataclasses import dataclass

from .errors import Refusal
from .facts import Facts
from .model import Tool

NO_TOOL = -1
NUMBER_LIMIT = 9999
LARGEST_MM = 500.0  # a routed opening listed as a tool may be wide (139.7 mm seen), a metre is an error


@dataclass
class Entry:
    """diameter in units of mm millimetres, 0 where none were declared yet; None where not told.

    places: decimals the diameter was written with.
    """

    number: int
    diameter: float | None
    mm: float
    line: int
    places: int = 0

    def diameter_mm(self, default_mm: float) -> float | None:
        """Diameter in millimetres; default_mm: millimetres per unit of the file as a whole."""
        return None if self.diameter is None else round(self.diameter * (self.mm or default_mm), 6)

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
        self._declared_any = False

    def define(self, entry: Entry, *, replace: bool) -> None:
        """A definition; the same number with another diameter needs `replace` (a new header, or the body)."""
        self._declared_any = True
        known = self._latest.get(entry.number)
        if known is None:
            self._add(entry)
        elif self.entries[known].diameter is None:
            self.entries[known] = entry
        elif entry.diameter not in (None, self.entries[known].diameter):
            if not replace:
                raise Refusal("tool-redefined", f"T{entry.number}")
            self._add(entry)

    def known(self, number: int) -> bool:
        """Whether the header, a comment or a report defines the number."""
        return number in self._latest or number in self._facts.sizes

    def select(self, number: int, line: int) -> None:
        """T in the body. An undefined T0 empties the spindle; a file without definitions defines by use."""
        if number == 0 and number not in self._latest:
            self.current = NO_TOOL
            return
        if number not in self._latest:
            self.current = NO_TOOL
            if self._declared_any and number not in self._facts.sizes:
                raise Refusal("undefined-tool", f"T{number}")
            self._add(Entry(number, None, 0.0, line))
        self.current = self._latest[number]

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
