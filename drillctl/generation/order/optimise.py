"""A short path: disturb a repaired path in one place, repair it again, keep it unless it got too much longer.

Rule: counted, and drawn from a fixed seed, so the same holes always give the same path, unless a budget of seconds
cuts the search; and never longer than the path it began with: the best path that was met counts. The method is iterated
local search with the double-bridge disturbance (Martin, Otto and Felten 1991), kept within a short stretch of one
tool's holes so that its repair looks at a few dozen holes, however large the board. A path may get a little longer at
first, and less and less towards the end (their "large-step Markov chain").
"""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from drillctl.generation.order.budget import Budget
from drillctl.generation.order.improve import Improver
from drillctl.generation.order.neighbours import Near, find_neighbours
from drillctl.generation.order.stops import Stops, Tour
from drillctl.generation.order.travel import TravelCost
from drillctl.generation.waits import Advance, ignored

NEIGHBOURS = 8
# Chosen with benchmarks/order_quality.py, for LKH's ways and for time: HEAT 0, stretches of 16 and pieces of 3 holes
# (improve.py) gave ways that were 1.2 % longer at the worst, in much the same time.
ROUNDS_PER_HOLE = 4
MOST_ROUNDS = 3_000
MOST_ROUNDS_TIMES_HOLES = 40_000_000  # a round may turn pieces of any length: fewer rounds for huge boards
LONGEST_STRETCH = 32  # holes in each of the two stretches that change places
HEAT = 0.4  # of the way from hole to hole: by so much, at the most, a round may make the path longer at first
SEED = 1996

Draw = Callable[[], float]  # a number from 0 up to, not including, 1


def optimised_path(stops: Stops, travel: TravelCost, path: Tour, budget: Budget, advance: Advance = ignored) -> Tour:
    """Shorten `path`, which goes through all stops tool by tool, as far as `budget` allows.

    `advance` is called with how many of the rounds are done.
    """
    improver = Improver(stops, travel, near_in_tool(stops, travel), path.tolist())
    improver.settle(range(len(path)), budget)
    draw = random.Random(SEED).random  # the one method whose numbers no later Python may change
    rounds = [each for tool in stops.tools for each in _rounds(improver, tool)]
    order, longer, least = improver.path.order, 0, 0
    best = list(order)
    for done, (tool, heat_ticks) in enumerate(rounds, 1):
        if not budget.allows():
            break
        longer += _disturb(improver, tool, draw, heat_ticks)
        if longer < least:
            least, best = longer, list(order)
        advance(done, len(rounds))
    return np.array(best[:-1])


def near_in_tool(stops: Stops, travel: TravelCost) -> list[list[Near]]:
    """Returns for each stop the nearest others of its own tool; the start belongs to the first tool."""
    near: list[list[Near]] = []
    for tool in stops.tools:
        first = len(near)
        near += find_neighbours(stops.points[first : tool.stop], travel, NEIGHBOURS).pairs(first)
    return near


def rounds_of(holes: int) -> int:
    """How many disturbances are tried on a tool of so many holes; a single hole has nothing to change places with."""
    return min(ROUNDS_PER_HOLE * holes, MOST_ROUNDS, MOST_ROUNDS_TIMES_HOLES // holes) if holes > 1 else 0


def _rounds(improver: Improver, tool: range) -> list[tuple[range, float]]:
    """The rounds of a tool, each with the ticks by which it may make the path longer: evenly fewer."""
    count, order, rows = rounds_of(len(tool)), improver.path.order, improver.rows
    way_ticks = sum(rows[one][other] for one, other in pairwise(order[tool.start : tool.stop])) / len(tool)
    return [(tool, HEAT * way_ticks * (1 - number / count)) for number in range(count)]


def _disturb(improver: Improver, tool: range, draw: Draw, heat_ticks: float) -> int:
    """Disturb, repair, and go back if that made the path longer than chance allows; an equally long other path is kept.
    Ticks by which the path got longer.
    """
    improver.path.keep()
    lost, touched = _swap_stretches(improver, *_neighbouring_stretches(tool, draw))
    longer = lost - improver.settle(touched)
    if longer > 0 and longer > heat_ticks * draw():
        improver.path.undo()
        return 0
    return longer


def _neighbouring_stretches(tool: range, draw: Draw) -> tuple[int, int, int]:
    """Two stretches side by side, drawn at random: positions first..middle-1 and middle..end-1 among a tool's."""
    holes = len(tool)
    longest = min(LONGEST_STRETCH, holes // 2)
    one, two = 1 + int(draw() * longest), 1 + int(draw() * longest)
    first = tool.start + int(draw() * (holes - one - two + 1))
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
