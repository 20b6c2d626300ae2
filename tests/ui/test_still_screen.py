"""A screen at rest costs nothing: no part of it is drawn anew, so no byte goes to the terminal."""

from pathlib import Path

import pytest

from tests.ui.test_everything_fits import opened
from tests.ui.whole import SCREENS, at_home

pytestmark = pytest.mark.paced


@pytest.mark.parametrize("name", [name for name in SCREENS if name != "scope"])  # which shows every tick, at rest too
def test_a_machine_at_rest_draws_nothing(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """urwid keeps the canvas of whatever was not invalidated, and sends nothing for the same canvas."""
    at_home(tmp_path, monkeypatch)
    for program in opened(name):
        for _ in range(3):
            program.go_on(1)
        drawn = program.canvas()
        for _ in range(3):
            program.go_on(1)
            assert program.canvas() is drawn, f"{name} draws a machine at rest anew"
