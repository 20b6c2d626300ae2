"""A short order: disturb a repaired path in one place, repair it again, keep it unless it got longer.

Rule: counted, not timed, and drawn from a fixed seed, so the same holes always give the same order; and
never longer than the order it began with. The method is iterated local search with the double-bridge
disturbance (Martin, Otto and Felten 1991), kept within a short stretch of the path so that its repair
looks at a few dozen holes, however large the board. Called by `plan`.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.order.improve import Improver
from drillctl.generation.order.neighbours import find_neighbours
from drillctl.generation.order.travel import Steps, TravelCost
from drillctl.generation.waits import Advance, ignored

NEIGHBOURS = 8
# Chosen with benchmarks/order_quality.py: on boards of 50 and 200 holes the way is 0.3 % and 0.7 % longer than LKH's on
# average, 1.2 % at the worst; four times the rounds gain 0.1 %.
ROUNDS_PER_HOLE = 5
MOST_ROUNDS = 4_000
MOST_ROUNDS_TIMES_HOLES = 40_000_000  # a round may turn pieces of any length: fewer rounds for huge boards
LONGEST_STRETCH = 16  # holes in each of the two stretches that change places
SEED = 1996

Draw = Callable[[], float]  # a number from 0 up to, not including, 1


def optimised_order(
    points: Steps, travel: TravelCost, order: NDArray[np.int64], advance: Advance = ignored
) -> NDArray[np.int64]:
    """Shorten `order`, a path through all of `points` (n, 2) in steps; row 0, the start, stays first.

    `advance` is called with how many of the rounds are done.
    """
    improver = Improver(points, travel, find_neighbours(points, travel, NEIGHBOURS), order.tolist())
    improver.settle(range(len(points)))
    holes = len(points) - 1
    if holes > 1:  # a single hole has nothing to change places with
        draw = random.Random(SEED).random  # the one method whose numbers no later Python may change
        rounds = rounds_of(holes)
        for done in range(rounds):
            _round(improver, holes, draw)
            advance(done + 1, rounds)
    return np.array(improver.path.order[:-1])


def rounds_of(holes: int) -> int:
    """How many disturbances are tried on a group of so many holes."""
    return min(ROUNDS_PER_HOLE * holes, MOST_ROUNDS, MOST_ROUNDS_TIMES_HOLES // holes)


def _round(improver: Improver, holes: int, draw: Draw) -> None:
    """Disturb, repair, and go back if that made the path longer; an equally long other path is kept."""
    improver.path.keep()
    lost, touched = _swap_stretches(improver, *_neighbouring_stretches(holes, draw))
    if improver.settle(touched) < lost:
        improver.path.undo()


def _neighbouring_stretches(holes: int, draw: Draw) -> tuple[int, int, int]:
    """Two stretches side by side, drawn at random: positions first..middle-1 and middle..end-1."""
    longest = min(LONGEST_STRETCH, holes // 2)
    one, two = 1 + int(draw() * longest), 1 + int(draw() * longest)
    first = 1 + int(draw() * (holes - one - two + 1))  # position 0 is the start and stays
    return first, first + one, first + one + two


def _swap_stretches(improver: Improver, first: int, middle: int, end: int) -> tuple[int, list[int]]:
    """Exchange them. Returns the ticks this costs and the six holes at the three cuts."""
    order, rows = improver.path.order, improver.rows
    before, one_first, one_last = order[first - 1], order[first], order[middle - 1]
    two_first, two_last, after = order[middle], order[end - 1], order[end]
    old = rows[before][one_first] + rows[one_last][two_first] + rows[two_last][after]
    new = rows[before][two_first] + rows[two_last][one_first] + rows[one_last][after]
    improver.path.swap(first, middle, end)
    return new - old, [before, one_first, one_last, two_first, two_last, after]
