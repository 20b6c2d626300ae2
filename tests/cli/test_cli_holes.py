"""The holes CSV: a plain table of each hole as it was wanted and made, and how far the two are apart."""

import csv
import subprocess
from collections.abc import Callable
from math import hypot
from pathlib import Path

import pytest

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
BOTH = ["tool", "diameter_mm", "x_mm", "y_mm", "number", "wanted_x_mm", "wanted_y_mm", "error_mm"]
WANTED = {1: (10.16, 30.48), 2: (29.21, 30.48), 3: (16.51, 52.07)}  # kicad.drl, by number
STEP_MM = 25.4 / 1200


def table(file: Path) -> list[dict[str, str]]:
    with file.open(newline="") as stream:
        return [*csv.DictReader(stream)]


@pytest.mark.parametrize("options", [[], ["--mirror", "x", "--rotate", "90"], ["--offset", "3,4"]])
def test_each_hole_is_told_as_wanted_and_as_made(options: list[str], drillctl: Drillctl, folder: Path) -> None:
    assert drillctl("run", "kicad.drl", "--holes", "h.csv", *options).returncode == 0
    rows = table(folder / "h.csv")
    assert list(rows[0]) == BOTH and [row["number"] for row in rows] == ["1", "2", "3"]
    for row in rows:
        number, x, y, wanted_x, wanted_y, error = (float(row[name]) for name in
            ("number", "x_mm", "y_mm", "wanted_x_mm", "wanted_y_mm", "error_mm"))  # fmt: skip
        assert (wanted_x, wanted_y) == pytest.approx(WANTED[int(number)], abs=1e-4)
        assert error == pytest.approx(hypot(x - wanted_x, y - wanted_y), abs=2e-4) and error < STEP_MM


def test_motors_with_inertia_make_other_holes_than_wanted(drillctl: Drillctl, folder: Path) -> None:
    for plant in ("ideal", "dynamic"):
        assert drillctl("run", "kicad.drl", "--holes", f"{plant}.csv", "--plant", plant).returncode == 0
    ideal, dynamic = (table(folder / f"{plant}.csv") for plant in ("ideal", "dynamic"))
    assert [row["wanted_x_mm"] for row in ideal] == [row["wanted_x_mm"] for row in dynamic]
    assert [row["error_mm"] for row in ideal] != [row["error_mm"] for row in dynamic]


def test_each_spindle_has_its_row_and_old_columns_their_places(drillctl: Drillctl, folder: Path) -> None:
    done = drillctl("run", "kicad.drl", "--holes", "h.csv", "--machine", "eight-axis", "--spindles", "2,5")
    assert done.returncode == 0, done.stderr
    rows = table(folder / "h.csv")
    assert list(rows[0]) == [*BOTH[:4], "spindle", *BOTH[4:]]
    assert {(row["number"], row["spindle"]) for row in rows} == {(n, s) for n in "123" for s in "25"}


def test_a_queue_wants_no_hole_at_a_place(drillctl: Drillctl, folder: Path) -> None:
    assert drillctl("run", "hole.kmd", "--holes", "h.csv").returncode == 0
    rows = table(folder / "h.csv")
    assert rows and all([row[name] for name in BOTH[4:]] == [""] * 4 for row in rows)


def test_what_is_left_of_a_job_keeps_its_numbers(drillctl: Drillctl, folder: Path) -> None:
    """Holes that are resumed have the numbers, and the places, that they had in the whole job."""
    assert drillctl("run", "kicad.drl", "--journal", "j", "--holes", "all.csv").returncode == 0
    lines = (folder / "j").read_text().splitlines(keepends=True)
    done = next(number for number, line in enumerate(lines) if '"done"' in line)
    (folder / "j").write_text("".join(lines[: done + 1]))
    assert drillctl("resume", "j", "--holes", "rest.csv").returncode == 0
    assert table(folder / "rest.csv") == table(folder / "all.csv")[1:]
