"""Boards of 50 holes swept on the dynamic plant: machines a second, on this computer's cores and on a dask cluster.

Run as ``python -m benchmarks.board_sweep [MACHINES]`` (default 1000). A grid of tick rates, ramps and frictions drills
one board: in one process, in a process a core, and by two dask workers of one thread on this computer. All results
must be the same bytes. CPU seconds are those of the workers; the wall clock has what else the computer does in it.
"""

import os
import sys
import tempfile
import time
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage

import numpy as np

from benchmarks.dynamic_board import board as drill_file
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.lab.board import Board
from drillctl.lab.question import Question
from drillctl.lab.sweep import Results, WorkerPool, sweep
from drillctl.lab.tables import ramps
from drillctl.lab.workers import cores
from drillctl.machine import Library, shipped_tables
from drillctl.plant.dynamic.kernel import KERNEL

HOLES, WORKERS = 50, 2
RATES_HZ = tuple(range(300, 550, 50))
LIBRARY = Library((shipped_tables(),))


def question(folder: Path, machines: int) -> Question:
    """A grid of at least so many machines: 5 rates, 2 ramps, and frictions."""
    machine = LIBRARY.machine("pcb-drill")
    source = drill_file(folder / "board.drl", HOLES)
    programs = {hz: load_job(source, machine.at_rate(hz), JobSetup(machine.name)).program for hz in RATES_HZ}
    axis = machine.axes[0]
    frictions = tuple(np.linspace(0.5, 2, -(-machines // (2 * len(RATES_HZ)))).tolist())
    return Question(
        axis, RATES_HZ, ramps(f"{axis.ramp.name},direct-start", axis, LIBRARY), ((axis.phase.name, axis.phase),),
        (("coulomb_nm", frictions),), (0.0,), (), board=Board.of("board.drl", machine, (0, 1), programs),
    )  # fmt: skip


def cpu_s() -> float:
    """CPU seconds of this process and of its children that have ended."""
    return sum(used.ru_utime + used.ru_stime for used in map(getrusage, (RUSAGE_SELF, RUSAGE_CHILDREN)))


def swept(asked: Question, out: Path, name: str, pool: WorkerPool, workers: int) -> bytes:
    """Sweeps into a file, prints how quickly, and returns its bytes."""
    began, used = time.monotonic(), cpu_s()
    with Results(out, asked) as results:
        for _ in sweep(asked, results, pool):
            pass
    wall_s, spent_s = time.monotonic() - began, cpu_s() - used
    rate = asked.machines / wall_s
    cost = f"{1000 * spent_s / asked.machines:6.0f} ms CPU a board" if spent_s > wall_s / 10 else "CPU in the workers"
    print(f"{name:24} {wall_s:7.1f} s, {rate:6.2f} boards a second, {rate / workers:6.2f} a worker; {cost}", flush=True)
    return out.read_bytes()


def main(machines: int) -> None:
    """Prints a line for each pool."""
    from distributed import LocalCluster

    print(f"load {os.getloadavg()[0]:.1f} on {cores()} cores; compiled law: {'yes' if KERNEL.compiled else 'no'}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        asked = question(folder, machines)
        print(f"{asked.machines} boards of {HOLES} holes")
        whole = swept(asked, folder / "cores.csv", f"{cores()} processes", WorkerPool(cores()), cores())
        # distributed's LocalCluster has no annotations.
        with LocalCluster(n_workers=WORKERS, threads_per_worker=1, dashboard_address=None) as cluster:  # type: ignore[no-untyped-call]
            pool = WorkerPool(cluster=cluster.scheduler_address)
            assert swept(asked, folder / "dask.csv", f"dask, {WORKERS} workers", pool, WORKERS) == whole
        few = question(folder, max(machines // 10, 10))
        swept(few, folder / "one.csv", f"1 process, {few.machines} boards", WorkerPool(), 1)
        lost = sum(row.split(b",")[6] == b"1" for row in whole.splitlines()[1:])
    print(f"{lost} of {asked.machines} boards lose steps; cores and dask gave the same bytes")
    print(f"load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else 1000)
