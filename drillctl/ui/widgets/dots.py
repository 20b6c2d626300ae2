"""Points drawn in the terminal as braille dots, to scale, Y upwards. Functions of points and a size."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# A braille cell has 2 x 4 dots; bit of each dot, column by column from the top (Unicode 5, block 2800).
DOT_BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
BRAILLE = 0x2800
CELL_DOTS = (4, 2)


@dataclass(frozen=True, eq=False)
class Sheet:
    """Where millimetres fall on a sheet of terminal cells, as many as the points need: ``height`` x ``width`` dots."""

    low_mm: NDArray[np.float64]
    dots_per_mm: float
    height: int
    width: int

    @classmethod
    def fitted(cls, xy_mm: NDArray[np.float64], columns: int, rows: int) -> "Sheet":
        """The largest to scale that shows all points (n, 2), n > 0, in so many cells."""
        low_mm, span_mm = xy_mm.min(axis=0), np.ptp(xy_mm, axis=0)
        room = np.array([columns * CELL_DOTS[1] - 1, rows * CELL_DOTS[0] - 1])
        scale = min((d / s for d, s in zip(room, span_mm, strict=True) if s > 0), default=1.0)
        last = np.rint(span_mm * scale).astype(int)
        height = (int(last[1]) // CELL_DOTS[0] + 1) * CELL_DOTS[0]
        return cls(low_mm, scale, height, (int(last[0]) // CELL_DOTS[1] + 1) * CELL_DOTS[1])

    def dots(self, xy_mm: NDArray[np.float64]) -> NDArray[np.int64]:
        """Row from the top and column of each point's dot, (n, 2); outside the sheet for points beyond it."""
        placed = np.rint((xy_mm - self.low_mm) * self.dots_per_mm).astype(int)
        return np.column_stack([self.height - 1 - placed[:, 1], placed[:, 0]])

    def cells(self, xy_mm: NDArray[np.float64]) -> NDArray[np.int64]:
        """Row and column of each point's cell, (n, 2)."""
        return self.dots(xy_mm) // np.array(CELL_DOTS)

    def braille(self, xy_mm: NDArray[np.float64]) -> list[str]:
        """A line of characters for each row of cells; all points must lie on the sheet."""
        grid = np.zeros((self.height, self.width), bool)
        grid[tuple(self.dots(xy_mm).T)] = True
        return ["".join(row) for row in braille_cells(grid)]


def braille_cells(grid: NDArray[np.bool_]) -> list[list[str]]:
    """The characters of a grid of dots (rows, columns), whole cells of CELL_DOTS."""
    down, across = CELL_DOTS
    cells = grid.reshape(len(grid) // down, down, grid.shape[1] // across, across)
    codes = (cells * DOT_BITS[None, :, None, :]).sum(axis=(1, 3)) + BRAILLE
    return [[*map(chr, row)] for row in codes.tolist()]


def dot_rows(xy_mm: NDArray[np.float64], columns: int, rows: int) -> list[str]:
    """At most ``rows`` lines of ``columns`` characters for points (n, 2); none for no points."""
    if not len(xy_mm) or columns < 1 or rows < 1:
        return []
    return Sheet.fitted(xy_mm, columns, rows).braille(xy_mm)
