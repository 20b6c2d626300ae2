"""A screen of cells as an SVG picture: runs of text with their colours, each in its place whatever font is used.

Rule: a run of like cells is one text of a fixed length. Each row is a group, so that the text can be read back.
"""

from collections.abc import Iterator, Sequence
from html import escape
from typing import NamedTuple

CELL_WIDTH, CELL_HEIGHT = 9, 19
BASELINE = 14
MARGIN = 10
FONT = "ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace"


class Run(NamedTuple):
    """Cells of one row that look alike: their text, how many columns it takes, and the colours of letters and ground
    as ``#rrggbb``.
    """

    text: str
    columns: int
    letters: str
    ground: str


def svg(columns: int, rows: Sequence[Sequence[Run]], ground: str) -> str:
    """Returns the picture of a screen of so many columns, on this ground."""
    width, height = columns * CELL_WIDTH + 2 * MARGIN, len(rows) * CELL_HEIGHT + 2 * MARGIN
    groups = "\n".join(_row(number, row, ground) for number, row in enumerate(rows))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        f'font-family="{FONT}" font-size="15" xml:space="preserve">\n'
        f'<rect width="{width}" height="{height}" rx="6" fill="{ground}"/>\n{groups}\n</svg>\n'
    )


def _row(number: int, runs: Sequence[Run], ground: str) -> str:
    """One row of text as SVG: backgrounds first, then letters."""
    placed = list(_placed(runs))
    grounds = [_ground(number, column, run) for column, run in placed if run.ground != ground]
    return "<g>" + "".join([*grounds, *(_letters(number, column, run) for column, run in placed)]) + "</g>"


def _placed(runs: Sequence[Run]) -> Iterator[tuple[int, Run]]:
    """Each run with its first column."""
    column = 0
    for run in runs:
        yield column, run
        column += run.columns


def _ground(number: int, column: int, run: Run) -> str:
    x, y = MARGIN + column * CELL_WIDTH, MARGIN + number * CELL_HEIGHT
    return f'<rect x="{x}" y="{y}" width="{run.columns * CELL_WIDTH}" height="{CELL_HEIGHT}" fill="{run.ground}"/>'


def _letters(number: int, column: int, run: Run) -> str:
    """Without the blanks around them; nothing where there are only blanks."""
    shown = run.text.strip()
    if not shown:
        return ""
    column += len(run.text) - len(run.text.lstrip())
    columns = run.columns - len(run.text) + len(shown)
    x, y = MARGIN + column * CELL_WIDTH, MARGIN + number * CELL_HEIGHT + BASELINE
    return f'<text x="{x}" y="{y}" textLength="{columns * CELL_WIDTH}" fill="{run.letters}">{escape(shown)}</text>'
