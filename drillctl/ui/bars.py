"""A column chart in characters: a bar for each value, eighths of a character high. A function of values and a size."""

from collections.abc import Sequence

EIGHTHS = " ▁▂▃▄▅▆▇█"


def bar_rows(values: Sequence[float], columns: int, rows: int, plain: bool = False) -> list[str]:
    """``rows`` lines from the top, the greatest value as high as all of them. Values beyond ``columns`` are left out.

    A value above zero is always seen, if only as the lowest eighth.
    """
    greatest = max(values, default=0.0)
    if greatest <= 0 or rows < 1:
        return [""] * rows
    heights = [max(round(value / greatest * rows * 8), int(value > 0)) for value in values[:columns]]
    return ["".join(_cell(height - 8 * below, plain) for height in heights) for below in range(rows - 1, -1, -1)]


def _cell(eighths: int, plain: bool) -> str:
    filled = min(max(eighths, 0), 8)
    return ("#" if filled >= 4 else " ") if plain else EIGHTHS[filled]
