"""The teacher's check of sheet 5: runs figure.kmd and compares what came of it with what was asked for."""

import csv
import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
MM_PER_STEP = 25.4 / 1200
HOLES_STEPS = [(1200, 900), (1672, 900), (1672, 1372), (1436, 1608), (1200, 1372)]
TICKS = 13613
NEAR_MM = 0.001


def test_the_queue_draws_the_figure(tmp_path: Path) -> None:
    holes = tmp_path / "holes.csv"
    call = [sys.executable, "-m", "drillctl", "run", str(HERE / "figure.kmd"), "--json", "--holes", str(holes)]
    call += ["--port", "simulated"]  # whatever the mode in a submitted machine's file says
    done = subprocess.run(call, capture_output=True, text=True, timeout=60, check=False)
    outcome = json.loads(done.stdout)
    assert done.returncode == 0, done.stderr.strip() or f"{outcome['fault']['name']}: {outcome['fault']['cause']}"
    rows = places_mm(holes)
    assert len(rows) == len(HOLES_STEPS)
    for number, (made, wanted) in enumerate(zip(rows, HOLES_STEPS, strict=True), start=1):
        misses = [abs(a - b * MM_PER_STEP) for a, b in zip(made, wanted, strict=True)]
        assert max(misses) < NEAR_MM, f"hole {number} is at {made} mm"
    assert outcome["position"] == {"x": 1200, "y": 900, "z": 0}, "the head is not back at the base"
    assert outcome["ticks"] == TICKS, "not the moves and waits that were asked for, to the tick"


def places_mm(holes: Path) -> list[tuple[float, float]]:
    """X and Y of each hole, in drilling order."""
    with holes.open(encoding="utf-8") as file:
        return [(float(row["x_mm"]), float(row["y_mm"])) for row in csv.DictReader(file)]
