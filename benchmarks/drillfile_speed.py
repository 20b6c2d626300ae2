"""CPU seconds to read 100,000 holes, beside gerbonara on the same files in the same run.

    python benchmarks/drillfile_speed.py        needs gerbonara (pip install -e .[bench])

Median of 7 runs each, CPU time of this process; the machine's load is printed, as it is part of the result.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable

from gerbonara.excellon import ExcellonFile

from drillctl.generation.drillfile import decode

HOLES = 100_000
RUNS = 7
COLUMNS = 400
PITCH_MM = 1.27


def places_mm() -> list[tuple[float, float]]:
    return [(i % COLUMNS * PITCH_MM, i // COLUMNS * PITCH_MM) for i in range(HOLES)]


def kicad_decimal() -> str:
    """As KiCad writes it: metric, with decimal points."""
    body = "".join(f"X{x:.3f}Y{-y:.3f}\n" for x, y in places_mm())
    comment = "; FORMAT={-:-/ absolute / metric / decimal}"
    return f"M48\n{comment}\nFMAT,2\nMETRIC\nT1C0.800\n%\nG90\nG05\nT1\n{body}T0\nM30\n"


def altium_4_4() -> str:
    """As Altium writes it: metric 4:4 with trailing zeros dropped."""
    body = "".join(f"X{_dropped(x)}Y{_dropped(y)}\n" for x, y in places_mm())
    return f"M48\n;FILE_FORMAT=4:4\nMETRIC,LZ\nT1F00S00C0.8000\n%\nT01\n{body}M30\n"


def _dropped(mm: float) -> str:
    return f"{round(mm * 1e4):08d}".rstrip("0") or "0"


def median_seconds(task: Callable[[], object]) -> float:
    times = []
    for _ in range(RUNS):
        started = time.process_time()
        task()
        times.append(time.process_time() - started)
    return statistics.median(times)


def main() -> None:
    print(f"load {os.getloadavg()[0]:.2f} on {os.cpu_count()} cores; CPU seconds, median of {RUNS}, {HOLES} holes")
    for name, text in (("KiCad decimal", kicad_decimal()), ("Altium 4:4", altium_4_4())):
        data = text.encode()
        assert len(decode(data, name=name).hole_xy_mm) == len(ExcellonFile.from_string(text).objects) == HOLES
        ours = median_seconds(lambda data=data: decode(data, name="speed"))
        theirs = median_seconds(lambda text=text: ExcellonFile.from_string(text))
        print(f"{name:14}  drillctl {ours:.3f}  gerbonara {theirs:.3f}  ratio {theirs / ours:.1f}")


if __name__ == "__main__":
    main()
