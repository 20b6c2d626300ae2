"""What a VCD file of a whole board costs: CPU seconds and memory of `run --vcd`, beside the same run without it.

    python -m benchmarks.vcd_cost [HOLES ...]      1,000 holes by default; 10,000 make a file of 1.7 GB

Random holes on 100 x 80 mm, drilled in the order of the file. Each line is a process of its own. Targets: 1,000 holes
under 3 s, 10,000 under 30 s, both under 150 MB.
"""

import argparse
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

BOARD_MM = (100.0, 80.0)
SMALL = Path(__file__).resolve().parents[1] / "examples" / "square.kmd"
TARGET_S_PER_HOLE, TARGET_MB = 0.003, 150.0


def board(holes: int) -> str:
    """A drill file with one tool."""
    places = random.Random(holes)
    rows = (f"X{places.uniform(0, BOARD_MM[0]):.3f}Y{places.uniform(0, BOARD_MM[1]):.3f}" for _ in range(holes))
    return "\n".join(["M48", "METRIC,TZ", "T1C0.8", "%", "T1", *rows, "M30", ""])


def cost(folder: str, *arguments: str) -> tuple[float, float]:
    """CPU seconds and MB of one call of drillctl, whose modules are compiled in a folder, as what is installed is."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = "import resource,sys; from drillctl.cli import main; main(); \
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)"
    call = [sys.executable, "-c", code, *arguments]
    compiled = os.environ | {"PYTHONPYCACHEPREFIX": folder, "PYTHONDONTWRITEBYTECODE": ""}
    done = subprocess.run(call, capture_output=True, text=True, check=True, env=compiled)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, int(done.stderr.split()[-1]) / 1024


def main() -> int:
    """Prints a line a board; 1 where a target is missed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("holes", type=int, nargs="*", default=[1000])
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        cost(folder, "run", str(SMALL), "--vcd", os.devnull)  # compiles the modules
        for holes in parser.parse_args().holes:
            file, vcd = Path(folder, "board.drl"), Path(folder, "board.vcd")
            file.write_text(board(holes), "ascii")
            plain_s, plain_mb = cost(folder, "run", str(file))
            seconds, mb = cost(folder, "run", str(file), "--vcd", str(vcd))
            size_mb = vcd.stat().st_size / 1e6
            told = f"{holes} holes: {seconds:.2f} s, {mb:.0f} MB for a file of {size_mb:.0f} MB"
            print(f"{told}; without it {plain_s:.2f} s, {plain_mb:.0f} MB; load {os.getloadavg()[0]:.1f}", flush=True)
            missed = missed or seconds > TARGET_S_PER_HOLE * holes or mb > TARGET_MB
    return int(missed)


if __name__ == "__main__":
    sys.exit(main())
