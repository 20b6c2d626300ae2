"""What the fast engine does: ratios measured in one run, beside the machine's load.

Run as ``python -m benchmarks.fastforward``; CPU time, the median of 7. The board: 10,000 holes of seed 720, uniform on
100 x 80 mm, on ``pcb-drill``; "strip": the same holes row by row in strips of 1 mm. ``--same N`` runs N times in two
engines and two processes and compares every byte.

    trace      one output word a tick, the tapes made and put together into a preallocated array that was written before
    copy       np.copyto over the same bytes, into another one
    events     the same, and the ticks and words at which it changes
"""

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from time import process_time

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.fastforward.batch import Batch
from drillctl.generation.job import names_of
from drillctl.kmd import RECORD, Op, to_text
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.replay.compare import replay
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.ticker import Ticker
from drillctl.trace import segment_bytes
from drillctl.trace.tapes import ImagePool, Images, images

RUNS = 7
HOLES = 10_000
BOARD_MM = (100, 80)
STEPS_PER_MM = 1200 / 25.4
DRUM, ROW = "boiler-drum", 400  # holes of a row on it
TICK_HOLES = 4  # of the board, that tick is measured by
GOLDEN_TICKS = 10_000_000
SMALL = Path(__file__).resolve().parents[1] / "examples" / "blinker.drl"


def cpu_s(call: Callable[[], object]) -> float:
    """Median of the CPU seconds of 7 calls."""
    spent = []
    for _ in range(RUNS):
        started = process_time()
        call()
        spent.append(process_time() - started)
    return median(spent)


def child_s(folder: Path, *command: str) -> float:
    """Median of the CPU seconds of 7 processes, their start included; compiled before, as what is installed is."""
    spent, environment = [], os.environ | {"PYTHONPYCACHEPREFIX": str(folder), "PYTHONDONTWRITEBYTECODE": ""}
    for _ in range(RUNS + 1):
        before = getrusage(RUSAGE_CHILDREN)
        call = [sys.executable, "-m", "drillctl", *command]
        subprocess.run(call, capture_output=True, check=True, env=environment)
        after = getrusage(RUSAGE_CHILDREN)
        spent.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return median(spent[1:])


def holes_mm(strip: bool) -> NDArray[np.float64]:
    """The board's holes, (n, 2)."""
    places = np.random.default_rng(720).uniform((0, 0), BOARD_MM, (HOLES, 2)).round(3)
    row = places[:, 1].astype(int)
    there_and_back = np.where(row % 2, -places[:, 0], places[:, 0])
    return places[np.lexsort((there_and_back, row))] if strip else places


def program(places_mm: NDArray[np.float64]) -> NDArray[np.void]:
    """Go, down, up at each hole, after an initialisation."""
    records = np.zeros(3 * len(places_mm) + 2, RECORD)
    records["opcode"][[0, -1]] = Op.INICJALIZACJA, Op.KONIEC
    go = records[1:-1].reshape(-1, 3)
    go["opcode"], go["flags"][:, 0], go["axes"][:, 0] = (Op.GOTO_X_Y, Op.WIERTLO_DOL, Op.WIERTLO_GORA), 1, 3
    go["args"][:, 0, :2] = np.rint(places_mm * STEPS_PER_MM)
    records["sequence"] = np.arange(1, len(records) + 1)
    return records


def longest_batch(machine: Machine, commands: NDArray[np.void]) -> tuple[Batch, ImagePool]:
    """What is foreseen of a program once its strokes are known: nearly all."""
    ticker = FastTicker.ideal(machine, capacity=len(commands))
    ticker.queue.put(commands)
    batch = max((batch for batch in ticker.batches() if batch is not None), key=lambda batch: batch.end)
    return batch, ticker.engine.pool


def trace(batch: Batch, pool: ImagePool, out: Images) -> Images:
    """The image of every tick."""
    tapes = batch.tapes(pool)
    return images(pool.images, tapes, out)


def events(batch: Batch, pool: ImagePool, out: Images) -> tuple[NDArray[np.intp], Images]:
    """Ticks and images at which the outputs change."""
    trace(batch, pool, out)
    ticks = np.flatnonzero(out[1:] != out[:-1]) + 1
    return ticks, out[ticks]


def tick_s(machine: Machine, commands: NDArray[np.void]) -> float:
    """CPU seconds of one tick of the same board."""
    ticker = Ticker.simulated(machine)
    ticker.queue.put(commands[: 1 + 3 * TICK_HOLES])
    started = process_time()
    ticks = ticker.run(TICK_HOLES * 10_000, lambda: not ticker.controller.busy and not len(ticker.queue))
    return (process_time() - started) / ticks


def shown(name: str, value: str, goal: str, reached: bool) -> bool:
    """One line; returns whether the goal was reached."""
    print(f"{name:34} {value:44} goal {goal:24} {'reached' if reached else 'MISSED'}")
    return reached


def measured(machine: Machine, commands: NDArray[np.void]) -> tuple[int, float, float, float]:
    """Ticks of a board, and the seconds of copying so many words, of its trace, and of its events."""
    batch, pool = longest_batch(machine, commands)
    out, source = (np.full(batch.end, word, pool.images.dtype) for word in (1, 7))
    calls = (lambda: np.copyto(out, source), lambda: trace(batch, pool, out), lambda: events(batch, pool, out))
    return batch.end, *map(cpu_s, calls)


