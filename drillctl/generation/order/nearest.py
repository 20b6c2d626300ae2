"""Always to the nearest hole of the tool that is left; of equally near ones to the one that stands first in the file.

Rule: exact. A list of near holes answers most times; once all of those are done, every hole left is tried.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.order.neighbours import find_neighbours
from drillctl.generation.order.stops import Stops, Tour
from drillctl.generation.order.travel import Steps, TravelCost
from drillctl.generation.waits import Advance, ignored

LIST_LENGTH = 8


def nearest_path(stops: Stops, travel: TravelCost, advance: Advance = ignored) -> Tour:
    """The path through `stops`, each tool beginning where the one before ended."""
    path = [0]
    for tool in stops.tools:
        rows = np.array([path[-1], *tool])
        path += rows[_order(stops.points[rows], travel)[1:]].tolist()
        advance(len(path), len(stops.points))
    return np.array(path)


def _order(points: Steps, travel: TravelCost) -> NDArray[np.int64]:
    """Order of `points` (n, 2): row 0 is where the tool stands and comes first, the rest follow."""
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
    return np.array(order)


def _search_all(here: int, left: NDArray[np.bool_], points: Steps, travel: TravelCost) -> int:
    remaining = np.flatnonzero(left)
    return int(remaining[travel.between(points[here], points[remaining]).argmin()])
