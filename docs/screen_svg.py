"""A terminal emulator's screen as SVG: text in cells with their colours, and read back as rows of text.

Rule: a run of like cells is one text of a fixed length, so that it stays in its cells whatever font the reader has.
Each row is a group. Called by docs/pictures.py and by the test that compares the pictures with the program.
"""

from collections.abc import Iterator
from itertools import groupby
from xml.etree import ElementTree
from xml.sax.saxutils import escape

import pyte

CELL_WIDTH, CELL_HEIGHT = 9, 19
BASELINE = 14
MARGIN = 10
FONT = "ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace"
SVG = "{http://www.w3.org/2000/svg}"

# The sixteen colours of a terminal, as pyte calls them. "default" is the letter, or the ground where it stands behind.
COLOURS = {
    "black": "#1b1f24", "red": "#b3261e", "green": "#2f8f4e", "brown": "#a06a00", "blue": "#12326b",
    "magenta": "#8e3a93", "cyan": "#3f9ea8", "white": "#d5dae1", "brightblack": "#6b7480", "brightred": "#ff7b72",
    "brightgreen": "#7ee08b", "brightbrown": "#ffd75f", "brightblue": "#79b0ff", "brightmagenta": "#e29bea",
    "brightcyan": "#7fe3ee", "brightwhite": "#ffffff",
}  # fmt: skip
LETTERS, GROUND = COLOURS["white"], COLOURS["black"]


def drawn(screen: pyte.Screen, rows: list[str]) -> str:
    """The SVG. ``rows`` are the screen's rows as they are to be read, which differ from its own where one is masked."""
    width, height = screen.columns * CELL_WIDTH + 2 * MARGIN, screen.lines * CELL_HEIGHT + 2 * MARGIN
    groups = "\n".join(_row(screen, number, text) for number, text in enumerate(rows))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        f'font-family="{FONT}" font-size="15" xml:space="preserve">\n'
        f'<rect width="{width}" height="{height}" rx="6" fill="{GROUND}"/>\n{groups}\n</svg>\n'
    )


def read(svg: str) -> list[str]:
    """The rows of text of such an SVG, without blanks at their ends."""
    return [_text_of(group) for group in ElementTree.fromstring(svg).iter(f"{SVG}g")]


def _text_of(group: ElementTree.Element) -> str:
    row = ""
    for run in group.iter(f"{SVG}text"):
        column = (int(run.attrib["x"]) - MARGIN) // CELL_WIDTH
        row = row.ljust(column) + (run.text or "")
    return row


def _row(screen: pyte.Screen, number: int, text: str) -> str:
    """Grounds first, then letters."""
    runs = list(_runs(screen, number))
    grounds = [_ground(number, *run) for run in runs if run[2] != GROUND]
    letters = [_letters(number, column, fill, text[column : column + length]) for column, length, _, fill in runs]
    return "<g>" + "".join([*grounds, *letters]) + "</g>"


def _runs(screen: pyte.Screen, number: int) -> Iterator[tuple[int, int, str, str]]:
    """Cells of like colours that lie side by side: first column, how many, ground and letters."""
    cells = [screen.buffer[number][column] for column in range(screen.columns)]
    column = 0
    for (ground, letters), run in groupby(map(_colours, cells)):
        length = len(list(run))
        yield column, length, ground, letters
        column += length


def _colours(cell: pyte.screens.Char) -> tuple[str, str]:
    letters, ground = COLOURS.get(cell.fg, LETTERS), COLOURS.get(cell.bg, GROUND)
    return (letters, ground) if cell.reverse else (ground, letters)


def _ground(number: int, column: int, length: int, fill: str, _letters: str) -> str:
    x, y = MARGIN + column * CELL_WIDTH, MARGIN + number * CELL_HEIGHT
    return f'<rect x="{x}" y="{y}" width="{length * CELL_WIDTH}" height="{CELL_HEIGHT}" fill="{fill}"/>'


def _letters(number: int, column: int, fill: str, text: str) -> str:
    """Without the blanks around them; nothing where there are only blanks."""
    shown = text.strip()
    if not shown:
        return ""
    column += len(text) - len(text.lstrip())
    x, y = MARGIN + column * CELL_WIDTH, MARGIN + number * CELL_HEIGHT + BASELINE
    return f'<text x="{x}" y="{y}" textLength="{len(shown) * CELL_WIDTH}" fill="{fill}">{escape(shown)}</text>'
