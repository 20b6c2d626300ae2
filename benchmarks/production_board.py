"""What the production drill makes of its class of work: holes of 0.1 to 0.3 mm at 0.5 mm pitch on six spindles.

    python benchmarks/production_board.py [HOLES ...]

For each number of holes (2,000 and 10,000): holes per minute with the way to the next hole begun during the lift and
with one after the other, and the processor time of a run on the ideal plant. No overlap is had where a file
says nothing of `[drill] clear`. The board is a serpentine of three tools; the files are in a temporary folder.
"""

import sys
import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.viewmodel.job_options import JobOptions

PITCH_MM, ROW = 0.5, 50
TOOLS_MM = (0.1, 0.2, 0.3)


def board(holes: int) -> str:
    """An Excellon file with so many holes, shared evenly by the tools."""
    lines = ["M48", "METRIC,TZ", *(f"T{n}C{mm:.3f}" for n, mm in enumerate(TOOLS_MM, 1)), "%"]
    for number in range(1, len(TOOLS_MM) + 1):
        lines.append(f"T{number}")
        for hole in range(number - 1, holes, len(TOOLS_MM)):
            row, place = divmod(hole, ROW)
            column = place if row % 2 == 0 else ROW - 1 - place
            lines.append(f"X{column * PITCH_MM:.3f}Y{row * PITCH_MM:.3f}")
    return "\n".join([*lines, "M30", ""])


def run(machine: Machine, file: Path) -> tuple[float, float, int]:
    """Minutes of the machine, seconds of the processor, and the fault code of a run of the board."""
    before = time.process_time()
    job = load_job(file, machine, JobSetup(JobOptions(order="file")))
    ticker = FastTicker.ideal(machine, capacity=len(job.program))
    ticker.queue.put(job.program)
    while not ticker.over() or not ticker.controller.tick:
        ticker.turn(ticker.over)
    spent = time.process_time() - before
    return ticker.controller.tick / machine.tick_hz / 60, spent, ticker.controller.fault


def main() -> None:
    """Prints a line for each number of holes and each way."""
    plain = Library((shipped_tables(),)).machine("eight-axis")
    with TemporaryDirectory() as folder:
        file = Path(folder) / "board.drl"
        for holes in [int(text) for text in sys.argv[1:]] or [2000, 10_000]:
            file.write_text(board(holes), "ascii")
            for name, machine in (("overlap", plain), ("one after the other", replace(plain, drill_clear_steps=None))):
                minutes, spent, fault = run(machine, file)
                rate = f"{holes / minutes:.1f} holes/min on each of six boards"
                print(f"{holes} holes, {name}: {rate}, {spent:.2f} s of processor time, fault {fault}")


if __name__ == "__main__":
    main()
