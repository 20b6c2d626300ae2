"""Where a board lies on a sheet of terminal cells: to scale, Y upwards, with zoom and pan. Without a widget.

Rule: a map is immutable; zoom and pan give another one. Places are arrays (n, 2) of X and Y in mm from the working
base; dots and cells are arrays (n, 2) of row from the top and column. A cell has 4 x 2 dots, as braille has.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drillctl.ui.widgets.dots import CELL_DOTS

Places = NDArray[np.float64]
Dots = NDArray[np.int64]
MARGIN_MM = 2.54  # of the outline around the outermost holes: a drill file says no more of the board's edge
CLOSEST = 64  # times the scale that shows the whole board
ROUTE_DOTS = 3  # from one dot of a dotted line to the next
MOST_POINTS = 200_000  # of a path; the outline of a large terminal has half as many when it is seen closest
ROUND_MM = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


@dataclass(frozen=True, eq=False)
class BoardMap:
    """A view of a board. ``low_mm``, ``high_mm``: its outline; ``centre_mm``: what is in the middle of the sheet."""

    low_mm: Places
    high_mm: Places
    columns: int
    rows: int
    centre_mm: Places
    zoom: float = 1.0

    @classmethod
    def of(cls, xy_mm: Places, columns: int, rows: int) -> "BoardMap":
        """The whole board of n > 0 holes, its outline included."""
        low_mm, high_mm = xy_mm.min(axis=0) - MARGIN_MM, xy_mm.max(axis=0) + MARGIN_MM
        return cls(low_mm, high_mm, max(columns, 1), max(rows, 1), (low_mm + high_mm) / 2)

    @property
    def dots_per_mm(self) -> float:
        """How many dots of the picture a millimetre takes, at the zoom in force."""
        down, across = CELL_DOTS
        room = np.maximum(np.array([self.columns * across, self.rows * down]) - 1, 1)
        return float((room / (self.high_mm - self.low_mm)).min()) * self.zoom

    def sized(self, columns: int, rows: int) -> "BoardMap":
        """The same place and zoom on a sheet of another size."""
        return replace(self, columns=max(columns, 1), rows=max(rows, 1))

    def zoomed(self, factor: float, at_mm: Places | None = None) -> "BoardMap":
        """Closer by ``factor``, or further below 1; the place ``at_mm`` (None: the middle) stays where it is."""
        zoom = min(max(self.zoom * factor, 1.0), CLOSEST)
        at = self.centre_mm if at_mm is None else at_mm
        return self._about(at + (self.centre_mm - at) * (self.zoom / zoom), zoom)

    def panned(self, columns: float, rows: float) -> "BoardMap":
        """Looks so many cells further to the right and down."""
        down, across = CELL_DOTS
        by_mm = np.array([columns * across, -rows * down]) / self.dots_per_mm
        return self._about(self.centre_mm + by_mm, self.zoom)

    def _about(self, centre_mm: Places, zoom: float) -> "BoardMap":
        """Around a place that is kept on the board; the whole board stays in the middle."""
        middle = (self.low_mm + self.high_mm) / 2
        reach = (self.high_mm - self.low_mm) / 2 * (1 - 1 / zoom)
        return replace(self, centre_mm=np.clip(centre_mm, middle - reach, middle + reach), zoom=zoom)

    def dots(self, xy_mm: Places) -> Dots:
        """The dot of each place; outside the sheet for places beyond it."""
        down, across = CELL_DOTS
        placed = (xy_mm - self.centre_mm) * self.dots_per_mm
        row = (self.rows * down - 1) / 2 - placed[:, 1]
        column = (self.columns * across - 1) / 2 + placed[:, 0]
        return np.floor(np.column_stack([row, column]) + 0.5).astype(np.int64)

    def cells(self, xy_mm: Places) -> Dots:
        """The cell of each place."""
        return self.dots(xy_mm) // np.array(CELL_DOTS)

    def place_mm(self, column: float, row: float) -> Places:
        """The place (2,) in the middle of a cell."""
        down, across = CELL_DOTS
        x = (column + 0.5 - self.columns / 2) * across
        y = (self.rows / 2 - row - 0.5) * down
        return self.centre_mm + np.array([x, y]) / self.dots_per_mm

    def hole_at(self, column: int, row: int, xy_mm: Places) -> int | None:
        """The index of the hole nearest to a cell; None where none is within a cell of it."""
        down, _across = CELL_DOTS
        distance = np.hypot(*(xy_mm - self.place_mm(column, row)).T)
        nearest = int(distance.argmin())
        return nearest if distance[nearest] * self.dots_per_mm <= down else None

    def grid(self, dots: Dots) -> NDArray[np.bool_]:
        """The sheet (rows, columns) in dots with these lit; those beyond it are left out."""
        down, across = CELL_DOTS
        sheet = np.zeros((self.rows * down, self.columns * across), bool)
        inside = ((dots >= 0) & (dots < np.array(sheet.shape))).all(axis=1)
        sheet[tuple(dots[inside].T)] = True
        return sheet

    def discs(self, xy_mm: Places, diameter_mm: NDArray[np.float64]) -> Dots:
        """The dots of holes as large as they are, each at least one dot."""
        middle = self.dots(xy_mm)
        found = [middle]
        for diameter in np.unique(diameter_mm):
            radius = min(diameter * self.dots_per_mm / 2, float(self.rows + self.columns))
            ring = np.arange(-int(radius), int(radius) + 1)
            offsets = np.array([(r, c) for r in ring for c in ring if r * r + c * c <= radius * radius])
            if len(offsets) > 1:
                found.append((middle[diameter_mm == diameter][:, None, :] + offsets).reshape(-1, 2))
        return np.concatenate(found)

    def path(self, xy_mm: Places, every: float = ROUTE_DOTS) -> Dots:
        """A line through places, a point ``every`` so many dots, MOST_POINTS at most; none for a single place."""
        if len(xy_mm) < 2:
            return np.zeros((0, 2), np.int64)
        length = np.hypot(*np.diff(xy_mm, axis=0).T) * self.dots_per_mm
        along = np.concatenate([[0.0], np.cumsum(length)])
        at = np.arange(0.0, min(float(along[-1]), every * MOST_POINTS), every)
        return self.dots(np.column_stack([np.interp(at, along, axis) for axis in xy_mm.T]))

    def outline(self) -> Dots:
        """The dots of the outline."""
        (left, low), (right, high) = self.low_mm, self.high_mm
        corners = np.array([[left, low], [right, low], [right, high], [left, high], [left, low]])
        return self.path(corners, every=0.5)  # no dot of it is left out


def round_mm(least_mm: float) -> float:
    """The least round length that is not below ``least_mm``; the longest one there is for more."""
    return next((length for length in ROUND_MM if length >= least_mm), ROUND_MM[-1])


def marks_mm(low_mm: float, high_mm: float, step_mm: float) -> list[float]:
    """The multiples of a step from ``low_mm`` to ``high_mm``, both included."""
    first, last = int(np.ceil(low_mm / step_mm - 1e-9)), int(np.floor(high_mm / step_mm + 1e-9))
    return [number * step_mm for number in range(first, last + 1)]
