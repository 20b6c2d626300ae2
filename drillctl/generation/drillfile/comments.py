"""What CAD programs say beside the commands. Rule: a table of patterns whose group names are the meaning.

Comments inside a drill file and the reports written beside it speak alike, so both are read here, line by
line: integer, decimal (places), units, zeros; tool, size, size_units, count. commands.py and sidefiles.py
call `hear`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from .facts import Fact, Facts, Size, Voice
from .model import MM_PER_UNIT

Patterns = tuple[re.Pattern[str], ...]


def patterns(*expressions: str) -> Patterns:
    """The expressions compiled, blind to capitals."""
    return tuple(re.compile(expression, re.I) for expression in expressions)


# The writer of each pattern is named; group names are listed above.
COMMENT_PATTERNS = patterns(
    # Altium, Protel, EasyEDA, P-CAD: ;FILE_FORMAT=4:4
    r"FILE_FORMAT\s*=\s*(?P<integer>\d):(?P<decimal>\d)",
    # KiCad: ; FORMAT={2:4/ absolute / inch / suppress leading zeros}, or -:- and decimal
    r"FORMAT=\{(?:(?P<integer>\d):(?P<decimal>\d)|-:-)\s*/[\w ]+/\s*(?P<units>\w+)\s*/\s*(?P<zeros>[\w ]+)\}",
    # Mentor Xpedition: ; Format  : 3.3 / Absolute / MM / Leading
    r"Format\s*:\s*(?P<integer>\d)\.(?P<decimal>\d)\s*/[\w ]+/\s*(?P<units>\w+)\s*/\s*(?P<zeros>\w+)",
    # Allegro: ;T01 Holesize 1. = 8.000000 Tolerance = +3.0/-3.0 PLATED MILS Quantity = 801
    r"(?:T(?P<tool>\d+)\s+)?Holesize\s+(?P<index>\d+)\.\s*=\s*(?P<size>\d+\.?\d*)"
    r".*\s(?P<size_units>\w+)\s+Quantity\s*=\s*(?P<count>\d+)",
    # anybody
    r"^\W*Format\s*[:=]\s*(?P<integer>\d)[.:](?P<decimal>\d)\s*$",
    r"^\W*Units?\s*[:=]\s*(?P<units>[A-Z]+)\s*$",
)

MM_PER_WORD = {
    "inch": 25.4, "inches": 25.4, "in": 25.4, "english": 25.4, "imperial": 25.4,
    "mm": 1.0, "metric": 1.0, "millimeter": 1.0, "millimeters": 1.0,
    "mil": 0.0254, "mils": 0.0254, "thou": 0.0254,
}  # fmt: skip
ZEROS = {
    "leading": "leading", "suppress leading zeros": "leading",
    "trailing": "trailing", "suppress trailing zeros": "trailing",
    "none": "none", "keep zeros": "none",
}  # fmt: skip
LONGEST_COMMENT = 300  # no CAD program says more about its format in a line; bounds the patterns' work


def hear(text: str, line: int, facts: Facts) -> None:
    """Note what one comment of the drill file declares."""
    groups = find(text, COMMENT_PATTERNS)
    if groups:
        declare(groups, f";{text.strip()}", line, Voice.COMMENT, facts)


def find(text: str, patterns: Patterns) -> dict[str, str]:
    """The groups of the first pattern found in the line that say something."""
    for pattern in patterns:
        if match := pattern.search(text[:LONGEST_COMMENT]):
            return {name: value for name, value in match.groupdict().items() if value}
    return {}


def declare(groups: Mapping[str, str], source: str, line: int | None, voice: Voice, facts: Facts) -> None:
    """Turn found groups into facts; unknown words declare nothing."""
    if "integer" in groups and "decimal" in groups:
        digits = int(groups["integer"]), int(groups["decimal"])
        facts.declare_digits(Fact(digits, voice, line, source), _units(groups))
    if units := _units(groups):
        facts.declare_units(Fact(units, voice, line, source))
    if zeros := ZEROS.get(groups.get("zeros", "").strip().lower()):
        facts.declare_zeros(Fact(zeros, voice, line, source))
    if "size" in groups:
        number = int(groups.get("tool") or groups.get("index", "0"))
        facts.declare_size(number, _size(groups, voice))


def _units(groups: Mapping[str, str]) -> str | None:
    mm = MM_PER_WORD.get(groups.get("units", "").lower())
    return next((name for name, factor in MM_PER_UNIT.items() if factor == mm), None)


def _size(groups: Mapping[str, str], voice: Voice) -> Size:
    count = int(groups["count"]) if "count" in groups else None
    mm = MM_PER_WORD.get(groups.get("size_units", "").lower(), 0.0)
    return Size(float(groups["size"]), mm, count, voice)
