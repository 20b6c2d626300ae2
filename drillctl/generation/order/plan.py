"""The front door of the package: in which order holes are drilled, for one tool or for one tool after the other.

Rule: the holes stay with their tools, and the tools in the order given. `optimised` is never longer than the other
orders.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.generation.order.budget import Budget
from drillctl.generation.order.nearest import nearest_path
from drillctl.generation.order.optimise import optimised_path
from drillctl.generation.order.stops import Stops, Tour
from drillctl.generation.order.travel import OrderError, TravelCost
from drillctl.generation.waits import Advance, ignored
from drillctl.viewmodel.choices import ORDERS

Orders = list[NDArray[np.int64]]  # of each tool: row numbers of its holes
Cost = Callable[[Orders], int]


def plan(
    points: ArrayLike, travel: TravelCost, how: str, start: ArrayLike, advance: Advance = ignored
) -> NDArray[np.int64]:
    """The order in which to drill `points` (n, 2) in steps, beginning from `start` (2,): row numbers, (n,).

    `how` is one of ORDERS; `advance` is called with how far the work is. Raises OrderError for any other, and for
    holes the travel tables don't reach.
    """
    return plan_groups([points], travel, how, start, advance=advance)[0]


def plan_groups(
    groups: Sequence[ArrayLike],
    travel: TravelCost,
    how: str,
    start: ArrayLike,
    end: ArrayLike | None = None,
    *,
    cost: Cost | None = None,
    budget: Budget | None = None,
    advance: Advance = ignored,
) -> Orders:
    """The orders of one tool after the other; a tool's holes are one group, perhaps empty.

    end     where the machine goes after the last hole; None: the way there is not counted
    cost    what orders take, for whom this is more than the way: `optimised` is then the best of all by this cost
    budget  how long `optimised` may improve its order; without one it works to its end
    """
    if how not in ORDERS:
        raise OrderError(f"order {how!r} is not known; give {', '.join(ORDERS)}")
    stops = Stops.of(groups, start, end)
    stops.check_reach(travel)
    if how == "optimised" and stops.tools:
        return _best(stops, travel, cost, budget or Budget(), advance)
    path = _file_path(stops) if how == "file" else nearest_path(stops, travel, advance)
    return stops.orders(path)


def _best(stops: Stops, travel: TravelCost, cost: Cost | None, budget: Budget, advance: Advance) -> Orders:
    """Begin with the shorter of the two cheap paths, since repairs only ever shorten; and take the best of all."""
    cheap = sorted((_file_path(stops), nearest_path(stops, travel)), key=lambda path: stops.length_ticks(path, travel))
    found = [optimised_path(stops, travel, cheap[0], budget, advance), *cheap]
    orders = [stops.orders(path) for path in found]
    return orders[0] if cost is None else min(orders, key=cost)


def path_ticks(points: ArrayLike, order: ArrayLike, travel: TravelCost, start: ArrayLike) -> int:
    """Travel ticks from `start` through all of `points` in this order."""
    stops = Stops.of([points], start)
    return stops.length_ticks(np.concatenate([[0], 1 + np.asarray(order, np.int64)]), travel)


def _file_path(stops: Stops) -> Tour:
    return np.arange(len(stops.points))
