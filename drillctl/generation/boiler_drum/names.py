"""How a part program is named: a file by its ending, a workpiece of a store by two digits.

Rule: nothing else is imported, so that a verb may look at a name before it knows what it has to read.
"""

import re
from pathlib import Path

ENDING = ".sentences"
_NUMBER = re.compile(r"0[1-9]|[1-9][0-9]", re.ASCII)


def is_sentences(path: Path) -> bool:
    """Returns whether a file is named as a part program."""
    return path.suffix.lower() == ENDING


def number_of(text: str) -> int | None:
    """Returns the number of a workpiece, 01 to 99 in two digits; None for any other text."""
    return int(text) if _NUMBER.fullmatch(text) else None
