"""Draws a picture where the operator wants it: in a PNG or SVG file, else in the terminal."""

import argparse
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from drillctl.cli import streams

if TYPE_CHECKING:
    from drillctl.ui.widgets.series_colours import Theme
    from drillctl.viewmodel.reports import Picture

ROWS = 14  # of a chart in characters
THEMES = ("light", "dark")


def add_theme(verb: argparse.ArgumentParser) -> None:
    """Adds ``--theme`` to a verb that draws into files."""
    verb.add_argument(
        "--theme", choices=THEMES, default=THEMES[0], help="paper of a picture in a file; default: %(default)s"
    )


@contextmanager
def drawn(
    file: Path | None, inputs: "tuple[Path, ...]", theme: "Theme" = "light"
) -> "Iterator[Callable[[Picture], None]]":
    """Reserves the picture's file and gives the function that draws.

    Raises OutputError and PictureRefused before anything is computed.
    """
    from drillctl.files.outputs import reserved
    from drillctl.ui.terminal.image_file import check_format, picture_bytes

    kind = check_format(file.suffix) if file is not None else ""
    with reserved([file], inputs) as (output,):

        def draw(picture: "Picture") -> None:
            if output is None:
                _print(picture)
                return
            content = picture_bytes(picture, kind, theme)
            output.write_bytes(content)
            print("\n".join((f"{file}: {picture.title}", *picture.notes)))

        yield draw


def _print(picture: "Picture") -> None:
    from drillctl.ui.terminal.charts import ChartLook, picture_lines

    columns = shutil.get_terminal_size((100, 30)).columns
    plain = not (sys.stdout.encoding or "").lower().startswith("utf")
    look = ChartLook(columns - 1, ROWS, sys.stdout.isatty() and not plain, plain)
    streams.as_it_is(sys.stdout, "\n".join(picture_lines(picture, look)) + "\n")
