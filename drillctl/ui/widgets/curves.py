"""A curve of numbers over columns, several rows high: braille dots, or ASCII where the terminal has no more.

Rule: a column shows every value that falls into it, from its least to its greatest, joined to the column before, so
that no peak is left out however many values there are.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drillctl.ui.widgets.dots import CELL_DOTS, braille_cells

PLAIN_DOT = "*"


def curve_rows(
    values: Sequence[float], columns: int, rows: int, plain: bool = False, bounds: tuple[float, float] | None = None
) -> list[str]:
    """``rows`` texts of ``columns``, the greatest value on top. ``bounds``: the values of the lowest and the highest
    row of dots; without them, those of the curve.
    """
    if not len(values) or columns < 1 or rows < 1:
        return [" " * max(columns, 0)] * max(rows, 0)
    spans = _spans(np.asarray(values, float), columns * (1 if plain else CELL_DOTS[1]))
    return span_rows(spans, rows, plain, bounds or (min(values), max(values)))


def span_rows(spans: NDArray[np.float64], rows: int, plain: bool, bounds: tuple[float, float]) -> list[str]:
    """As ``curve_rows``, of columns of dots (n, any): each has a dot wherever it has a value between its least and its
    greatest. There are two columns of dots to a character, one without UTF-8.
    """
    low, high = bounds
    down = 1 if plain else CELL_DOTS[0]
    heights = np.clip((spans - low) / ((high - low) or 1.0), 0.0, 1.0) * (rows * down - 1)
    tops, bottoms = (np.rint(height).astype(int) for height in (heights.max(axis=1), heights.min(axis=1)))
    levels = np.arange(rows * down)[::-1, None]
    grid = (levels <= tops) & (levels >= bottoms)
    if plain:
        return ["".join(PLAIN_DOT if dot else " " for dot in row) for row in grid.tolist()]
    return ["".join(row).replace("\u2800", " ") for row in braille_cells(grid)]


def _spans(values: NDArray[np.float64], columns: int) -> NDArray[np.float64]:
    """(columns, 3): the least and the greatest value of each column, and the last one of the column before."""
    edges = np.linspace(0, len(values), columns + 1)
    firsts = np.minimum(edges[:-1].astype(int), len(values) - 1)
    lasts = np.maximum(np.minimum(np.ceil(edges[1:]).astype(int), len(values)), firsts + 1)
    parts = [values[first:last] for first, last in zip(firsts, lasts, strict=True)]
    least, greatest = [part.min() for part in parts], [part.max() for part in parts]
    before = [parts[0][0], *(part[-1] for part in parts[:-1])]
    return np.column_stack([least, greatest, before])
