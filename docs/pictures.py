"""Takes the pictures of the screens: the real program on a pseudo-terminal, worked by keys; and plots (plots.py).

    .venv/bin/python docs/pictures.py [FOLDER]                  # those of the documents; default: docs/pictures
    .venv/bin/python docs/pictures.py --all FOLDER              # every screen at four sizes in three themes
    .venv/bin/python docs/pictures.py --all FOLDER --size 80x24 --theme mono --script editors --lang pl

Rule: every picture of the documents is taken at a moment that is the same in every run: the machine is simulated, runs
free, and waits (for a tool, at rest, with a fault); of a machine that moves, the figures are not compared. What can not
be the same is masked. Tests play the sessions and compare. FOLDER/index.html shows all pictures of ``--all``.
"""

import argparse
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from docs import picture_scripts as scripts
from docs.moving_picture import animated
from docs.picture_page import page
from docs.picture_scripts import BOARD, TRACE, Script
from docs.plots import plotted
from docs.screen_svg import drawn
from drillctl.language import words
from drillctl.ui.widgets.themes import THEMES
from tests.support.labels import word
from tests.support.terminal import Act, Terminal

PICTURES = Path(__file__).resolve().parent / "pictures"
MASKED = re.compile(r"/tmp/drillctl-\w+")  # the folder in which a session is played
SHOWN_FOLDER = "/home/lab/boards"
ALL_SIZES = ("80x24", "100x32", "160x50", "220x60")
ALL_THEMES = ("blue", "dark", "light")
ASKING = ("--pace", "free", "--tools", "ask")
DYNAMIC = (*ASKING, "--plant", "dynamic")
FRAMES, BETWEEN_S = 14, 0.12  # of an animated picture
DRUM = ("--pace", "free", "--machine", "boiler-drum")
EIGHT = ("--pace", "free", "--machine", "eight-axis")


class Session(NamedTuple):
    """One run of the program: ``drillctl OPTIONS`` at a size, in a language, and what is done in it.

    first         the message that the first screen shows
    true_colours  whether the terminal has more than sixteen colours
    moves         whether its pictures are of a machine that moves
    frames        how many are taken, one after the other, for a picture that is animated
    """

    script: Script
    size: tuple[int, int] = (80, 24)
    language: str = "en"
    options: tuple[str, ...] = ("--pace", "free")
    first: str = "No board is loaded."
    true_colours: bool = False
    moves: bool = False
    frames: int = 1


SESSIONS = (
    Session(scripts.work, options=ASKING),
    Session(scripts.editors),
    Session(scripts.looking),
    Session(scripts.larger, (120, 40), options=ASKING),
    Session(scripts.polish, language="pl", options=ASKING),
    Session(scripts.moving, (160, 50), options=DYNAMIC, true_colours=True, moves=True, frames=FRAMES),
)
EVERY_SCREEN = (
    Session(scripts.beginning),
    Session(scripts.work, options=ASKING),
    Session(scripts.moving, options=DYNAMIC, moves=True),
    Session(scripts.editors),
    Session(scripts.looking),
    Session(scripts.devices),
    Session(scripts.production, options=EIGHT),
    Session(scripts.panel, options=DRUM, first="No workpiece is called."),
)


def taken(session: Session) -> Iterator[tuple[str, str]]:
    """Plays a session; name and SVG of each of its pictures."""
    words.use(session.language)
    with tempfile.TemporaryDirectory(prefix="drillctl-", dir="/tmp") as folder:
        for file in (BOARD, TRACE):
            shutil.copy(file, folder)
        options = ("--lang", session.language, *session.options)
        terminal = Terminal(*options, folder=Path(folder), size=session.size, true_colours=session.true_colours)
        try:
            terminal.wait_for(word(session.first))
            for asked in session.script():
                if isinstance(asked, Act):
                    terminal.play([asked])
                else:
                    if not session.moves:
                        terminal.settle()
                    yield asked, animated([*_frames(terminal, session.frames)])
        finally:
            terminal.close()
            words.use("en")


def _frames(terminal: Terminal, count: int) -> Iterator[str]:
    """Pictures of the screen, a moment after each other."""
    for number in range(count):
        yield drawn(terminal.screen, [_masked(row) for row in terminal.screen.display])
        if number + 1 < count:
            terminal.frames(BETWEEN_S)


def _masked(text: str) -> str:
    """Another folder of the same width."""
    return MASKED.sub(lambda found: SHOWN_FOLDER.ljust(len(found[0])), text)


def of_the_documents(folder: Path) -> None:
    """Takes the pictures that the documents show."""
    folder.mkdir(parents=True, exist_ok=True)
    for session in SESSIONS:
        for name, svg in taken(session):
            _keep(folder / f"{name}.svg", svg)
    plotted(folder)


def of_every_screen(asked: argparse.Namespace) -> None:
    """Takes every screen at every size and theme that is asked for; then the page that shows them."""
    asked.all.mkdir(parents=True, exist_ok=True)
    names: list[str] = []  # of the screens, in the order in which they are seen
    for size in asked.size or ALL_SIZES:
        for theme in asked.theme or ALL_THEMES:
            for session in EVERY_SCREEN:
                if not asked.script or session.script.__name__ in asked.script:
                    for name, svg in taken(_as_asked(session, size, theme, asked.lang)):
                        _keep(asked.all / f"{name}-{size}-{theme}.svg", svg)
                        names += [] if name in names else [name]
    _keep(asked.all / "index.html", page(names, asked.size or ALL_SIZES, asked.theme or ALL_THEMES))


def _as_asked(session: Session, size: str, theme: str, language: str) -> Session:
    columns, rows = map(int, size.split("x"))
    options = (*session.options, "--theme", theme)
    return session._replace(size=(columns, rows), language=language, options=options, true_colours=True)


def _keep(file: Path, text: str) -> None:
    file.write_text(text, "utf-8")
    print(file, flush=True)


def _size(text: str) -> str:
    """COLUMNSxROWS; raises ValueError for anything else, which argparse reports."""
    if not re.fullmatch(r"[1-9]\d{1,2}x[1-9]\d{1,2}", text):
        raise ValueError(text)
    return text


def main(arguments: Sequence[str] | None = None) -> None:
    """Takes the pictures that the command line asks for."""
    parser = argparse.ArgumentParser(description="Takes the pictures of the screens.")
    parser.add_argument("folder", nargs="?", type=Path, default=PICTURES, help="for the pictures of the documents")
    parser.add_argument("--all", type=Path, metavar="FOLDER", help="every screen, into this folder, and a page of them")
    parser.add_argument("--size", action="append", type=_size, help="COLUMNSxROWS, with --all; repeatable")
    parser.add_argument("--theme", action="append", choices=tuple(THEMES), help="with --all; repeatable")
    names = tuple(session.script.__name__ for session in EVERY_SCREEN)
    parser.add_argument("--script", action="append", choices=names, help="with --all: only these; repeatable")
    parser.add_argument("--lang", default="en", choices=("en", "pl"), help="with --all; default: en")
    asked = parser.parse_args(arguments)
    if not asked.all and (asked.size or asked.theme or asked.script or asked.lang != "en"):
        parser.error("--size, --theme, --script and --lang need --all FOLDER")
    if asked.all:
        of_every_screen(asked)
    else:
        of_the_documents(asked.folder)


if __name__ == "__main__":
    main()
