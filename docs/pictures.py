"""Takes the pictures of the screens in docs/pictures: the real program on a pseudo-terminal, worked by keys.

    .venv/bin/python docs/pictures.py [FOLDER]

Rule: every picture is taken at a moment that is the same in every run: the machine is simulated, runs free, and waits
(for a tool, at rest, with a fault). What can not be the same is masked. Tests play the sessions and compare.
"""

import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from docs.screen_svg import drawn
from drillctl.language import words
from tests.support.labels import menu, word
from tests.support.terminal import Act, Terminal

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ROOT / "docs" / "pictures"
BOARD = ROOT / "examples" / "blinker.drl"
TRACE = ROOT / "examples" / "traces" / "square-pcb-drill.trace"
YES = ("Right", "Enter")
QUEUE = ("KMD_INICJALIZACJA", "KMD_GOTO_X_Y 480 300", "KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA", "KMD_GOTO_X_Y 99000 0")
EDITORS = {"phase": "phase_editor", "ramp": "ramp_editor", "machines": "configuration"}
MASKED = re.compile(r"/tmp/drillctl-\w+")  # the folder in which a session is played
SHOWN_FOLDER = "/home/lab/boards"

Script = Callable[[], Iterator[Act | str]]  # keys to press, and names of pictures to take


class Session(NamedTuple):
    """One run of the program: ``drillctl OPTIONS`` at a size, in a language, and what is done in it."""

    script: Script
    size: tuple[int, int] = (80, 24)
    language: str = "en"
    options: tuple[str, ...] = ()


def opened() -> Iterator[Act]:
    """The board is read."""
    yield Act(menu("files"), (BOARD.name,))
    yield Act(("Down", "Enter"), ("33.00 x 20.00 mm",))


def in_mid_board() -> Iterator[Act]:
    """The machine waits for the second tool."""
    yield Act(menu("drilling", "start"), (word("Question"),))
    yield Act(YES, (word("Tool change"), "T1"))
    yield Act(YES, (word("Tool change"), "T2"))


def work() -> Iterator[Act | str]:
    """From the file to the middle of the board."""
    yield from opened()
    yield "files"
    yield from in_mid_board()
    yield "tool-change"
    yield Act(("Enter",), (word("Sensors"),), gone=(word("Tool change"),))
    yield "drilling"


def editors() -> Iterator[Act | str]:
    """Tests and Configuration, and a queue that ends in a fault."""
    yield from table("phase", "two-phase-forced", word("Phase table"))
    yield "phase-editor"
    yield from table("ramp", "seven-state", word("Ramp"))
    yield "ramp-editor"
    yield Act(menu("queue_editor"), (word("Queue of commands"),))
    yield Act(tuple(part for line in QUEUE for part in (line, "Enter")), ("99000",))
    yield "queue-editor"
    yield Act(("F5",), (word("Cause: "),))
    yield "fault"
    yield Act(("Enter",), (word("READY"),))
    yield from table("machines", "pcb-drill", word("Configuration"))
    yield "configuration"


def looking() -> Iterator[Act | str]:
    """A run that was recorded; the inputs and outputs."""
    yield Act(menu("scope", "open_file"), (word("File:"),))
    yield Act((*["Backspace"] * 20, TRACE.name, "Enter"), ("square",), gone=(word("File:"),))
    yield Act(("Home", "-", "-", "-"), (word("Further"),))
    yield "scope"
    yield Act(menu("signals"), ("z_top",))
    yield "signals"


def table(kind: str, name: str, title: str) -> Iterator[Act]:
    """Opened from the list of its kind, which is in the order of the names."""
    names = sorted(file.stem for file in (ROOT / "tables" / kind).glob("*.toml"))
    yield Act(menu(EDITORS[kind]), (names[0], name))
    yield Act(("Home", *["Down"] * names.index(name), "Enter"), (f"{title}: {name}",))


def larger() -> Iterator[Act | str]:
    """The same moment where there is room for the whole phase tables."""
    yield from opened()
    yield from in_mid_board()
    yield Act(("Enter",), (word("Sensors"),), gone=(word("Tool change"),))
    yield "drilling-large"


def polish() -> Iterator[Act | str]:
    """The main screen in Polish, a menu open."""
    yield from opened()
    yield from in_mid_board()
    yield Act(("Enter",), (word("Sensors"),), gone=(word("Tool change"),))
    yield Act(menu("drilling", "start")[:1], (word("&Acknowledge a fault").replace("&", ""),))
    yield "drilling-polish"


SESSIONS = (
    Session(work, options=("--tools", "ask")),
    Session(editors),
    Session(looking),
    Session(larger, (120, 40), options=("--tools", "ask")),
    Session(polish, language="pl", options=("--tools", "ask")),
)


def taken(session: Session) -> Iterator[tuple[str, str]]:
    """Plays a session; name and SVG of each of its pictures."""
    words.use(session.language)
    with tempfile.TemporaryDirectory(prefix="drillctl-", dir="/tmp") as folder:
        for file in (BOARD, TRACE):
            shutil.copy(file, folder)
        options = ("--pace", "free", "--lang", session.language, *session.options)
        terminal = Terminal(*options, folder=Path(folder), size=session.size)
        try:
            terminal.wait_for(word("No board is loaded."))
            for asked in session.script():
                if isinstance(asked, Act):
                    terminal.play([asked])
                else:
                    terminal.settle()
                    yield asked, drawn(terminal.screen, [_masked(row) for row in terminal.screen.display])
        finally:
            terminal.close()
            words.use("en")


def _masked(text: str) -> str:
    """Another folder of the same width."""
    return MASKED.sub(lambda found: SHOWN_FOLDER.ljust(len(found[0])), text)


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURES
    folder.mkdir(exist_ok=True)
    for session in SESSIONS:
        for name, svg in taken(session):
            (folder / f"{name}.svg").write_text(svg, "utf-8")
            print(f"{folder / name}.svg", flush=True)


if __name__ == "__main__":
    main()
