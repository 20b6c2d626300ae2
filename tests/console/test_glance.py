"""A glance at a drill file: the holes as they would be placed, within a bound of bytes, and nothing else changed."""

from pathlib import Path

import numpy as np
import pytest

from drillctl.console.glance import MOST_BYTES, holes_of
from drillctl.generation.drillfile import read
from drillctl.viewmodel.job_options import JobOptions, PanelOf

HEAD = "M48\nMETRIC,TZ\nT1C0.8\nT2C1.2\n%\n"
HOLES = "T1\nX10.0Y5.0\nX30.0Y5.0\nT2\nX10.0Y25.0\n"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    found = tmp_path / "board.drl"
    found.write_text(HEAD + HOLES + "X20.0Y5.0G85X26.0Y5.0\nM30\n")
    return found


def test_holes_and_the_ends_of_slots_are_seen_as_load_would_place_them(file: Path) -> None:
    seen = holes_of(file, JobOptions())
    assert seen is not None
    assert seen.xy_mm.tolist() == [[0, 0], [20, 0], [0, 20], [10, 0], [16, 0]]
    assert seen.tool.tolist() == [0, 0, 1, 1, 1]
    assert [(tool.number, tool.diameter_mm, tool.holes) for tool in seen.tools] == [(1, 0.8, 2), (2, 1.2, 3)]
    turned = holes_of(file, JobOptions(rotate_deg=90.0, offset_mm=(1.0, 2.0), panel=PanelOf(9, 9, 40.0, 40.0)))
    assert turned is not None
    assert np.allclose(turned.xy_mm, [[21, 2], [21, 22], [1, 2], [21, 12], [21, 18]])


def test_a_long_file_is_not_read(file: Path) -> None:
    at_most = HEAD + HOLES
    file.write_text(at_most + ";" * (MOST_BYTES - len(at_most) - 5) + "\nM30\n")
    assert file.stat().st_size == MOST_BYTES and holes_of(file, JobOptions()) is not None
    file.write_text(file.read_text() + "\n")
    assert holes_of(file, JobOptions()) is None
    assert len(read(file).hole_xy_mm) == 3


@pytest.mark.parametrize("text", ["", "a letter\n", "KMD_GOTO_X_Y 1 2\n", "M48\nT1C1\n%\nM30\n"])
def test_what_is_no_board_is_not_drawn(file: Path, text: str) -> None:
    file.write_text(text)
    assert holes_of(file, JobOptions()) is None
    assert holes_of(file.parent, JobOptions()) is None
    assert holes_of(file.parent / "gone", JobOptions()) is None


def test_a_format_or_a_turn_that_cannot_be_meant_is_no_error(file: Path) -> None:
    for options in (JobOptions(format="furlongs"), JobOptions(rotate_deg=float("nan"))):
        assert holes_of(file, options) is None
