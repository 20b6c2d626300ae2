"""What is pressed for the pictures of the screens, and when a picture is taken: one script a session of the program.

Rule: a script says what the screen shows after each of its keys, in the words of the language in use, so that it can be
played at every size. Called by docs/pictures.py.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from drillctl.ui.explanations import EXPLAINED
from tests.support.labels import menu, word
from tests.support.terminal import Act

ROOT = Path(__file__).resolve().parent.parent
BOARD = ROOT / "examples" / "blinker.drl"
TRACE = ROOT / "examples" / "traces" / "square-pcb-drill.trace"
YES = ("Right", "Enter")
QUEUE = ("KMD_INICJALIZACJA", "KMD_GOTO_X_Y 480 300", "KMD_WIERTLO_DOL", "KMD_WIERTLO_GORA", "KMD_GOTO_X_Y 99000 0")
EDITORS = {"phase": "phase_editor", "ramp": "ramp_editor", "machines": "configuration"}
FIND = "\x10"  # Ctrl-P

Script = Callable[[], Iterator[Act | str]]  # keys to press, and names of pictures to take


def opened() -> Iterator[Act]:
    """The board is read."""
    yield Act(menu("files"), (BOARD.name,))
    yield Act(("Down", "Enter"), ("33.00 x 20.00 mm",))


def in_mid_board() -> Iterator[Act]:
    """The machine waits for the second tool."""
    yield Act(menu("drilling", "start"), (word("Question"),))
    yield Act(YES, (_waits_for("T1, 0.800 mm"),))
    yield Act(YES, (_waits_for("T2, 1.000 mm"),))


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
    yield Act(menu("scope", "open"), (word("File:"),))
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


def moving() -> Iterator[Act | str]:
    """Motors with inertia at the holes of the second tool."""
    yield from opened()
    yield from in_mid_board()
    yield Act(YES, (word("AT WORK"), word("moving")), gone=(word("Tool change"),))
    yield "drilling-moving"


def beginning() -> Iterator[Act | str]:
    """What somebody sees first: no board, the examples, help, the finder of actions, an open menu."""
    helped = word(EXPLAINED["Drilling"][0])[:40]
    yield "start"
    yield Act(("e",), (word("Examples"), BOARD.stem))
    yield "examples"
    yield Act(("Esc",), (), gone=(BOARD.stem,))
    yield Act(("F1",), (helped,))
    yield "help"
    yield Act(("Esc",), (), gone=(helped,))
    yield Act((FIND,), (word("Find an action"),))
    yield "find-an-action"
    yield Act(("Esc",), (), gone=(word("Find an action"),))
    yield Act(menu("phase_editor")[:1], (word("&Signals").replace("&", ""),))
    yield "menu"


def devices() -> Iterator[Act | str]:
    """The plant and the port, and a list of tables."""
    yield Act(menu("plant"), ("blunt",))
    yield "plant"
    yield Act(menu("port"), (word("F5 tests the configured port: nothing moves.")[:30],))
    yield "port"
    yield Act(menu("phase_editor"), (word("shipped"), "two-phase-forced"))
    yield "phase-tables"


def panel() -> Iterator[Act | str]:
    """The boiler-drum drill before a workpiece is called, and its help."""
    yield "panel"
    yield Act(("F1",), (word(EXPLAINED["Panel"][0])[:40],))
    yield "panel-help"


def production() -> Iterator[Act | str]:
    """The eight-axis drill with a board, and the form of its tools."""
    yield from opened()
    yield Act(("Esc",), ("Z6",))
    yield "machine"
    yield Act(("5",), ("tool.1.number",))
    yield "parameters"


def _waits_for(tool: str) -> str:
    return word("The job waits for {tool}; the machine is at rest.").format(tool=tool)
