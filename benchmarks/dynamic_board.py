"""Boards drilled whole on the dynamic plant: CPU time of the command ``drillctl run``, its start included.

Run as ``python -m benchmarks.dynamic_board [HOLES ...]``. Every tick by itself in plain Python, against stretches of
ticks in plain Python, and with the compiled law; all traces must be the same bytes. The boards are uniform holes of
seed 720 on 70 x 70 mm, row by row. Above 200 holes only the last one runs,
with a drill that meets no board.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage

import numpy as np

from drillctl.plant.dynamic.kernel import KERNEL

WEARLESS = ("--fault", "broken=1")  # a drill that cuts is blunt, and stalls Z, long before its ten thousandth hole
SIDE_MM, ROW_MM, MOST_TICKED = 70, 5, 200
FORMS = {
    "tick, plain": ("plain", "tick"), "stretches, plain": ("plain", "fast"), "stretches, compiled": ("", "fast"),
}  # fmt: skip


def board(path: Path, holes: int) -> Path:
    """A drill file of so many holes."""
    places = np.random.default_rng(720).uniform(5, 5 + SIDE_MM, (holes, 2)).round(3)
    row = places[:, 1] // ROW_MM
    places = places[np.lexsort((np.where(row % 2, -places[:, 0], places[:, 0]), row))]
    lines = "".join(f"X{x:.3f}Y{y:.3f}\n" for x, y in places.tolist())
    path.write_text(f"M48\nMETRIC,TZ\nT1C0.800\n%\nT1\n{lines}M30\n")
    return path


def drilled(folder: Path, source: Path, kernel: str, engine: str, faults: tuple[str, ...] = ()) -> tuple[float, bytes]:
    """CPU seconds of one run, and its trace."""
    trace = folder / "run.trace"
    environment = os.environ | {"DRILLCTL_KERNEL": kernel, "PYTHONPYCACHEPREFIX": str(folder)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    command = ["run", str(source), "--plant", "dynamic", "--engine", engine, "--trace", str(trace), *faults]
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-m", "drillctl", *command], check=True, capture_output=True, env=environment)
    after = getrusage(RUSAGE_CHILDREN)
    found = trace.read_bytes()
    trace.unlink()
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, found


def main(counts: list[int]) -> None:
    """Prints a table for each board."""
    print(f"load {os.getloadavg()[0]:.1f}; compiled law: {'yes' if KERNEL.compiled else 'no'}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        drilled(folder, board(folder / "warm.drl", 2), "", "fast")  # modules are compiled before, as installed ones are
        for holes in counts:
            faults = WEARLESS if holes > MOST_TICKED else ()
            source, reference, first = board(folder / f"{holes}.drl", holes), b"", 0.0
            for form, (kernel, engine) in FORMS.items():
                if holes > MOST_TICKED and form != list(FORMS)[-1]:
                    continue
                spent, trace = drilled(folder, source, kernel, engine, faults)
                reference, first = reference or trace, first or spent
                assert trace == reference, f"{form}: another trace"
                print(f"{holes:6} holes, {form:20} {spent:7.2f} s CPU  {first / spent:5.1f} times")


if __name__ == "__main__":
    main([int(word) for word in sys.argv[1:]] or [200])
