"""A terminal emulator's screen as SVG: text in cells with their colours, and read back as rows of text.

Rule: drawn as the program draws a copy of its own screen (drillctl/ui/widgets/svg.py). Called by docs/pictures.py and
by the test that compares the pictures with the program.
"""

from collections.abc import Iterator
from itertools import groupby
from xml.etree import ElementTree

import pyte

from drillctl.ui.widgets.svg import CELL_WIDTH, MARGIN, Run, svg

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
    return svg(screen.columns, [list(_runs(screen, number, text)) for number, text in enumerate(rows)], GROUND)


def read(svg: str) -> list[str]:
    """The rows of text of such an SVG, without blanks at their ends."""
    return [_text_of(group) for group in ElementTree.fromstring(svg).iter(f"{SVG}g")]


def _text_of(group: ElementTree.Element) -> str:
    row = ""
    for run in group.iter(f"{SVG}text"):
        column = (int(run.attrib["x"]) - MARGIN) // CELL_WIDTH
        row = row.ljust(column) + (run.text or "")
    return row


def _runs(screen: pyte.Screen, number: int, text: str) -> Iterator[Run]:
    """Cells of like colours that lie side by side."""
    cells = [screen.buffer[number][column] for column in range(screen.columns)]
    column = 0
    for (ground, letters), like in groupby(map(_colours, cells)):
        length = len(list(like))
        yield Run(text[column : column + length], length, letters, ground)
        column += length


def _colours(cell: pyte.screens.Char) -> tuple[str, str]:
    letters, ground = _colour(cell.fg, LETTERS), _colour(cell.bg, GROUND)
    return (letters, ground) if cell.reverse else (ground, letters)


def _colour(name: str, default: str) -> str:
    """A colour as pyte has it: one of the sixteen by name, any other as six hexadecimal digits."""
    return COLOURS.get(name, default if name == "default" else f"#{name}")
