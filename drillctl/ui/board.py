"""A board drawn in the terminal: holes as braille dots, to scale, Y upwards. A function of points and a size."""

import numpy as np
from numpy.typing import NDArray

# A braille cell has 2 x 4 dots; bit of each dot, column by column from the top (Unicode 5, block 2800).
DOT_BITS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
BRAILLE = 0x2800
CELL_DOTS = (4, 2)


def board_rows(xy_mm: NDArray[np.float64], columns: int, rows: int) -> list[str]:
    """At most ``rows`` lines of ``columns`` characters for points (n, 2); none for no points."""
    if not len(xy_mm) or columns < 1 or rows < 1:
        return []
    low, span = xy_mm.min(axis=0), np.ptp(xy_mm, axis=0)
    dots = np.array([columns * CELL_DOTS[1] - 1, rows * CELL_DOTS[0] - 1])
    scale = min((d / s for d, s in zip(dots, span, strict=True) if s > 0), default=1.0)
    placed = np.rint((xy_mm - low) * scale).astype(int)
    height = (int(placed[:, 1].max()) // CELL_DOTS[0] + 1) * CELL_DOTS[0]
    width = (int(placed[:, 0].max()) // CELL_DOTS[1] + 1) * CELL_DOTS[1]
    grid = np.zeros((height, width), bool)
    grid[height - 1 - placed[:, 1], placed[:, 0]] = True
    cells = grid.reshape(height // CELL_DOTS[0], CELL_DOTS[0], width // CELL_DOTS[1], CELL_DOTS[1])
    codes = (cells * DOT_BITS[None, :, None, :]).sum(axis=(1, 3)) + BRAILLE
    return ["".join(map(chr, row)) for row in codes.tolist()]
