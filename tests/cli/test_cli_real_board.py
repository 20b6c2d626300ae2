"""A real CAD program's drill file, drilled from the command line: every hole where the file says, twice alike.

The holes are taken from the file by two lines of regular expression, not by our reader. The file is read in place.
"""

import csv
import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

Drillctl = Callable[..., "subprocess.CompletedProcess[str]"]
REAL = Path(__file__).resolve().parents[3] / "shared" / "drill-files" / "real"
HALF_STEP_MM = 25.4 / 1200 / 2
PRINTED_MM = 0.0001  # the CSV has four decimals
MM = {"INCH": 25.4, "METRIC": 1.0}


def holes_by_tool(file: Path) -> dict[int, list[tuple[float, float]]]:
    """Decimal Excellon only: a T line, then X..Y.. lines."""
    text = file.read_text()
    unit = re.search(r"^(INCH|METRIC)", text, re.M)
    assert unit is not None
    unit_mm = MM[unit[1]]
    found: dict[int, list[tuple[float, float]]] = {}
    for tool, x, y in re.findall(r"^T(\d+)$|^X(-?[\d.]+)Y(-?[\d.]+)$", text.partition("\n%")[2], re.M):
        if tool:
            number = int(tool)
        else:
            found.setdefault(number, []).append((float(x) * unit_mm, float(y) * unit_mm))
    return found


@pytest.mark.parametrize("name", ["gerbonara-driver-npth", "bldc-hardware-bldc-4.drl", "gerbonara-flashpads-npth.drl"])
def test_every_hole_is_where_the_file_says(name: str, drillctl: Drillctl, folder: Path) -> None:
    if not REAL.is_dir():
        pytest.skip("../shared/drill-files is not here: no real drill files to read")
    expected = holes_by_tool(REAL / name)
    results = []
    for run in ("a", "b"):
        done = drillctl("run", str(REAL / name), "--holes", f"{run}.csv", "--trace", f"{run}.trace", "--json")
        assert done.returncode == 0, done.stderr
        results.append((done.stdout, (folder / f"{run}.csv").read_bytes(), (folder / f"{run}.trace").read_bytes()))
    assert results[0] == results[1], "two runs must be byte-identical"
    told = json.loads(results[0][0])
    assert told["fault"] is None and set(told["lost_steps"].values()) == {0}
    with (folder / "a.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert told["holes_done"] == told["holes_total"] == len(rows) == sum(map(len, expected.values()))
    queues = {tool: iter(holes) for tool, holes in expected.items()}
    for row in rows:
        place = next(queues[int(row["tool"])])
        off_mm = max(abs(float(row["x_mm"]) - place[0]), abs(float(row["y_mm"]) - place[1]))
        assert off_mm <= HALF_STEP_MM + PRINTED_MM, f"T{row['tool']} at {place}: {off_mm:.4f} mm off"
