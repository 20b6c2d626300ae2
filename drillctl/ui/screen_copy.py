"""A copy of the screen as an SVG file in the current folder, in the colours of the theme.

Rule: no file that is there is written over; the copy gets the first number that is free.
"""

from collections.abc import Hashable
from itertools import count
from pathlib import Path

import urwid

from drillctl.files.outputs import write_text
from drillctl.language import Message
from drillctl.ui.widgets.svg import Run, svg
from drillctl.ui.widgets.themes import shades

NAME = "drillctl-{number}.svg"


def picture(canvas: urwid.Canvas, theme: str) -> str:
    """Returns the SVG of a canvas."""
    rows = [[_run(text, *shades(theme, _role(attribute))) for attribute, _set, text in row] for row in canvas.content()]
    return svg(canvas.cols(), rows, shades(theme, None)[1])


def keep_copy(canvas: urwid.Canvas, theme: str, folder: Path) -> tuple[Path, tuple[Message, ...]]:
    """Writes the picture of a canvas to a new file of the folder; returns the file, and the reason if that failed."""
    file = next(file for number in count(1) if not (file := folder / NAME.format(number=number)).is_symlink()
                and not file.exists())  # fmt: skip
    return file, write_text(file, picture(canvas, theme))


def _role(attribute: Hashable) -> Hashable:
    """The innermost role of an attribute: urwid keeps those of the widgets around it as further layers."""
    return attribute.layers[0] if isinstance(attribute, urwid.util.LayeredAttr) else attribute


def _run(text: bytes, letters: str, ground: str) -> Run:
    shown = text.decode("utf-8", "replace")
    return Run(shown, urwid.calc_width(shown, 0, len(shown)), letters, ground)
