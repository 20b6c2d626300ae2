"""Numbers of the scope as curves: positions with the speed below, currents, whatever counts.

Rule: a column shows the least and the greatest value that its ticks have, so that no peak is left out; where more than
MOST_CHANGES are in view, the values at the ends of the columns. A speed is a step over the ticks since the one before.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.language.words import _
from drillctl.ui.screens.scope_measure import POSITION
from drillctl.ui.widgets.curves import span_rows
from drillctl.ui.widgets.dots import CELL_DOTS
from drillctl.viewmodel.scope import Ints, ScopeSignal, ScopeSource

CURVE_LINES = 3
MOST_CHANGES = 100_000  # looked at one by one
LOOK_BACK_S = 1  # for the step before the first in view
Floats = NDArray[np.float64]


def height_of(signal: ScopeSignal) -> int:
    """The lines that a signal has as a curve: a position has its speed below; 1 where it is no number."""
    if signal.shape != "count":
        return 1
    return 2 * CURVE_LINES if signal.name == POSITION else CURVE_LINES


def curve_lines(
    source: ScopeSource, row: int, edges: Ints, columns: int, height: int, plain: bool
) -> list[tuple[str, str]]:
    """``height`` lines of a label and ``columns`` characters; empty ones as far as the signal is not known."""
    if len(edges) < 2:
        return [("", " " * columns)] * height
    ticks, values = _changes(source, row, int(edges[0]), int(edges[-1]))
    lines = _drawn(_spans(ticks, values, edges), columns, plain, "")
    if height > CURVE_LINES:
        speeds = _spans(*_speeds(source, row, edges), edges)
        lines += _drawn(speeds, columns, plain, _("steps/s"))
    return lines


def _changes(source: ScopeSource, row: int, first: int, last: int) -> tuple[Ints, Floats]:
    """The ticks at which the signal changes, and its value from there on; the first stands at the window's begin."""
    if int(source.strip(row, np.array([first, last])).changes[0]) <= MOST_CHANGES:
        found = source.window(row, first, last)
        return found.ticks, found.values.astype(float)
    ends = np.linspace(first, last, MOST_CHANGES // 100).astype(np.int64)
    return ends[:-1], source.strip(row, ends).values.astype(float)


def _speeds(source: ScopeSource, row: int, edges: Ints) -> tuple[Ints, Floats]:
    """The ticks at which the speed changes, in steps a second from there on: as many as in ``_changes``."""
    margin = LOOK_BACK_S * source.tick_hz
    first = max(source.first_tick, int(edges[0]) - margin)
    last = min(source.known_to(row), int(edges[-1]) + margin)
    ticks, values = _changes(source, row, first, last)
    speeds = np.diff(values) / np.maximum(np.diff(ticks), 1) * source.tick_hz
    return ticks, np.append(speeds, 0.0)


def _spans(ticks: Ints, values: Floats, edges: Ints) -> Floats:
    """(columns, 3): the least and the greatest value of each column, and the one at the end of the column before."""
    if not len(values):
        return np.zeros((len(edges) - 1, 3))
    begins = np.clip(np.searchsorted(ticks, edges[:-1], side="right") - 1, 0, None)
    ends = np.maximum(np.searchsorted(ticks, edges[1:], side="left"), begins + 1)
    parts = [values[begin:end] for begin, end in zip(begins.tolist(), ends.tolist(), strict=True)]
    before = [parts[0][0], *(part[-1] for part in parts[:-1])]
    return np.column_stack([[part.min() for part in parts], [part.max() for part in parts], before])


def _drawn(spans: Floats, columns: int, plain: bool, unit: str) -> list[tuple[str, str]]:
    low, high = float(spans.min()), float(spans.max())
    dots = np.repeat(spans, 1 if plain else CELL_DOTS[1], axis=0)
    rows = [f"{row:{columns}}" for row in span_rows(dots, CURVE_LINES, plain, (low, high))]
    labels = [unit, *[""] * (CURVE_LINES - 2), f"{low:g}..{high:g}"]
    if not unit:
        labels[1], labels[-1] = labels[-1], labels[1]
    return [*zip(labels, rows, strict=True)]
