"""The Files screen with a board in its folder: opened, typed into, and what was asked of the console."""

from drillctl.viewmodel.job_options import JobOptions
from tests.ui.fake_console import FakeConsole, Program

SIZES = [(80, 24), (160, 50)]


def opened(console: FakeConsole | None = None, size: tuple[int, int] = (80, 24)) -> Program:
    """With the board loaded."""
    program = Program(console or FakeConsole(), size)
    program.press("f", "down", "enter")
    return program


def asked(program: Program) -> JobOptions:
    """As the board was asked for last."""
    wanted = next(request[2] for request in reversed(program.console.asked) if request[0] == "load")
    assert isinstance(wanted, JobOptions)
    return wanted


def typed(program: Program, *texts: str, wiped: int = 10) -> None:
    """Into the fields of a form, in place of what stands there."""
    for text in texts:
        program.press("end", *["backspace"] * wiped, *["delete"] * wiped, *text, "down")
