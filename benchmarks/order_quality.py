"""How good and how quick the orders of drilling are, beside LKH's: python benchmarks/order_quality.py

LKH (Helsgaun), here through the package elkai, is the yardstick: on boards of this size it is all but
optimal. Its licence allows non-commercial use only, so it is never imported by drillctl or its tests.
Every line is one board: seeded random holes on 100 x 80 mm at 1200 steps per inch, and the tool with the
most holes of each real board in ../shared/drill-files/real, where that folder is there. Costs are travel
ticks of the seven-state ramp from the file's zero; times are CPU seconds, the median of several runs.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.drillfile import DrillFileError, read
from drillctl.generation.order import TravelCost, path_ticks, plan

REAL_BOARDS = Path(__file__).resolve().parents[2] / "shared" / "drill-files" / "real"
STEPS_PER_MM = 1200 / 25.4
BOARD_MM = (100.0, 80.0)
SEEDS = (1, 2, 3)
COUNTS = (50, 200, 1000)
LARGE = 10_000  # too many for LKH's full matrix: compared with 'nearest' alone
RUNS = {50: 7, 200: 7, 1000: 3, LARGE: 3}  # timed runs for boards of up to so many holes
REAL_HOLES = (30, 1000)  # real tools with fewer holes are no test, with more too slow for LKH
# Ticks of 0 to 7 steps on the seven-state ramp; from 8 on it is steps + 21.
SHORT_TICKS = (0, 7, 11, 18, 17, 24, 20, 27)
START = (0, 0)

Board = tuple[str, NDArray[np.int64]]
HEADINGS = ("board", "holes", "to LKH", "to nearest", "CPU s", "nearest", "LKH", "load")
LINE = "{:44.44} {:>6} {:>7} {:>10} {:>7} {:>8} {:>7} {:>5}"


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--no-real", action="store_true", help="random boards only")
    options.add_argument("--no-large", action="store_true", help=f"leave out the {LARGE} holes")
    asked = options.parse_args()
    print(LINE.format(*HEADINGS))
    boards = [random_board(count, seed) for count in COUNTS for seed in SEEDS]
    if not asked.no_real:
        boards += real_boards()
    ratios = [report(board, with_lkh=True) for board in boards]
    print(f"worst to LKH {max(ratios):.4f}, mean {statistics.mean(ratios):.4f}, {len(ratios)} boards")
    if not asked.no_large:
        report(random_board(LARGE, SEEDS[0]), with_lkh=False)


def report(board: Board, *, with_lkh: bool) -> float:
    """Print one board's line. Returns the cost over LKH's, nan without it."""
    name, points = board
    travel = ramp_travel(int(np.ptp(np.vstack([points, START]), axis=0).max()))
    runs = next(runs for most, runs in RUNS.items() if len(points) <= most)
    optimised, optimised_s = timed(lambda: plan(points, travel, "optimised", START), runs)
    nearest, nearest_s = timed(lambda: plan(points, travel, "nearest", START), runs)
    lkh, lkh_s = timed(lambda: lkh_order(points, travel), 1) if with_lkh else (None, float("nan"))
    cost = path_ticks(points, optimised, travel, START)
    to_nearest = cost / path_ticks(points, nearest, travel, START)
    to_lkh = cost / path_ticks(points, lkh, travel, START) if lkh is not None else float("nan")
    figures = (to_lkh, to_nearest, optimised_s, nearest_s, lkh_s, os.getloadavg()[0])
    print(LINE.format(name, len(points), *(f"{figure:.4f}"[:6] for figure in figures)), flush=True)
    return to_lkh


def timed(work: Callable[[], NDArray[np.int64]], runs: int) -> tuple[NDArray[np.int64], float]:
    """The order, and the median CPU seconds of making it. It must be the same order every time."""
    orders, seconds = [], []
    for _ in range(runs):
        began = time.process_time()
        orders.append(work())
        seconds.append(time.process_time() - began)
    if any((order != orders[0]).any() for order in orders):
        raise SystemExit("the same holes gave two different orders")
    return orders[0], statistics.median(seconds)


def ramp_travel(reach_steps: int) -> TravelCost:
    ticks = np.array([*SHORT_TICKS, *range(len(SHORT_TICKS) + 21, reach_steps + 22)])
    return TravelCost(ticks, ticks)


def random_board(count: int, seed: int) -> Board:
    size_steps = np.round(np.array(BOARD_MM) * STEPS_PER_MM).astype(np.int64)
    return f"random, seed {seed}", np.random.default_rng(seed).integers(0, size_steps, (count, 2))


def real_boards() -> Iterator[Board]:
    """The most used tool of every real file that can be read and has a fitting number of holes."""
    if not REAL_BOARDS.is_dir():
        print(f"no {REAL_BOARDS.name} boards: the folder of real drill files is not there")
        return
    for path in sorted(REAL_BOARDS.iterdir()):
        try:
            board = read(path)
        except DrillFileError:
            continue  # not a drill file, or one that cannot be read: the reader's tests see to that
        tool, count = largest_tool(board.hole_tool)
        if REAL_HOLES[0] <= count <= REAL_HOLES[1]:
            steps = np.round(board.hole_xy_mm[board.hole_tool == tool] * STEPS_PER_MM)
            yield path.name, steps.astype(np.int64) - steps.astype(np.int64).min(axis=0)


def largest_tool(hole_tool: NDArray[np.int64]) -> tuple[int, int]:
    counts = np.bincount(hole_tool, minlength=1)
    return int(counts.argmax()), int(counts.max())


def lkh_order(points: NDArray[np.int64], travel: TravelCost) -> NDArray[np.int64]:
    """LKH's order for the same open path: city 0 is a free end, joined to city 1, the start, by force."""
    import elkai  # type: ignore[import-untyped]  # the package has no type hints

    stops = np.vstack([START, points])
    between = travel.between(stops[:, None], stops[None])
    loop = np.zeros((len(stops) + 1,) * 2, np.int64)
    loop[1:, 1:] = between
    loop[1, 2:] += between.max()  # leaving the start by two such ways costs more than by one and the free end
    loop[2:, 1] += between.max()
    np.fill_diagonal(loop, 0)
    tour = np.array(elkai.DistanceMatrix(loop.tolist()).solve_tsp(1)[:-1])
    tour = np.roll(tour, -int(np.flatnonzero(tour == 0)[0]))
    if tour[1] != 1:
        tour = np.roll(tour[::-1], 1)
    return tour[2:] - 2


if __name__ == "__main__":
    main()
