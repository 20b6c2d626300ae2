"""What the sheets let a student see is there to be seen: losses where they say so, none where they say none.

The figures are those of docs/lab/INSTRUCTOR.md, "Figures to expect"; each run is made in the sheet's own folder.
"""

import csv
import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from drillctl.cli import main
from tests.support.lab_sheets import entered, solve

FORWARD = ("forward.kmd", "--machine", "forcing-bench", "--plant", "dynamic")
BACK = ("moves.kmd", "--machine", "ramp-bench", "--plant", "dynamic")
START, SOLVED = False, True
# sheet, solved or not, run, axes that lose steps
LOSSES = [
    ("01-phase-sequences", START, ("hundred.kmd", "--machine", "motor-bench"), {"full", "wave", "half", "paper"}),
    ("01-phase-sequences", SOLVED, ("hundred.kmd", "--machine", "motor-bench"), set()),
    ("02-forcing", START, (*FORWARD, "--tick-hz", "330"), set()),
    ("02-forcing", START, (*FORWARD, "--tick-hz", "340"), {"x"}),
    ("02-forcing", SOLVED, (*FORWARD, "--tick-hz", "580"), set()),
    ("02-forcing", SOLVED, (*FORWARD, "--tick-hz", "640"), {"x"}),
    ("03-ramps", START, ("moves.kmd", "--machine", "ramp-bench"), set()),
    ("03-ramps", START, (*BACK, "--tick-hz", "450"), set()),
    ("03-ramps", START, BACK, {"half"}),
    ("03-ramps", START, (*BACK, "--tick-hz", "150"), {"half"}),
    ("03-ramps", SOLVED, (*BACK, "--tick-hz", "580"), set()),
    ("03-ramps", SOLVED, (*BACK, "--tick-hz", "640"), {"half", "column"}),
]


def begun(sheet: str, solved: bool, place: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A student's copy, solved or not."""
    copy = entered(sheet, place, monkeypatch)
    if solved:
        solve(sheet, copy)
    return copy


def ran(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, dict[str, int]]:
    """The outcome of a run that ends without a fault."""
    capsys.readouterr()
    assert main(["run", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(("sheet", "solved", "run", "losing"), LOSSES)
def test_steps_are_lost_where_the_sheet_says(
    sheet: str, solved: bool, run: tuple[str, ...], losing: set[str],
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    begun(sheet, solved, tmp_path, monkeypatch)
    lost = ran(capsys, *run)["lost_steps"]
    assert {axis for axis, steps in lost.items() if steps} == losing


@pytest.mark.parametrize(("solved", "spread"), [(START, {-12, -9}), (SOLVED, {0})], ids=["start", "solved"])
def test_homing_scatters_by_a_rest_or_not_at_all(
    solved: bool, spread: set[int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = begun("04-homing", solved, tmp_path, monkeypatch)
    ran(capsys, "homings.kmd", "--machine", "homing-bench", "--plant", "dynamic", "--vcd", "h.vcd")
    drawn = subprocess.run([sys.executable, "histogram.py", "h.vcd"], cwd=folder, capture_output=True, check=True)
    rows = [line.split() for line in drawn.stdout.decode().splitlines()]
    counts = Counter({int(row[0]): int(row[4]) for row in rows})
    assert set(+counts) == spread and counts.total() == 30


def test_the_board_lies_where_the_file_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = begun("06-board", SOLVED, tmp_path, monkeypatch)
    options = (folder / "options.txt").read_text("utf-8").split()
    ran(capsys, "amplifier.drl", *options, "--holes", "holes.csv")
    with (folder / "holes.csv").open(encoding="utf-8") as file:
        holes = [(row["tool"], float(row["x_mm"]), float(row["y_mm"])) for row in csv.DictReader(file)]
    assert Counter(tool for tool, _, _ in holes) == {"1": 14, "2": 3}
    grid_mm = 1.27
    assert all(abs(place / grid_mm - round(place / grid_mm)) * grid_mm < 0.011 for _, *xy in holes for place in xy)
