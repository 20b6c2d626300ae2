"""Undo: one key in every editor takes the last change back, another one makes it again."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from drillctl.ui.frame import screen_keys
from drillctl.ui.pcb_drill.alignment import AlignmentScreen
from drillctl.ui.pcb_drill.measuring import Measuring
from drillctl.ui.widgets.keys import UNDO_KEYS
from tests.ui.whole import BLINKER, Whole, at_home


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Whole]:
    at_home(tmp_path, monkeypatch)
    whole = Whole()
    yield whole
    whole.console.close()


# By screen: the keys that lead into it, and some that change something there.
CHANGES = {
    "phase_editor": (("enter",), (" ",)),
    "ramp_editor": (("enter",), ("5",)),
    "queue_editor": ((), ("X",)),
    "configuration": (("enter",), ("7",)),
    "files": ((), ("m",)),
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_last_change_is_taken_back_and_made_again(name: str, program: Whole) -> None:
    way, change = CHANGES[name]
    if name == "files":
        program.console.load(str(BLINKER), program.app.show("files")._options)  # type: ignore[union-attr]
    program.app.show(name)
    program.press(*way)
    before = program.text()
    assert set(UNDO_KEYS) <= set(screen_keys(program.app.screens[-1]))
    program.press(*change)
    after = program.text()
    assert after != before
    program.press("ctrl u")
    assert program.text() == before
    program.press("ctrl r")
    assert program.text() == after
    program.press("ctrl u", "ctrl u")
    assert program.text() == before


def test_the_list_of_measured_holes_is_undone_too() -> None:
    xy_mm = np.array([[0.0, 0.0], [9.0, 0.0], [0.0, 9.0], [5.0, 5.0]])
    board: Any = SimpleNamespace(file_xy_mm=xy_mm, xy_mm=xy_mm)
    measuring = Measuring(board, (), False, lambda measured, face_down: (None, ()))
    first = measuring.spots
    measuring.find(0, (1.0, 2.0))
    assert measuring.add(4)
    measuring.remove(1)
    last = measuring.spots
    assert [spot.found_mm for spot in last] == [(1.0, 2.0), None, None] and len(last) == len(first)
    for _change in range(3):
        measuring.undo()
    assert measuring.spots == first and measuring.measured == ()
    for _change in range(3):
        measuring.redo()
    assert measuring.spots == last and set(UNDO_KEYS) <= set(AlignmentScreen.keys)
