"""How the input image changes in a batch: from several sources, each with input bits of its own.

Rule: what an axis puts out in a tick is seen by the latch of the next one.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from drillctl.execution.fastforward.axis_batch import AxisBatch, turns_of
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.trace.tapes import Count

Changes = tuple[Count, Count]  # ticks, rising, and what is latched from each of them on


@dataclass(frozen=True, eq=False)
class IndexWatch:
    """The index of one axis's encoder through a batch.

    levels  its input bit after columns, as PlantFacts.index_levels has it
    """

    axis_batch: AxisBatch
    levels: Callable[[int, Count, Count], Count]

    @classmethod
    def of(cls, world: PlantFacts, number: int, axis_batch: AxisBatch) -> "IndexWatch":
        """Of the axis ``number``, which has an index."""
        return cls(axis_batch, lambda travel, turns, column: world.index_levels(number, travel, turns, column))

    def changes(self, starts: Count) -> Changes:
        """From tick 0 on, the commands beginning at the ticks ``starts`` (n,)."""
        axis = self.axis_batch.axis
        return self._seen(self.axis_batch, starts, axis.travelled * axis.direction_sign)

    def latched_last(self, ticks: int) -> int:
        """Returns the bit as the last tick latches it; the last command takes so many ticks."""
        axis, last = self.axis_batch.axis, self.axis_batch.last()
        before = axis.travelled + self.axis_batch.travel() - last.travel()
        seen_at, seen = self._seen(last, np.zeros(1, np.int64), before * axis.direction_sign)
        return int(seen[np.searchsorted(seen_at, ticks - 1, side="right") - 1])

    def _seen(self, axis_batch: AxisBatch, starts: Count, travel: int) -> Changes:
        ticks, column, position, _ = axis_batch.motion(starts)
        turns = turns_of(axis_batch.axis, column, position, (int(column[0]), int(position[0])))
        seen = self.levels(travel, turns, column)
        changed = np.append(True, seen[1:] != seen[:-1])
        return ticks[changed] + 1, seen[changed]


def together(end: int, still: int, sources: Sequence[Changes]) -> Changes:
    """Returns the ticks before ``end`` in which the image of all sources may change, and the images; ``still`` are the
    bits that no source has.
    """
    ticks = np.sort(np.concatenate([np.zeros(1, np.int64), *(seen_at for seen_at, _ in sources)]))
    ticks = ticks[np.append(True, ticks[1:] != ticks[:-1]) & (ticks < end)]
    images = np.full(len(ticks), still, np.int64)
    for seen_at, seen in sources:
        images |= seen[np.searchsorted(seen_at, ticks, side="right") - 1]
    return ticks, images
