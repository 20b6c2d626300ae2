"""One number, read three ways. Rule: the format is not needed to read a file, only to measure it.

`025` is 25 units counted from the right (leading zeros dropped: times 10^-decimals), or 0.025 of the
whole field counted from the left (trailing zeros dropped: times 10^integers), and `0.25` is itself.
Each written number becomes the triple (from right, from left, with point); a sum of triples times
`FormatChoice.weights()` is a length for every format, so a format may be chosen, and changed, after
the whole program has run. machine.py reads with it, score.py weighs with it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .model import Floats, Integers

# No format has more than 10 digits; 15 keep a number exact. Longer ones do not match and are refused.
# Possessive (++): what a number has taken it keeps, which makes a run of lines twice as quick to find.
NUMBER = r"[+-]?+(?:\d{1,15}+(?:\.\d{0,20}+)?+|\.\d{1,20}+)"
POINT = 2  # index of the reading with a decimal point in the triple


class Evidence:
    """The numbers without a point, as written: what tells which zeros were dropped.

    whole: their absolute value; length: their count of digits; decimals: how many had a point.
    """

    def __init__(self) -> None:
        self._whole: list[Floats] = [np.empty(0)]
        self._length: list[Integers] = [np.empty(0, dtype=np.int64)]
        self.decimals = 0

    def add(self, whole: Floats, length: Integers) -> None:
        """Numbers without a point, as they were written."""
        self._whole.append(whole)
        self._length.append(length)

    @property
    def whole(self) -> Floats:
        """Absolute values (n,) of all numbers without a point."""
        return np.concatenate(self._whole)

    @property
    def length(self) -> Integers:
        """Their counts of digits (n,)."""
        return np.concatenate(self._length)


def read_numbers(words: Sequence[str], evidence: Evidence) -> Floats:
    """Triples (n, 3) of n words that match NUMBER; what they tell is added to the evidence."""
    value = np.array(list(map(float, words)))
    triples = np.zeros((len(words), 3))
    points = "".join(words).count(".")
    evidence.decimals += points
    if points == len(words):  # the commonest file by far
        triples[:, POINT] = value
        return triples
    has_point = np.array(["." in word for word in words])
    triples[has_point, POINT] = value[has_point]
    whole = value[~has_point]
    length = np.array([len(word) - (word[0] in "+-") for word in words])[~has_point]
    triples[~has_point, 0] = whole
    triples[~has_point, 1] = whole / 10.0**length
    evidence.add(abs(whole), length)
    return triples
