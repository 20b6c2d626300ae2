"""What it costs to look at the run of a large board in segments: CPU and memory to the first frame, and after it.

    python -m benchmarks.scope_open [HOLES]      10,000 holes by default: 36 million ticks

The board is that of vcd_cost. Targets: the first frame within 1 s of CPU time (imports left out) and 200 MB.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from time import process_time

from benchmarks.vcd_cost import board
from drillctl.console.scope_runs import TraceFile
from drillctl.machine import Library, shipped_tables
from drillctl.ui.models.viewport import SignalRows, Viewport
from drillctl.ui.screens.scope_view import ScopeLayout, ScopeLook, scope_lines
from drillctl.ui.widgets.texts import boxed

COLUMNS, ROWS = 160, 46
TARGET_S, TARGET_MB = 1.0, 200.0


def frames(file: Path) -> Iterator[tuple[str, float, float]]:
    """What was done, CPU seconds it took, MB the process has taken at most: the first frame, then zoomed out to all."""
    before = process_time()
    run = TraceFile(file, Library((shipped_tables(),)))
    view = Viewport().sized(ScopeLayout.of(run.signals(), COLUMNS).waves).of_run(run.first_tick, run.last_tick)
    for told, zoomed in (("first frame", 0), ("the whole run", 40), ("the whole run again", 0)):
        view = view.zoomed(zoomed)
        boxed(scope_lines(run, ScopeLook(view, SignalRows(len(run.signals()))), COLUMNS, ROWS)[0], COLUMNS, ROWS)
        yield told, process_time() - before, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        before = process_time()


def main() -> int:
    """Prints a line a frame; 1 where the first one misses a target."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("holes", type=int, nargs="?", default=10_000)
    with tempfile.TemporaryDirectory() as folder:
        job, file = Path(folder, "board.drl"), Path(folder, "board.seg")
        job.write_text(board(parser.parse_args().holes), "ascii")
        call = [sys.executable, "-m", "drillctl", "run", str(job), "--trace", str(file)]
        subprocess.run(call, check=True, capture_output=True)
        print(f"a file of {file.stat().st_size / 1e6:.2f} MB; load {os.getloadavg()[0]:.1f}")
        costs = list(frames(file))
    for told, seconds, mb in costs:
        print(f"{told}: {seconds:.2f} s, {mb:.0f} MB so far")
    return int(costs[0][1] > TARGET_S or costs[0][2] > TARGET_MB)


if __name__ == "__main__":
    sys.exit(main())
