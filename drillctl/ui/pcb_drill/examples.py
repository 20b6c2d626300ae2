"""The example boards and the lab sheets that come with the program, and the boards opened last: offered by number.

Rule: an example is opened where it lies and never written to.
"""

from collections.abc import Callable
from pathlib import Path

from drillctl.files.inputs import read_bytes
from drillctl.files.shipped import shipped
from drillctl.language import Message
from drillctl.language.words import _
from drillctl.ui.screens.reader import Reader
from drillctl.ui.screens.shell import Shell

LARGEST_SHEET_BYTES = 1 << 20


def boards() -> list[Path]:
    """The drill files of the example boards."""
    return sorted(shipped("examples", "examples").glob("*.drl"))


def sheets() -> list[Path]:
    """The lab sheets, in their order."""
    return sorted(shipped("sheets", "docs/lab").glob("[0-9][0-9]-*.md"))


def offer_examples(shell: Shell, load: Callable[[Path], object]) -> None:
    """Offers the boards, each of which ``load`` opens, and the sheets, which are opened to be read."""
    board_files, sheet_files = boards(), sheets()
    lines = [_("board {name}").format(name=file.name) for file in board_files]
    lines += [_("lab sheet {name}").format(name=_title(file)) for file in sheet_files]

    def chosen(index: int) -> None:
        if index < len(board_files):
            load(board_files[index])
        else:
            open_sheet(sheet_files[index - len(board_files)], shell)

    if lines:
        shell.choose(_("Examples"), lines, chosen)
    else:
        shell.message(_("Examples"), [_("The examples are not part of this installation.")])


def open_sheet(file: Path, shell: Shell) -> None:
    """Opens a lab sheet to be read; says why where that fails."""
    try:
        text = read_bytes(file, LARGEST_SHEET_BYTES, Message("a lab sheet")).decode()
    except (OSError, UnicodeDecodeError) as error:
        shell.message(_("Refused"), [str(error)])
        return
    shell.open(Reader(text.splitlines()))


def _title(file: Path) -> str:
    """The title of a sheet by its file: ``3 ramps`` for ``03-ramps.md``."""
    number, _dash, name = file.stem.partition("-")
    return f"{int(number)} {name.replace('-', ' ')}"
