"""Always to the nearest hole that is left; of equally near ones to the one that stands first in the file.

Rule: exact. A list of near holes answers most times; once all of those are done, every hole left is tried.
Called by `plan`, and by it as the starting point of `optimise`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.generation.order.neighbours import find_neighbours
from drillctl.generation.order.optimise import optimised_order, rounds_of
from drillctl.generation.order.travel import OrderError, Steps, TravelCost, as_steps
from drillctl.generation.waits import Advance, ignored

LIST_LENGTH = 8


def nearest_order(points: Steps, travel: TravelCost, advance: Advance = ignored) -> NDArray[np.int64]:
    """Order of `points` (n, 2) in steps: row 0 is where the tool stands and comes first, the rest follow."""
    near = find_neighbours(points, travel, LIST_LENGTH).index.tolist()
    left = np.ones(len(points), bool)
    left[0] = False
    order = [0]
    while len(order) < len(points):
        here = order[-1]
        listed = next((there for there in near[here] if left[there]), None)
        there = _search_all(here, left, points, travel) if listed is None else listed
        left[there] = False
        order.append(there)
        advance(len(order), len(points))
    return np.array(order)


def _search_all(here: int, left: NDArray[np.bool_], points: Steps, travel: TravelCost) -> int:
    remaining = np.flatnonzero(left)
    return int(remaining[travel.between(points[here], points[remaining]).argmin()])


def plan(
    points: ArrayLike, travel: TravelCost, how: str, start: ArrayLike, advance: Advance = ignored
) -> NDArray[np.int64]:
    """The order in which to drill `points` (n, 2) in steps, beginning from `start` (2,): row numbers, (n,).

    `how` is a key of HOWS; `advance` is called with how far the work is. Raises OrderError for any other, and for
    holes the travel tables don't reach.
    """
    if how not in HOWS:
        raise OrderError(f"order {how!r} is not known; give {', '.join(HOWS)}")
    holes = as_steps(points)
    if not len(holes):
        return np.zeros(0, np.int64)
    stops = _stops(holes, start)
    travel.check_reach(stops)
    order = HOWS[how](stops, travel, advance)[1:] - 1
    advance(1, 1)  # a single hole has no rounds to tell of
    return order


def plan_groups(
    groups: Sequence[ArrayLike], travel: TravelCost, how: str, start: ArrayLike, advance: Advance = ignored
) -> list[NDArray[np.int64]]:
    """`plan` for one tool after the other, each beginning where the one before ended; one order a group."""
    weights = [_weight(len(points)) for points in map(as_steps, groups)]
    orders = []
    here = np.asarray(start)
    for number, points in enumerate(groups):
        order = plan(points, travel, how, here, _share(advance, weights, number))
        orders.append(order)
        if len(order):
            here = as_steps(points)[order[-1]]
    return orders


def _weight(holes: int) -> int:
    """About how long a tool's holes take to be put in order, beside another's."""
    return rounds_of(holes) if holes else 0


def _share(advance: Advance, weights: Sequence[int], number: int) -> Advance:
    """An Advance for group ``number``, which counts as its share of the whole."""
    before, whole = sum(weights[:number]), max(sum(weights), 1)

    def part(done: int, total: int) -> None:
        advance(before + weights[number] * done // total, whole)

    return part


def path_ticks(points: ArrayLike, order: ArrayLike, travel: TravelCost, start: ArrayLike) -> int:
    """Travel ticks from `start` through all of `points` in this order."""
    stops = _stops(as_steps(points)[np.asarray(order, np.int64)], start)
    return _length_ticks(stops, travel)


def _stops(holes: Steps, start: ArrayLike) -> Steps:
    """The start as row 0, then the holes."""
    return np.vstack([as_steps(np.reshape(start, (1, 2))), holes])


def _length_ticks(stops: Steps, travel: TravelCost) -> int:
    return int(travel.between(stops[:-1], stops[1:]).sum())


def _file_order(stops: Steps, travel: TravelCost, advance: Advance) -> NDArray[np.int64]:
    return np.arange(len(stops))


def _optimised(stops: Steps, travel: TravelCost, advance: Advance) -> NDArray[np.int64]:
    """Begin with the shorter of the two cheap orders, since repairs only ever shorten."""
    cheap = [_file_order(stops, travel, ignored), nearest_order(stops, travel)]
    lengths = [_length_ticks(stops[order], travel) for order in cheap]
    return optimised_order(stops, travel, cheap[int(np.argmin(lengths))], advance)


HOWS: dict[str, Callable[[Steps, TravelCost, Advance], NDArray[np.int64]]] = {
    "file": _file_order,
    "nearest": nearest_order,
    "optimised": _optimised,
}
