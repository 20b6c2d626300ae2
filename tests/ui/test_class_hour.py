"""A class hour on a terminal: a board from file to the last hole, a table edited, a fault provoked and put right, a
board cut off and gone on with.

One script, played at two sizes and in two languages by the real program on its own pseudo-terminal. The words come
from the program's catalogue. The machine runs free, so that a busy computer makes the hour longer and nothing else.
Every key is pressed after the screen has named it (tests/support/named.py).
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.kmd import Fault
from drillctl.language import words
from drillctl.ui.explanations import EXPLAINED
from drillctl.viewmodel.fault_texts import FAULT_WORDS
from tests.support.labels import counted, menu, word

pytestmark = pytest.mark.paced

named = pytest.importorskip("tests.support.named", reason="pyte (the dev extra) reads what the program draws")
Act = named.Act

NAME, HOLES, OF_THE_FIRST_TOOL, SIZE = "lesson.drl", 5, 3, "9.99 x 5.00 mm"
BOARD = """M48
METRIC
T1C0.800
T2C1.000
%
T1
X5.0Y5.0
X15.0Y5.0
X15.0Y10.0
T2
X5.0Y10.0
X10.0Y7.5
M30
"""
FIRST, SECOND = "T1, 0.800 mm", "T2, 1.000 mm"
BEYOND = ("INICJALIZACJA", "Enter", "KMD_GOTO_X_Y 999999 0")


def yes() -> tuple[str, ...]:
    """The letter that the question has beside its Yes."""
    return (word("Yes")[0].lower(),)


def made(done: int) -> str:
    return word("{number} of {total}, {done} done").format(number=HOLES, total=HOLES, done=done)


def at_rest(known: str) -> str:
    return f"{word('at rest')} | {word(known)}"


def waits_for(tool: str) -> str:
    return word("The job waits for {tool}; the machine is at rest.").format(tool=tool)


def opened() -> Iterator["named.Act"]:
    """From the list of files, and understood."""
    yield Act(menu("files"), (NAME,))
    yield Act(("Down", "Enter"), (SIZE, "T2"))


def board() -> Iterator["named.Act"]:
    """The first look, and back to the machine."""
    yield from opened()
    yield Act(("Esc",), (word("Sensors"),))


def basing() -> Iterator["named.Act"]:
    """Initialised, and beside machine zero."""
    yield Act(menu("drilling", "initialise"), (at_rest("position known"),))
    yield Act(("Right",), ("X +12",))
    yield Act(("Up",), ("Y +12",))


def based() -> Iterator["named.Act"]:
    """The base is taken there, once the jogs have ended."""
    yield Act(("b",), (word("this place is the working base"),))


def begun() -> Iterator["named.Act"]:
    """After a question; the first tool is asked for."""
    yield Act(menu("drilling", "start"), (counted("Drill {count} holes of {name}?", HOLES, name=NAME),))
    yield Act(yes(), (waits_for(FIRST),))


def drilling() -> Iterator["named.Act"]:
    """With a hold on the way, pressed in one go with the tool's yes: a machine that runs free may have done with its
    holes before a busy computer has shown that it moves.
    """
    yield from begun()
    yield Act((*yes(), " "), (word("HELD"),), gone=(word("Tool change"),))
    yield Act((" ",), (waits_for(SECOND),))
    yield Act(yes(), (made(HOLES), at_rest("position known")))


def table() -> Iterator["named.Act"]:
    """A cell turned over, saved as one's own copy, driven, and taken away again."""
    saved = word("Saved. Drive the machine with it now? The position will be lost.")
    yield Act(menu("phase_editor"), (word("Phase tables"), word("shipped")))
    yield Act(("Enter",), (word("Phase table") + ": ",))
    yield Act((" ",), (word(", changed"),))
    yield Act(("F2",), (saved[:30],))
    yield Act(yes(), (word("your own copy"), at_rest("position not known")))
    yield Act(("F8",), (word("Question"),))
    yield Act(yes(), (f"({word('shipped')})",))


def fault() -> Iterator["named.Act"]:
    """A queue beyond the range: cause and remedy are read, the fault acknowledged."""
    told = FAULT_WORDS[Fault.SOFT_LIMIT]
    yield Act(menu("queue_editor"), (word("Queue of commands"),))
    yield Act(("Tab",), ("KMD_GOTO_X_Y",))
    yield Act(BEYOND, ("2: X: 999999",))
    yield Act(("F5",), ("SOFT_LIMIT", word("Cause: ") + word(told.cause)[:30], word(told.remedy)[:30]))
    yield Act(("Enter",), (word("READY"),))


def cut_off() -> Iterator["named.Act"]:
    """An emergency stop with the second tool in hand; then gone on with, and no hole drilled twice."""
    done = counted("{done} of {count} holes are drilled", HOLES, done=OF_THE_FIRST_TOOL)
    yield from opened()
    yield from begun()
    yield Act(yes(), (waits_for(SECOND),))
    yield Act(("F10",), ("EMERGENCY_STOP", word("position lost: initialise again")))
    yield Act(("Enter",), (word("READY"), at_rest("position not known")))
    yield Act(menu("drilling", "start"), (word("Interrupted job"), done))
    yield Act(("Right", "Enter"), (waits_for(SECOND),))
    yield Act(yes(), (made(HOLES), at_rest("position known")))


def dry() -> Iterator["named.Act"]:
    """The same journey with the drill up."""
    yield Act(menu("drilling", "dry_run"), (made(HOLES), at_rest("position known")))


@pytest.fixture
def language(request: pytest.FixtureRequest) -> Iterator[str]:
    words.use(request.param)
    yield request.param
    words.use("en")


@pytest.mark.parametrize(("language", "size"), [("en", (80, 24)), ("pl", (160, 50))], indirect=["language"], ids=str)
def test_an_hour_at_the_machine(language: str, size: tuple[int, int], tmp_path: Path) -> None:
    (tmp_path / NAME).write_text(BOARD, "utf-8")
    terminal = named.Reader("--pace", "free", "--tools", "ask", "--lang", language, folder=tmp_path, size=size)
    try:
        terminal.wait_for(word("No board is loaded."), at_rest("position not known"))
        terminal.read_help(word(EXPLAINED["Drilling"][0])[:40])
        for part in (board, basing, based, drilling, table, fault, cut_off, dry):
            terminal.play(part())
            terminal.settle()  # what was asked last has ended, and the machine takes the next
        terminal.play([Act(("F4",), (word("Question"),))])  # the queue was not saved
        terminal.play([Act(yes(), ())])
        assert terminal.exit_code() == 0
    finally:
        terminal.close()
