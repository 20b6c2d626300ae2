"""Commands that were foreseen: how long each takes, what is seen meanwhile, what every axis puts out.

Rule: a batch says and changes nothing; engine.py makes it and leaves the machine at its end. Ticks count from its
beginning. What costs more than the foreseeing (``tapes``) is made only where somebody asks.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.controller import Controller
from drillctl.execution.fastforward.axis_batch import AxisBatch
from drillctl.execution.fastforward.input_changes import Changes, IndexWatch, together
from drillctl.execution.fastforward.strokes import COUNTERS, POSITION, REMEMBERED, Place, Stroke
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.trace.tapes import PERIOD, Count, ImagePool, Tape

Touch = tuple[int, int, tuple[float, ...], int]  # tool, tag of the hole begun, places of all axes in steps, the head


@dataclass(frozen=True, eq=False)
class Stroked:
    """The strokes of a batch: in the commands ``rows`` (k,) the kind ``which`` (k,), from the place ``begin`` on. They
    change the input bits in ``mask``.
    """

    heads: tuple[int, ...]
    mask: int
    begin: Place
    rows: NDArray[np.intp]
    which: NDArray[np.intp]
    kinds: tuple[Stroke, ...]

    @classmethod
    def of(cls, heads: tuple[int, ...], mask: int, begin: Place, rows: NDArray[np.intp],
           strokes: Sequence[Stroke]) -> "Stroked":  # fmt: skip
        """From what is carried out in these rows."""
        numbers = {stroke: number for number, stroke in enumerate(dict.fromkeys(strokes))}
        which = np.fromiter(map(numbers.__getitem__, strokes), np.intp, len(strokes))
        return cls(heads, mask, begin, rows, which, tuple(numbers))

    def of_kinds(self, values: Sequence[int]) -> Count:
        """A value for each kind as one for each stroke, (k,)."""
        return np.array(values, np.int64)[self.which]

    def tape(self, pool: ImagePool, number: int, ticks: Count) -> Tape:
        """What a head puts out, by its number: between strokes it rests where the last one left it."""
        rests = [pool.steady(place.rests[number]) for place in (self.begin, *(kind.after for kind in self.kinds))]
        strokes_before = np.cumsum(np.bincount(self.rows, minlength=len(ticks))) if len(self.rows) else 0 * ticks
        start, length = np.zeros((2, len(ticks), 2), np.int64)  # the stroke, and the rest of its command
        start[:, 1] = np.array(rests)[np.concatenate(([0], self.which + 1))][strokes_before]
        period = np.full_like(start, PERIOD)
        start[self.rows, 0] = self.of_kinds([kind.strip(pool, number) for kind in self.kinds])
        length[self.rows, 0] = self.of_kinds([kind.ticks for kind in self.kinds])
        period[self.rows, 0] = np.maximum(length[self.rows, 0], PERIOD + 1)
        length[:, 1] = ticks - length[:, 0]
        return Tape.of(start.ravel(), length.ravel(), period.ravel())

    def motion(self, number: int, starts: Count) -> Count:
        """What a head does, by its number, as AxisBatch.motion has it."""
        parts = [np.array([[-1, *self.begin.motion(number)]], np.int64).T]
        for which, kind in enumerate(self.kinds):
            begins = starts[self.rows[self.which == which]]
            once = kind.motions[number].T
            ticks = (begins[:, None] + once[0]).ravel()
            parts.append(np.stack((ticks, *np.tile(once[1:], len(begins)))))
        motion = np.concatenate(parts, axis=1)
        return motion[:, np.argsort(motion[0], kind="stable")]

    def inputs(self, starts: Count, before: int) -> Changes:
        """How the heads' sensors change, from what is latched ``before``; nothing where no head strokes."""
        parts = [np.array([[0], [before & self.mask]], np.int64)]
        for number, kind in enumerate(self.kinds):
            begins = starts[self.rows[self.which == number]]
            offsets, seen = np.array(kind.inputs, np.int64).T
            parts.append(np.stack(((begins[:, None] + offsets).ravel(), np.tile(seen, len(begins)))))
        ticks, seen = np.concatenate(parts, axis=1)
        order = np.argsort(ticks, kind="stable")
        return ticks[order], seen[order]

    def leave(self, m: Controller, world: PlantFacts, last_row: int, ticks: int) -> None:
        """The heads as they stand after the command ``last_row``, which took so many ticks."""
        place = self.kinds[self.which[-1]].after if len(self.rows) else self.begin
        times = np.bincount(self.which, minlength=len(self.kinds)).tolist()
        for number, head in enumerate(self.heads):
            axis = m.axes[head]
            for slot, value in zip(REMEMBERED, place.axes[number], strict=True):
                setattr(axis, slot, value)
            turned_at = [each.motion(number)[POSITION] for each in (self.begin, *(kind.after for kind in self.kinds))]
            axis.was_at(min(turned_at), max(turned_at))
            for counter, name in enumerate(COUNTERS):
                grown = sum(n * kind.grown[number][counter] for n, kind in zip(times, self.kinds, strict=True))
                setattr(axis, name, getattr(axis, name) + grown)
            if len(self.rows) and self.rows[-1] == last_row and self.kinds[self.which[-1]].ticks == ticks:
                axis.motion, axis.bits = self.kinds[self.which[-1]].last[number]
            world.recall(head, place.memories[number])


