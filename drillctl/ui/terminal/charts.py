"""Pictures of numbers in characters: curves as braille dots between labelled axes. Functions of a record and a size.

Rule: where there are several, every curve has a letter in it, by which the legend names it; on a terminal a colour too.
The colours are control characters of this program's own: words are escaped here, before they are painted.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from string import ascii_lowercase

import numpy as np
from numpy.typing import NDArray

from drillctl.language import visible
from drillctl.ui.terminal.heat import heat_lines
from drillctl.ui.widgets.dots import BRAILLE, CELL_DOTS, braille_cells
from drillctl.viewmodel.reports import BoardPlan, Chart, Curve, Floats, HeatMap, Picture, Style

MARGIN = 10  # characters left of a chart, for the numbers
LEAST_COLUMNS = MARGIN + 10
COLOURS = tuple(f"\x1b[{code}m" for code in (36, 33, 35, 32, 31, 34))  # ECMA-48
NO_COLOUR = "\x1b[0m"
NO_DOTS = chr(BRAILLE)


@dataclass(frozen=True, slots=True)
class ChartLook:
    """The size of a chart in characters, and what the terminal can show."""

    columns: int
    rows: int
    coloured: bool = False
    plain: bool = False  # ASCII alone


def picture_lines(picture: Picture, look: ChartLook) -> list[str]:
    """Title, charts and notes. Narrower than LEAST_COLUMNS it is drawn as wide as that."""
    lines = [visible(picture.title)]
    for chart in picture.charts:
        if isinstance(chart, HeatMap):
            lines += ["", *heat_lines(chart, max(look.columns, LEAST_COLUMNS), look.plain)]
        else:
            plain = chart.as_chart() if isinstance(chart, BoardPlan) else chart
            lines += ["", *_chart_lines(plain, look)]
    return [*lines, "", *map(visible, picture.notes)]


def _chart_lines(chart: Chart, look: ChartLook) -> list[str]:
    curves = [_stepped(curve) for curve in chart.curves]
    points = np.concatenate([np.column_stack((curve.x, curve.y)) for curve in curves])
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return [f"{visible(chart.y_label)}: nothing to be drawn"]
    frame = _Frame.around(points, chart.to_scale, look)
    top, bottom = (f"{value:>{MARGIN - 2}.4g} |" for value in (frame.high[1], frame.low[1]))
    rows = frame.drawn(curves, look)
    sides = [top, *[" " * (MARGIN - 1) + "|"] * (len(rows) - 2), bottom]
    body = [side + row for side, row in zip(sides, rows, strict=True)]
    left, right = (f"{value:.4g}" for value in (frame.low[0], frame.high[0]))
    foot = " " * MARGIN + left + right.rjust(frame.columns - len(left))
    return [*_head(chart, look), *body, foot, visible(chart.x_label).rjust(MARGIN + frame.columns)]


def _head(chart: Chart, look: ChartLook) -> list[str]:
    """What is drawn upwards, and the legend: beside it, or below where there is no room."""
    upwards = visible(chart.y_label)
    names = [f"{_letter(number, chart.curves)} {visible(curve.label)}" for number, curve in enumerate(chart.curves)]
    legend = [_painted(name, number, look) for number, name in enumerate(names)]
    if len("   ".join((upwards, *names))) <= max(look.columns, LEAST_COLUMNS):
        return ["   ".join((upwards, *legend))]
    return [upwards, *legend]


def _letter(number: int, curves: Sequence[Curve]) -> str:
    return ascii_lowercase[number % len(ascii_lowercase)] if len(curves) > 1 else "--"


def _painted(text: str, number: int, look: ChartLook) -> str:
    return COLOURS[number % len(COLOURS)] + text + NO_COLOUR if look.coloured else text


@dataclass(frozen=True, eq=False, slots=True)
class _Frame:
    """Where values fall among the dots of a chart: ``low`` and ``high`` are its corners (x, y)."""

    low: Floats
    high: Floats
    columns: int
    rows: int

    @classmethod
    def around(cls, points: Floats, to_scale: bool, look: ChartLook) -> "_Frame":
        """All points (n, 2), n > 0, with room for a value that never changes."""
        low, high = points.min(axis=0), points.max(axis=0)
        same = high == low
        low, high = np.where(same, low - 1, low), np.where(same, high + 1, high)
        columns, rows = max(look.columns, LEAST_COLUMNS) - MARGIN, max(look.rows, 2)
        if to_scale:  # a cell's dots are as far apart upwards as sideways
            dots_per_mm = ((np.array([columns, rows]) * CELL_DOTS[::-1] - 1) / (high - low)).min()
            columns, rows = np.maximum(np.ceil((high - low) * dots_per_mm / CELL_DOTS[::-1]), 2).astype(int).tolist()
        return cls(low, high, columns, rows)

    def drawn(self, curves: Sequence[Curve], look: ChartLook) -> list[str]:
        """Rows of characters from the top; a cell has the colour of the last curve in it."""
        shape = (self.rows * CELL_DOTS[0], self.columns * CELL_DOTS[1])
        grid, owner = np.zeros(shape, bool), np.zeros((self.rows, self.columns), int)
        letters: dict[tuple[int, int], str] = {}
        for number, curve in enumerate(curves):
            down, across = self._dots(curve, shape)
            grid[down, across] = True
            cells = down // CELL_DOTS[0], across // CELL_DOTS[1]
            owner[cells] = number
            if len(curves) > 1 and len(down):
                place = _lettered(*cells, (2 * number + 1) * self.columns // (2 * len(curves)))
                letters[place] = _painted(_letter(number, curves), number, look)
        rows = [_row(*row, look) for row in zip(braille_cells(grid), owner.tolist(), strict=True)]
        for (row, column), letter in letters.items():
            rows[row][column] = letter
        return ["".join(row) for row in rows]

    def _dots(self, curve: Curve, shape: tuple[int, int]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Row and column of each dot that a curve goes through."""
        most = np.array([shape[1] - 1, shape[0] - 1])
        places = (np.column_stack((curve.x, curve.y)) - self.low) / (self.high - self.low) * most
        if curve.style is not Style.POINTS:
            places = _joined(places)
        across, up = np.rint(places[np.isfinite(places).all(axis=1)]).astype(int).T
        return shape[0] - 1 - up, across


