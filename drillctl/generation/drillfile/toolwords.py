"""The T word: which tool, and what is said of it. Rule: a diameter in a unit of its own counts in that unit.

`commands` calls `tool` for every T; tools.py keeps the definitions.
"""

from __future__ import annotations

import re

from .errors import Complaint
from .lexer import UNITS_BEHIND, Word
from .machine import Machine
from .tools import Entry

PARAMETERS = "CFSHBZ"  # diameter, feed, speed, hits, retract rate, depth offset


def tool(machine: Machine, words: list[Word]) -> None:
    """T with C defines (in the body it also selects); without C it selects, in a header it announces."""
    digits = words.pop(0).number
    parameters = _parameters(words)
    if words and words[0].letter == "T":
        raise Complaint("misplaced-word", f"{words[0]} behind T{digits}")
    defines = "C" in parameters
    number = machine.tools.number(digits, defines=machine.in_header or defines)
    announced = machine.in_header and not machine.tools.known(number)
    if defines or announced:
        _define(machine, number, digits, parameters)
    if not machine.in_header or not (defines or announced):
        machine.select(number)


def _parameters(words: list[Word]) -> dict[str, str]:
    """The words about the tool that come next. Complaint for a second diameter."""
    parameters: dict[str, str] = {}
    while words and words[0].letter in PARAMETERS:
        word = words.pop(0)
        if word.letter == "C" in parameters:
            raise Complaint("bad-diameter", f"C{parameters['C']} and {word}")
        parameters[word.letter] = word.number
    return parameters


def _define(machine: Machine, number: int, digits: str, parameters: dict[str, str]) -> None:
    entry = Entry(number, None, machine.mm, machine.line, in_body=not machine.in_header)
    if "C" in parameters:
        _set_diameter(entry, parameters["C"])
    if machine.tools.define(entry, digits, replace=machine.headers > 1):
        machine.remark("tool-size-changes", f"T{digits}C{parameters['C']}")


def _set_diameter(entry: Entry, written: str) -> None:
    """Complaint for no number, a negative one, and digits without a point whose zeros would have to be guessed."""
    found = re.fullmatch(r"(\+?[\d.]+)(\D*)", written)
    if not found:
        raise Complaint("bad-diameter", f"C{written}")
    number, unit = found.groups()
    if "." not in number and number.startswith("0") and number.strip("0"):
        raise Complaint("diameter-without-point", f"C{written}")
    entry.diameter, entry.places = float(number), len(number.partition(".")[2])
    if unit:
        entry.mm = UNITS_BEHIND[unit]