@dataclass(frozen=True, eq=False)
class Batch:
    """n commands, at least one.

    commands  dtype kmd.RECORD (n,); ``ticks`` int64 (n,) of each
    axis_batches  by axis; None where the axis is a head and ``stroked`` says what it does
    switched  (n,) output bits that are no axis's, during each command
    tools     (n,) the tool in hand, ``holes`` (n,) the hole begun, in each command
    inputs_before  the input image that the first tick latches; ``still_inputs`` the part that nothing changes
    indexes   the encoders whose index may change, of axes that are not ``stroked``
    """

    commands: NDArray[np.void]
    ticks: Count
    axis_batches: Sequence[AxisBatch | None]
    stroked: Stroked
    switched: NDArray[np.uint64]
    tools: Count
    holes: Count
    inputs_before: int
    still_inputs: int
    indexes: Sequence[IndexWatch]

    @cached_property
    def starts(self) -> Count:
        """The first tick of each command, and behind them the end: (n+1,)."""
        return np.concatenate(([0], np.cumsum(self.ticks)))

    @property
    def end(self) -> int:
        """How many ticks it takes."""
        return int(self.starts[-1])

    def inputs(self) -> tuple[Count, Count]:
        """Ticks and input images where the inputs may change, tick 0 first."""
        sources = [self.stroked.inputs(self.starts, self.inputs_before)]
        sources += [index.changes(self.starts) for index in self.indexes]
        return together(self.end, self.still_inputs, sources)

    def last_inputs(self) -> int:
        """The input image that the last tick latches."""
        _, seen = together(self.end, self.still_inputs, [self.stroked.inputs(self.starts, self.inputs_before)])
        return int(seen[-1]) | sum(index.latched_last(int(self.ticks[-1])) for index in self.indexes)

    @cached_property
    def touches(self) -> list[Touch]:
        """Where a bit met its board, in order."""
        found: list[tuple[int, Touch]] = []
        for number, kind in enumerate(self.stroked.kinds):
            rows = self.stroked.rows[self.stroked.which == number]
            for offset, met, head_places in kind.touches:
                begins, tools, holes = (each[rows].tolist() for each in (self.starts, self.tools, self.holes))
                places = [j.position[rows].astype(float) if j is not None else None for j in self.axis_batches]
                for head, place in zip(self.stroked.heads, head_places, strict=True):
                    places[head] = np.full(len(rows), place)
                by_row = zip(*(each.tolist() for each in places if each is not None), strict=True)
                touched = zip(begins, tools, holes, by_row, strict=True)
                found += [(begin + offset, (tool, hole, where, met)) for begin, tool, hole, where in touched]
        found.sort(key=lambda touch: touch[0])
        return [touch for _, touch in found]

    def motion(self, index: int) -> Count:
        """Tick, column (from 0), position and state of an axis in tick 0 and wherever they may change, (4, k)."""
        axis_batch = self.axis_batches[index]
        if axis_batch is None:
            motion = self.stroked.motion(self.stroked.heads.index(index), self.starts)
        else:
            motion = axis_batch.motion(self.starts)
        motion[0, 0] = 0
        at_once = motion.shape[1] > 1 and motion[0, 1] == 0
        return motion[:, 1:] if at_once else motion

    def tapes(self, pool: ImagePool) -> list[Tape]:
        """What each axis puts out, then the switched outputs: tapes from this pool, all as long as the batch."""
        tapes = [
            self.stroked.tape(pool, self.stroked.heads.index(index), self.ticks)
            if axis_batch is None else Tape.of(*map(np.ravel, axis_batch.slices(pool, self.ticks)))
            for index, axis_batch in enumerate(self.axis_batches)
        ]  # fmt: skip
        switched = np.array([pool.steady(image) for image in self.switched.tolist()])
        return [*tapes, Tape.of(switched, self.ticks, np.full(len(switched), PERIOD))]