def _lettered(down: NDArray[np.int64], across: NDArray[np.int64], wanted: int) -> tuple[int, int]:
    """The cell for a curve's letter: of its own the nearest to this column, which is another one for every curve."""
    nearest = int(np.abs(across - wanted).argmin())
    return int(down[nearest]), int(across[nearest])


def _row(cells: Sequence[str], owners: Sequence[int], look: ChartLook) -> list[str]:
    if look.plain:
        return [" " if cell == NO_DOTS else "*" for cell in cells]
    return [_painted(cell, owner, look) for cell, owner in zip(cells, owners, strict=True)]


def _stepped(curve: Curve) -> Curve:
    """A curve of stairs as a line with corners; any other curve as it is."""
    if curve.style is not Style.STAIRS:
        return curve
    return Curve(curve.label, np.repeat(curve.x, 2)[1:], np.repeat(curve.y, 2)[:-1])


def _joined(places: Floats) -> Floats:
    """Points (n, 2) with as many between them as leave no dot out; a point that is no number breaks the line."""
    step = np.diff(places, axis=0)
    whole = np.isfinite(step).all(axis=1)
    step, begin = step[whole], places[:-1][whole]
    parts = np.maximum(np.ceil(np.abs(step).max(axis=1)), 1).astype(int)
    part = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    between = np.repeat(begin, parts, axis=0) + np.repeat(step / parts[:, None], parts, axis=0) * part[:, None]
    return np.concatenate((between, places))
