"""Where a path goes: the place where the first tool stands, then the holes of one tool after the other.

Rule: a path through the stops visits the tools in their order, and each tool's holes in any order. The modules of
this package that look for paths work on these.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.generation.order.travel import Steps, TravelCost, as_steps

Tour = NDArray[np.int64]  # rows of the stops, row 0 first


@dataclass(frozen=True, eq=False)
class Stops:
    """`points` (n + 1, 2) in steps: row 0 is the start, the holes follow tool by tool.

    bounds  (k + 1,) rows: tool t has the rows bounds[t] to bounds[t + 1] - 1, perhaps none
    end     where the machine goes after the last hole, in steps; None for anywhere
    """

    points: Steps
    bounds: tuple[int, ...]
    end: Steps | None = None

    @classmethod
    def of(cls, groups: Sequence[ArrayLike], start: ArrayLike, end: ArrayLike | None = None) -> Stops:
        """The stops of groups of holes, (n, 2) each. Raises OrderError for anything but pairs of whole steps."""
        holes = [as_steps(group) for group in groups]
        points = np.vstack([_one(start), *holes])
        bounds = np.cumsum([1, *map(len, holes)])
        return cls(points, tuple(bounds.tolist()), None if end is None else _one(end)[0])

    @property
    def tools(self) -> list[range]:
        """The rows of each tool that has holes."""
        return [range(first, stop) for first, stop in pairwise(self.bounds) if stop > first]

    def check_reach(self, travel: TravelCost) -> None:
        """Raise OrderError unless the tables hold every move between two of the stops."""
        travel.check_reach(self.points if self.end is None else np.vstack([self.points, self.end]))

    def length_ticks(self, path: Tour, travel: TravelCost) -> int:
        """Travel ticks of a path, with the way to the end where there is one."""
        places = self.points[path] if self.end is None else np.vstack([self.points[path], self.end])
        return int(travel.between(places[:-1], places[1:]).sum())

    def orders(self, path: Tour) -> list[NDArray[np.int64]]:
        """The path as an order for each tool: numbers of its holes, from 0."""
        return [path[first:stop] - first for first, stop in pairwise(self.bounds)]


def _one(place: ArrayLike) -> Steps:
    return as_steps(np.reshape(place, (1, 2)))
