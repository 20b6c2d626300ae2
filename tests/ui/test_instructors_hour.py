"""An instructor's hour on a terminal: a plant with a fault, a phase table made wrong and put right again on the bench,
a queue written and run, and its run looked at.

One script, played at two sizes and in two languages by the real program; every key is pressed after the screen has
named it (tests/support/named.py). The machine runs free, so that a busy computer makes the hour longer and nothing
else.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.language import words
from drillctl.ui.explanations import EXPLAINED
from tests.support.labels import counted, menu, word

pytestmark = pytest.mark.paced

named = pytest.importorskip("tests.support.named", reason="pyte (the dev extra) reads what the program draws")
Act = named.Act

OK = "< OK"


def plant() -> Iterator["named.Act"]:
    """The dynamic one, with a drill that is blunt after 20 holes."""
    yield Act(menu("plant"), ("blunt",))
    yield Act(("F6",), (f"2   {word('dynamic: motors have inertia, and can lose steps')}",))
    yield Act(("2",), (f"| {word('dynamic')} |",))
    yield Act(("Enter",), (OK,))
    yield Act(("blunt=20", "Enter"), (word("dynamic, faults: {count}").format(count=1),), gone=(OK,))


def table() -> Iterator["named.Act"]:
    """Without its last column a motor loses steps; with it again it doesn't."""
    lost = counted("LOST {lost} of {count} steps", 30, lost=1).split(" ")[0]
    yield Act(menu("phase_editor"), (word("shipped"), "two-phase-forced"))
    yield Act(("Enter",), (word("Phase table") + ": ",))
    yield Act(("Del",), (word(", changed"),))
    yield Act(("F5",), (lost,))
    yield Act(("Ctrl-U",), (), gone=(word(", changed"),))
    yield Act(("F5",), (word("no step lost"),), gone=(lost,))


def queue() -> Iterator["named.Act"]:
    """Its words are completed from the list that Tab shows; then it is run."""
    yield Act(menu("queue_editor"), (word("Queue of commands") + ":",))
    yield Act(("Tab",), ("KMD_GOTO_X_Y",))
    yield Act(("INICJALIZACJA", "Enter", "KMD_GOTO_X_Y 30 20"), (word("sound"),))
    yield Act(("F5",), (f"{word('at rest')} | {word('position known')}",))


def scope() -> Iterator["named.Act"]:
    """The run of the machine, which has ended."""
    yield Act(menu("scope", "show_machine"), ("KMD_GOTO_X_Y",))


@pytest.fixture(params=[("en", (160, 50)), ("pl", (80, 24))], ids=lambda case: case[0])
def reader(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator["named.Reader"]:
    language, size = request.param
    words.use(language)
    made = named.Reader("--pace", "free", "--lang", language, folder=tmp_path, size=size)
    try:
        yield made
    finally:
        made.close()
        words.use("en")


def test_an_instructors_hour(reader: "named.Reader") -> None:
    reader.wait_for(word("No board is loaded."))
    reader.read_help(word(EXPLAINED["Drilling"][0])[:40])
    for part in (plant, table, queue, scope):
        reader.play(part())
