"""A board placed by measured holes: proposed, found by jogging or typed, accepted or refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace

from drillctl.ui.pcb_drill.alignment import AlignmentScreen
from drillctl.ui.pcb_drill.files import Files
from drillctl.ui.pcb_drill.measuring import far_apart
from tests.ui.fake_console import BOARD, VIEW, FakeConsole, Program
from tests.ui.opened_board import SIZES, asked, opened, typed

pytestmark = pytest.mark.usefixtures("idle", "folder")  # the list of files is drawn behind each box

STANDING = replace(VIEW, axes=tuple(replace(axis, position_steps=480, position_mm=0.0) for axis in VIEW.axes))


def aligning(folder: Path, size: tuple[int, int] = (80, 24)) -> Program:
    program = opened(FakeConsole(now=STANDING), size)
    program.press("j")
    return program


def test_holes_far_apart_are_proposed() -> None:
    assert sorted(far_apart(BOARD.file_xy_mm))[0] == 0 and len(far_apart(BOARD.file_xy_mm)) == 3
    assert [far_apart(np.zeros((count, 2))) for count in (0, 1, 5)] == [[], [0], [0]]
    line = np.array([[0.0, 0.0], [1.0, 0.0], [9.0, 0.0]])
    assert len(far_apart(line)) == 2


@pytest.mark.parametrize("size", SIZES)
def test_measured_holes_place_the_board(folder: Path, size: tuple[int, int]) -> None:
    """The base lies at 480 steps (10.16 mm): shown from there, kept from machine zero."""
    program = aligning(folder, size)
    assert "X10.000 Y10.000" in program.text() and "2 holes at least" in program.text()
    program.press("enter", "tab", "t", *"40 20", "enter")
    assert all(told in program.text() for told in ("X0.000 Y0.000", "X40.000 Y20.000", "accepted: F2"))
    program.press("f2")
    holes = asked(program).measured
    assert [(hole.file_x_mm, hole.machine_x_mm) for hole in holes] == [
        pytest.approx((10.0, 10.16)), pytest.approx((50.0, 50.16)),
    ]  # fmt: skip
    assert "Placed by 2 measured holes" in program.text()


def test_holes_that_contradict_each_other_place_nothing(folder: Path) -> None:
    program = aligning(folder)
    before = len(program.console.asked)
    program.press("enter", "tab", "t", *"47 20", "enter", "f2")
    assert "REJECTED" in program.text() and "can't place the board" in program.text()
    assert "7.000 mm" in program.text() and len(program.console.asked) == before
    program.press("esc")
    assert isinstance(program.app.screens[-1], Files) and len(program.console.asked) == before


def test_a_long_reason_against_measured_holes_is_read_to_its_end(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reason = "the measured places press the board flat onto a line: were they confused with each other?"
    monkeypatch.setattr(FakeConsole, "align", lambda console, measured, face_down: (None, (reason,)))
    program = aligning(folder, (80, 24))
    program.press("enter", "tab", "t", *"47 20", "enter")
    assert f"problem: {reason}" in " ".join(program.text().split())


def test_the_drill_is_sent_where_a_hole_should_be(folder: Path) -> None:
    program = aligning(folder)
    program.press("tab", "g")
    x_mm, y_mm = BOARD.xy_mm[program_spot(program) - 1].tolist()
    assert program.console.asked[-1] == ("go_to", pytest.approx(x_mm), pytest.approx(y_mm))
    program.press("right", "-", "down")
    assert program.console.asked[-2:] == [("jog", "x", 12), ("jog", "y", -3)]


def program_spot(program: Program) -> int:
    screen = program.app.screens[-1]
    assert isinstance(screen, AlignmentScreen)
    return screen.measuring.spots[1].number


def test_holes_are_added_and_taken_off(folder: Path) -> None:
    program = aligning(folder)
    program.press("insert", "9", "enter")
    assert "hole '9' can't be added" in program.text()
    program.press("delete", "delete", "delete", "delete", "g", "enter", "t", "tab")
    assert "X10.000 Y10.000" not in program.text()
    program.press("insert", "1", "enter")
    assert "X10.000 Y10.000" in program.text()
    program.press("f2")
    assert asked(program).measured == () and isinstance(program.app.screens[-1], Files)


@pytest.mark.parametrize(
    ("change", "told"), [({"position_known": False}, "position is not known"), ({"moving": True}, "machine is moving")]
)
def test_a_machine_that_moves_or_is_lost_finds_no_hole(folder: Path, change: dict[str, Any], told: str) -> None:
    program = aligning(folder)
    program.console.now = replace(STANDING, **change)
    program.press("enter")
    assert told in program.text() and "X0.000 Y0.000" not in program.text()


def test_a_panel_or_no_board_is_not_measured(folder: Path) -> None:
    program = Program(FakeConsole())
    program.press("f", "j")
    assert "no board is loaded" in program.text()
    program.press("enter", "p")
    typed(program, "2", "1", "40")
    program.press("enter", "down", "enter", "j")
    assert "Measure a single board first" in program.text()


@pytest.mark.parametrize("key", [name for key in AlignmentScreen.keys for name in key.names])
def test_every_key_of_the_alignment_does_something(folder: Path, key: str) -> None:
    program = aligning(folder)
    if key in ("ctrl u", "ctrl r"):
        program.press("enter", *(["ctrl u"] if key == "ctrl r" else []))  # something to undo, or to redo
    before, requests, top = program.text(), len(program.console.asked), program.app.layers.top
    program.press(key)
    changed = program.text() != before or len(program.console.asked) > requests
    assert changed or program.app.layers.top is not top