def boards(machine: Machine) -> list[bool]:
    """Trace and events of the board in both orders, against copying and against tick."""
    goal = "10 % (floor 5 %)"
    ticks, copy_s, trace_s, events_s = measured(machine, program(holes_mm(strip=False)))
    value = f"{ticks / trace_s / 1e6:.0f} M ticks/s, {copy_s / trace_s:.1%} of copying"
    found = [shown(f"trace, random, {ticks:,} ticks", value, goal, copy_s / trace_s > 0.05)]
    rate, law_s = ticks / events_s, tick_s(machine, program(holes_mm(strip=False)))
    value = f"{rate / 1e6:.0f} M ticks/s, {rate * law_s:,.0f} times tick ({law_s * 1e6:.1f} us)"
    found.append(shown("events, random", value, "100 M/s, 100 times", rate > 1e8 and rate * law_s > 100))
    strip_ticks, copy_s, strip_s, _ = measured(machine, program(holes_mm(strip=True)))
    ratio = trace_s / ticks / (strip_s / strip_ticks)
    value = f"{strip_ticks / strip_s / 1e6:.0f} M ticks/s, {copy_s / strip_s:.1%}; {ratio:.2f} of random"
    return [*found, shown(f"trace, strip, {strip_ticks:,} ticks", value, "0.5 of random", ratio > 0.5)]


def golden(machine: Machine, folder: Path) -> bool:
    """A golden of 10 M ticks in segments, replayed: read, foreseen, its checksum made and compared."""
    ticker, file = FastTicker.ideal(machine, taped=True), folder / "golden.seg"
    commands = program(holes_mm(False)[: HOLES * GOLDEN_TICKS // 36_000_000])
    put = 0
    while not (put and ticker.over()):
        put += ticker.queue.put(commands[put:][: ticker.queue.room])
        ticker.turn(ticker.over)
    names = names_of(machine)
    header = [("machine", machine.name), ("digest", machine.digest), ("tick_hz", str(machine.tick_hz))]
    header += [("plant", "ideal"), ("seed", "0")]
    header += [("command", f"{record['sequence']} {to_text(record, names)}") for record in commands]
    kept = ticker.record(header)
    file.write_bytes(segment_bytes(kept))
    library = Library((shipped_tables(),))
    assert replay(file, library).difference is None
    spent_s = cpu_s(lambda: replay(file, library))
    return shown(f"golden of {kept.end:,} ticks verified", f"{spent_s:.3f} s", "0.15 s", spent_s < 0.15)


def commands(folder: Path) -> list[bool]:
    """The whole program, from a shell."""
    board, segments = folder / "board.drl", folder / "board.seg"
    lines = [f"X{x:.3f}Y{y:.3f}" for x, y in holes_mm(False).tolist()]
    board.write_text("\n".join(["M48", "METRIC", "T1C0.800", "%", "T1", *lines, "M30", ""]), "ascii")
    run_s, help_s = child_s(folder, "run", str(board), "--trace", str(segments)), child_s(folder, "--help")
    inspect_s, small_s = child_s(folder, "inspect", str(SMALL)), child_s(folder, "run", str(SMALL))
    size = segments.stat().st_size
    return [
        shown("drill file to segment file", f"{run_s:.2f} s", "0.8 s", run_s < 0.8),
        shown("the segment file", f"{size:,} bytes", "250,000", size < 250_000),
        shown("drillctl --help", f"{help_s:.3f} s", "0.15 s", help_s < 0.15),
        shown("inspect of 26 holes", f"{inspect_s:.3f} s", "0.2 s", inspect_s < 0.2),
        shown("run of 26 holes", f"{small_s:.3f} s", "0.4 s", small_s < 0.4),
    ]


def drum_row(folder: Path) -> bool:
    """A row of 400 holes on the boiler-drum drill, at 100,000 ticks a second, from a shell; nothing is recorded."""
    pattern, sentences = folder / "row.toml", folder / "row.sentences"
    eight = (Path(__file__).resolve().parents[1] / "examples" / "drum-row.toml").read_text("utf-8")
    row = eight.replace("count = 8", f"count = {ROW}").replace("pitch_mm = 120.0", "pitch_mm = 8.0")
    pattern.write_text(row, "utf-8")
    call = [sys.executable, "-m", "drillctl", "convert", str(pattern), "--to", str(sentences), "--machine", DRUM]
    subprocess.run(call, capture_output=True, check=True)
    run_s = child_s(folder, "run", str(sentences), "--machine", DRUM)
    return shown(f"part program of {ROW} holes, {DRUM}", f"{run_s:.2f} s", "2 s", run_s < 2)


def same(times: int, folder: Path) -> int:
    """So many runs in each engine, in turn; how many different results there are."""
    job, found = Path(__file__).resolve().parents[1] / "examples" / "square.kmd", set()
    for number in range(2 * times):
        files = [folder / f"run.{suffix}" for suffix in ("trace", "seg", "csv")]
        engine = ("fast", "tick")[number % 2]
        call = [sys.executable, "-m", "drillctl", "run", str(job), "--json", "--engine", engine]
        done = subprocess.run([*call, "--trace", files[0], "--holes", files[2]], capture_output=True, check=True)
        found.add(hashlib.sha256(b"".join([done.stdout, files[0].read_bytes(), files[2].read_bytes()])).hexdigest())
    print(f"{times} runs in each engine: {len(found)} different result(s)")
    return len(found)


def main() -> int:
    """Prints a line a figure; 1 where a goal is missed."""
    options = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    options.add_argument("--same", type=int, default=0, metavar="N", help="N runs in each engine, compared")
    times = options.parse_args().same
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if times:
            return int(same(times, folder) != 1)
        machine = Library((shipped_tables(),)).machine("pcb-drill")
        versions = f"python {sys.version.split()[0]}, numpy {np.__version__}"
        print(f"{versions}, load {os.getloadavg()[0]:.2f}, median of {RUNS}")
        reached = [*boards(machine), golden(machine, folder), *commands(folder), drum_row(folder)]
    return int(not all(reached))


if __name__ == "__main__":
    sys.exit(main())
