"""A long piece of work beside the screen: shown with the time left, given up without a change, refused as any."""

from threading import Event

import pytest

from drillctl.language import Message
from drillctl.ui import background
from drillctl.viewmodel.console import Problems, Watch
from tests.ui.fake_console import BOARD, FakeConsole, Program

PATIENCE_S = 20.0
READING = Message("reading {name}", name="long.drl")


class SlowConsole(FakeConsole):
    """Reads half of a board, then waits until the test lets it go on."""

    def __init__(self) -> None:
        super().__init__()
        self.go_on, self.half = Event(), Event()

    def load(self, file: str, asked: object, watch: Watch) -> Problems:
        """Raises what ``watch`` raises."""
        advance = watch(READING)
        advance(1, 2)
        self.half.set()
        assert self.go_on.wait(PATIENCE_S)
        advance(2, 2)
        self.loaded = BOARD
        return self.answer


@pytest.fixture
def console(monkeypatch: pytest.MonkeyPatch) -> SlowConsole:
    monkeypatch.setattr(background, "SHOWN_AFTER_S", 0.0)
    return SlowConsole()


def begun(console: SlowConsole) -> Program:
    """The program with the work half done."""
    program = Program(console)
    program.app.work(lambda watch: console.load("long.drl", None, watch), console.asked.append)
    assert console.half.wait(PATIENCE_S)
    program.app.turn()
    return program


def ended(program: Program, console: SlowConsole) -> None:
    """Lets the work go on, to its end."""
    console.go_on.set()
    task = program.app._background._task
    assert task is not None
    task.join(PATIENCE_S)
    program.app.turn()


def test_how_far_it_is_stands_in_a_box_until_it_is_done(console: SlowConsole) -> None:
    program = begun(console)
    assert "reading long.drl: 50%" in program.text() and "left" in program.text()
    ended(program, console)
    assert console.asked == [()] and console.loaded == BOARD and "reading" not in program.text()


def test_a_refusal_comes_as_from_a_short_one(console: SlowConsole) -> None:
    console.answer = (Message("no drill file"),)
    program = begun(console)
    ended(program, console)
    assert console.asked == [console.answer]


def test_given_up_it_changes_nothing_and_says_so(console: SlowConsole) -> None:
    program = begun(console)
    program.press("esc")
    program.app.turn()
    assert "Giving up" in program.text()
    ended(program, console)
    assert console.asked == [] and console.loaded is None
    assert "given up: nothing was changed" in program.text() and "Giving up" not in program.text()


def test_the_emergency_stop_works_meanwhile(console: SlowConsole) -> None:
    program = begun(console)
    program.press("f10")
    assert console.asked == [("emergency_stop",)]
    ended(program, console)


def test_an_error_of_ours_is_not_swallowed(console: SlowConsole) -> None:
    def broken(watch: Watch) -> Problems:
        raise RuntimeError("a fault of ours")

    program = Program(console)
    with pytest.raises(RuntimeError, match="a fault of ours"):
        program.app.work(broken, print)
        if (task := program.app._background._task) is not None:
            task.join(PATIENCE_S)
        program.app.turn()
