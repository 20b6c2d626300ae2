"""Always to the nearest hole that is left; of equally near ones to the one that stands first in the file.

Rule: exact. A list of near holes answers most times; once all of those are done, every hole left is tried.
Called by `plan`, and by it as the starting point of `optimise`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.order.neighbours import find_neighbours
from drillctl.generation.order.travel import Steps, TravelCost

LIST_LENGTH = 8


def nearest_order(points: Steps, travel: TravelCost) -> NDArray[np.int64]:
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
    return np.array(order)


def _search_all(here: int, left: NDArray[np.bool_], points: Steps, travel: TravelCost) -> int:
    remaining = np.flatnonzero(left)
    return int(remaining[travel.between(points[here], points[remaining]).argmin()])
