"""An hour at the panel of the boiler-drum drill, on a terminal: a program is typed in by cells, called, run, paused,
stopped and returned to zero.

Each key waits for what the screen shows. The machine goes by its simulated clock, a few tenths of a second in all.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.generation.boiler_drum.cells import program_at
from drillctl.generation.boiler_drum.store_file import parse_store
from drillctl.language import words
from tests.support.labels import word

pytestmark = pytest.mark.paced

terminals = pytest.importorskip("tests.support.terminal", reason="pyte (the dev extra) reads what the program draws")
Act = terminals.Act

NUMBER, DIRECTORY, FIRST = 5, "0008", "00C6"
PROGRAM = "8F0110 2F0110 6F0030"  # a hole, 1 mm into the wall; ends at X 3 mm
END_X_STEPS = 150
YES = ("Right", "Enter")


def typed(address: str, contents: bytes) -> Iterator["terminals.Act"]:
    """Contents at addresses that follow each other; each is confirmed once it is on the disk."""
    yield Act((f"{address.lower()}m",), (word("READY"),))
    for offset, content in enumerate(contents):
        cell = int(address, 16) + offset
        confirmed = word("cell {address:04X} is {content:02X}").format(address=cell, content=content)
        yield Act((("+" if offset else "") + f"{content:02x}",), (confirmed,))
    yield Act(("m",), (word("READY"),))


def programming() -> Iterator["terminals.Act"]:
    """Directory and sentences are typed in, and the workpiece is called."""
    yield Act((), (word("No workpiece is called."), word("position not known")))
    yield from typed(DIRECTORY, bytes.fromhex(FIRST))
    yield from typed(FIRST, bytes.fromhex(PROGRAM + "FF"))
    yield Act(("05p",), ("8F0110", word("{done} of {total}").format(done=0, total=1)))


def running() -> Iterator["terminals.Act"]:
    """Zero is taken after a question; a pause is pressed with it; then to the end."""
    yield Act(("s",), (word("Run workpiece {number:02}?").format(number=NUMBER),))
    yield Act((*YES, " "), (word("HELD"),))
    ended = (f"{END_X_STEPS:+d} ", word("READY"), word("{done} of {total}").format(done=1, total=1), word("at rest"))
    yield Act(("g",), ended)


def returning() -> Iterator["terminals.Act"]:
    """Back to zero after the program's end."""
    yield Act(("z",), (" +0.00", word("at rest"), word("READY")), gone=(f"{END_X_STEPS:+d} ",))


def stopped() -> Iterator["terminals.Act"]:
    """Emergency stop, wherever the program is; then nothing but the return to zero is taken."""
    yield Act(("s",), (word("automatic run"),))
    yield Act(("F10",), ("EMERGENCY_STOP", word("position kept")))
    yield Act(("Enter",), (word("ZERO ONLY"),), gone=("EMERGENCY_STOP",))
    yield Act(("s",), (word("only the return to zero is allowed"),))
    yield Act(("z",), (word("READY"), word("at rest"), " +0.00"), gone=(word("ZERO ONLY"),))


@pytest.fixture
def language(request: pytest.FixtureRequest) -> Iterator[str]:
    words.use(request.param)
    yield request.param
    words.use("en")


@pytest.mark.parametrize(
    ("language", "size"),
    [("en", (80, 24)), pytest.param("pl", (160, 50), marks=pytest.mark.long)],
    indirect=["language"], ids=str,
)  # fmt: skip
def test_an_hour_at_the_panel(language: str, size: tuple[int, int], tmp_path: Path) -> None:
    arguments = ("screen", "--machine", "boiler-drum", "--lang", language)
    terminal = terminals.Terminal(*arguments, folder=tmp_path, size=size)
    try:
        for part in (programming, running, returning, stopped):
            terminal.play(part())
            terminal.settle()
        terminal.press("F4")
        assert terminal.exit_code() == 0
    finally:
        terminal.close()
    (store,) = tmp_path.rglob("boiler-drum.hex")
    kept = program_at(parse_store(store.read_text("ascii"), "RAM"), NUMBER, "RAM")
    assert [str(sentence) for _cell, sentence in kept] == PROGRAM.split()
