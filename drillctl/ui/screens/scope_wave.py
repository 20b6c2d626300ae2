"""Waves in characters: a line for a wire, one for numbers or words, a ruler of ticks. Functions of strips and sizes.

Rule: what can't be drawn is said, never left out: a column in which a wire changed more than once shows a busy sign, a
number for which there is no room shows a dot, never some of its digits. Numbers that change too often for digits are a
curve, but only where every tick has its column, or where they change by a step a tick at most, as a place does: a curve
of some of the ticks of any other could show what was not there.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.viewmodel.scope import Strip

LABEL_EVERY = 12  # columns of the ruler


class Signs(NamedTuple):
    """The characters that waves are drawn with."""

    low: str
    high: str
    edge: str
    busy: str
    hidden: str
    cut: str
    cursor: str


LEVELS = {False: "▁▂▃▄▅▆▇█", True: "_.-=+*%@"}  # from the lowest value that is drawn to the highest
SIGNS = {False: Signs("▁", "▔", "│", "▒", "·", "…", "▼"), True: Signs("_", "-", "|", "#", ".", "~", "v")}


def wire_line(strip: Strip, exact: bool, plain: bool = False) -> str:
    """A character a column: low, high, an edge, or busy with several. ``exact``: no column has more than a tick, so
    that each shows its level."""
    codes = (strip.values != 0).astype(np.int64)
    if not exact:
        edges = np.minimum(strip.changes, 2)
        codes = np.where(edges > 0, edges + 1, codes)
    return "".join(map(SIGNS[plain].__getitem__, codes.tolist()))


def word_line(strip: Strip, shown: Callable[[int, int], str], may_cut: bool, plain: bool = False) -> str:
    """Each value behind the edge at which it came.

    shown    makes a word of a column and the value there
    may_cut  for words, of which the beginning tells something
    """
    signs = SIGNS[plain]
    starts = np.flatnonzero(strip.changes)
    starts = starts if len(starts) and starts[0] == 0 else np.append(0, starts)
    ends = np.append(starts[1:], len(strip.values))
    parts = []
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        changes = int(strip.changes[start]) if len(strip.values) else 0
        mark = (signs.edge if changes == 1 else signs.busy) if changes else ""
        room = end - start - len(mark)
        text = shown(start, int(strip.values[start])) if room > 0 else ""
        parts.append(mark + fitted(text, room, may_cut, signs))
    return "".join(parts)


def number_line(strip: Strip, shown: Callable[[int, int], str], curved: bool, plain: bool = False) -> str:
    """Numbers as ``word_line`` has them; a curve where there is no room for most of them, and it may be ``curved``."""
    line = word_line(strip, shown, may_cut=False, plain=plain)
    signs = SIGNS[plain]
    without_digits = sum(map(line.count, (signs.edge, signs.busy, signs.hidden)))
    return level_line(strip, plain) if curved and 2 * without_digits > len(line) else line


def level_line(strip: Strip, plain: bool = False) -> str:
    """How high the value of each column is, between the lowest and the highest of them."""
    levels = LEVELS[plain]
    low, high = int(strip.values.min()), int(strip.values.max())
    codes = np.round((strip.values - low) * (len(levels) - 1) / max(1, high - low)).astype(np.int64)
    return "".join(np.array(list(levels))[codes].tolist())


def fitted(text: str, room: int, may_cut: bool, signs: Signs) -> str:
    """Text in exactly so many columns: with a sign where some of it is cut off, hidden where that is not allowed."""
    if len(text) <= room:
        return f"{text:{room}}"
    return text[: room - 1] + signs.cut if may_cut and room > 1 else signs.hidden * room


def ruler(edges: NDArray[np.int64], columns: int, marks: Sequence[tuple[int, str]]) -> str:
    """Ticks in round numbers, behind an edge each; ``marks`` (column, sign) lie over them."""
    cells = [" "] * columns
    if len(edges) > 1:
        for column, tick in _labels(edges):
            label = f"|{tick}"
            if column + len(label) <= columns:
                cells[column : column + len(label)] = label
    for column, sign in marks:
        if 0 <= column < columns:
            cells[column] = sign
    return "".join(cells)


def _labels(edges: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Column and tick of each label: multiples of 1, 2 or 5 times a power of ten."""
    wanted = max(1.0, float(edges[-1] - edges[0]) * LABEL_EVERY / (len(edges) - 1))
    power = 10 ** int(np.floor(np.log10(wanted)))
    every = next(digit * power for digit in (1, 2, 5, 10) if digit * power >= wanted)
    first = -(-int(edges[0]) // every) * every
    ticks = np.arange(first, int(edges[-1]), every)
    columns = np.searchsorted(edges, ticks, side="right") - 1
    return [*zip(columns.tolist(), ticks.tolist(), strict=True)]
