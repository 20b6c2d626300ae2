"""Every hole's nearest others by travel ticks, exactly, without looking at all pairs.

Rule: sorted by ticks, then by number, and complete: no hole outside a list comes before one inside it.
The holes are cut into small boxes (halved again and again across the longer side, as a k-d tree does:
Bentley 1975, here the leaves alone are kept); far boxes are left out once they cannot hold a nearer hole.
`nearest` and `optimise` use the lists.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.order.travel import Steps, Ticks, TravelCost

Near = tuple[int, int]  # a hole, and the ticks to it
LEAF_SIZE = 32
NEVER = np.iinfo(np.int64).max  # ticks of a hole to itself: it is no neighbour of its own


@dataclass(frozen=True)
class Neighbours:
    """`index` (n, k) int64: the k nearest others of each hole; `ticks` (n, k): what the way to them costs."""

    index: NDArray[np.int64]
    ticks: Ticks

    def pairs(self, first: int = 0) -> list[list[Near]]:
        """The lists as plain numbers, for single looks; holes are counted from `first`."""
        rows = zip((self.index + first).tolist(), self.ticks.tolist(), strict=True)
        return [list(zip(holes, ticks, strict=True)) for holes, ticks in rows]


def find_neighbours(points: Steps, travel: TravelCost, count: int) -> Neighbours:
    """The `count` nearest others of each of `points` (n, 2), or all n - 1 where there are fewer."""
    count = min(count, len(points) - 1)
    index = np.empty((len(points), count), np.int64)
    ticks = np.empty((len(points), count), np.int64)
    leaves = _leaves(points)
    low = np.array([points[leaf].min(axis=0) for leaf in leaves])
    high = np.array([points[leaf].max(axis=0) for leaf in leaves])
    for number, leaf in enumerate(leaves):
        gap = np.maximum(np.maximum(low - high[number], low[number] - high), 0)
        index[leaf], ticks[leaf] = _search(leaf, leaves, travel.at_least(gap), points, travel, count)
    return Neighbours(index, ticks)


def _leaves(points: Steps) -> list[NDArray[np.int64]]:
    """Cut all holes into groups of at most LEAF_SIZE that lie close together."""
    waiting = [np.arange(len(points))]
    leaves = []
    while waiting:
        group = waiting.pop()
        if len(group) <= LEAF_SIZE:
            leaves.append(group)
            continue
        longer_side = int(np.ptp(points[group], axis=0).argmax())
        ordered = group[np.argsort(points[group, longer_side], kind="stable")]
        waiting += np.array_split(ordered, 2)
    return leaves


def _search(
    leaf: NDArray[np.int64],
    leaves: list[NDArray[np.int64]],
    least_ticks: Ticks,
    points: Steps,
    travel: TravelCost,
    count: int,
) -> tuple[NDArray[np.int64], Ticks]:
    """Neighbours of one leaf's holes. `least_ticks[i]`: no hole of leaf i can be nearer than that."""
    nearest_first = np.argsort(least_ticks, kind="stable")
    taken = min(len(leaves), 2 + 2 * count // LEAF_SIZE)
    while True:
        others = np.sort(np.concatenate([leaves[i] for i in nearest_first[:taken]]))
        cost = travel.between(points[leaf][:, None], points[others][None])
        cost[leaf[:, None] == others[None]] = NEVER
        best = np.argsort(cost, axis=1, kind="stable")[:, :count]
        ticks = np.take_along_axis(cost, best, axis=1)
        if taken == len(leaves) or ticks.max(initial=0) < least_ticks[nearest_first[taken]]:
            return others[best], ticks
        taken = min(len(leaves), 2 * taken)
