"""Strokes of the heads: what ends on a sensor is run by tick once from each place it begins at, and then known.

Rule: on a plant that always answers alike, the same command from the same place is the same stroke, tick by tick. The
place is all that a head's automaton, its rotor and its sensors remember, and where the boards were found. The ticks of
an unknown stroke are noted by a Recording, which engine.py hands out; plan.py goes from place to place by what is
``known``.
"""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.fastforward.quiet import Quiet
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.execution.motion import COOLED
from drillctl.trace.tapes import Count, ImagePool, Images

COUNTERS = ("made", "travelled")  # they only grow: a place is the same whatever they are
MOTION = ("column", "position", "state")
POSITION = MOTION.index("position")
TABLES = (
    "ramp", "strokes", "interval", "drive_patterns", "hold_patterns", "limits", "followers", "reach", "forcing",
    "halves",
)  # fmt: skip
BEEN = ("least", "most")  # strokes are foreseen from known places alone, where nothing depends on these
SOUGHT = ("seek_mask",)  # a command that ends well seeks no sensor any more
REMEMBERED = tuple(slot for slot in Axis.__slots__ if slot not in (*COUNTERS, *TABLES, *BEEN))


@dataclass(frozen=True, eq=False)
class Stroke:
    """What a stroke of so many ``ticks`` does.

    shown    by head, the images that it puts out, and the ticks of each, (k,)
    inputs   (tick, the heads' sensors as latched), changes only, from tick 0 to the first tick after the stroke
    touches  (tick, axis of the head, place of each head in steps) where a bit met its board
    motions  by head: tick and MOTION, changes only, (k, 4)
    grown    by head, what it adds to the COUNTERS
    last     by head, its AxisMotion in the last tick, in which its forcing may still be on, and its bits then
    begins   by head, MOTION before it
    after    the place it ends at
    """

    ticks: int
    shown: tuple[tuple[Images, Count], ...]
    inputs: tuple[tuple[int, int], ...]
    touches: tuple[tuple[int, int, tuple[float, ...]], ...]
    motions: tuple[Count, ...]
    grown: tuple[tuple[int, ...], ...]
    last: tuple[tuple[int, int], ...]
    begins: tuple[tuple[int, ...], ...]
    after: "Place"
    strips: dict[int, int] = field(default_factory=dict)

    def clear_after(self, clear: int | None) -> int:
        """Returns the ticks of the stroke up to that in which the last of the heads has come up to ``clear`` steps, or,
        where that is None, has come to rest; 0 where all were there already.
        """
        ends = []
        for motion, (_, position, _) in zip(self.motions, self.begins, strict=True):
            there = motion if clear is None else motion[motion[:, 1 + POSITION] <= clear][:1]
            ends.append(int(there[-1, 0]) + 1 if len(there) and (clear is None or position > clear) else 0)
        return max(ends, default=0)

    def strip(self, pool: ImagePool, number: int) -> int:
        """Returns where the images of a head, by its number, lie in the pool; they are put there when first asked for,
        since a run that keeps no record needs none.
        """
        if number not in self.strips:
            self.strips[number] = pool.add(np.repeat(*self.shown[number]))
        return self.strips[number]


@dataclass(eq=False)
class Place:
    """Where heads may stand, with what is known of the strokes that begin there (by the command's bytes)."""

    axes: tuple[tuple[Any, ...], ...]
    memories: tuple[tuple[Any, ...], ...]
    known: dict[bytes, Stroke] = field(default_factory=dict)

    @property
    def rests(self) -> tuple[int, ...]:
        """By head, the image that it holds here."""
        return tuple(state[REMEMBERED.index("hold_bits")] for state in self.axes)

    def motion(self, number: int) -> tuple[int, ...]:
        """Returns the values of the slots MOTION of a head, by its number, at the start of the stroke."""
        return tuple(self.axes[number][REMEMBERED.index(slot)] for slot in MOTION)


class Strokes:
    """All strokes and places of one machine's heads."""

    def __init__(self, m: Controller, world: PlantFacts):
        self._m, self._world = m, world
        self.heads = m.machine.drill_axes
        switches = {1 << sensor.bit for sensor in m.machine.sensors if sensor.axis in self.heads}
        self.mask = sum(switches | {line[head] for head in self.heads for line in (m.indexes, m.contacts)})
        self._places: dict[Hashable, Place] = {}

    def here(self, left: Sequence[str] = ()) -> Place:
        """The place where the heads stand, their forcing off; the slots ``left`` are 0 by the end of the command."""
        axes = [self._m.axes[head] for head in self.heads]
        states = tuple(tuple(0 if slot in left else _cooled(axis, slot) for slot in REMEMBERED) for axis in axes)
        memories = tuple(self._world.memory(head) for head in self.heads)
        key = states, memories, self._m.position_known, tuple(self._m.surfaces.items())
        return self._places.setdefault(key, Place(states, memories))


def _cooled(axis: Axis, slot: str) -> Any:
    """A slot's value once the forcing has gone off."""
    if slot == "motion":
        return COOLED[axis.motion]
    return axis.hold_bits if slot == "bits" else getattr(axis, slot)


def _joined(parts: Sequence[ArrayLike], dtype: type[np.generic]) -> NDArray[Any]:
    """Returns one array of several, one after the other."""
    return np.concatenate([np.asarray(part, dtype) for part in parts])


class Recording:
    """One stroke while it is run by tick: ``note`` after each tick, ``end`` after the last."""

    def __init__(self, m: Controller, world: PlantFacts, strokes: Strokes, signature: bytes):
        self._m, self._world, self._strokes, self._signature = m, world, strokes, signature
        self._axes = [m.axes[head] for head in strokes.heads]
        self._start = strokes.here()
        self._counters = self._count()
        self._ticks = 0
        self._shown: list[list[tuple[ArrayLike, ArrayLike]]] = [[] for _ in self._axes]  # by head: images, their ticks
        self._inputs: list[tuple[int, int]] = []
        self._touches: list[tuple[int, int, tuple[float, ...]]] = []
        self._motions: list[list[ArrayLike]] = [[] for _ in self._axes]
        self._begins = tuple(self._start.motion(number) for number in range(len(self._axes)))
        self._at = list(self._begins)
        self._made: Stroke | None = None

    def note(self, met: Sequence[int], places: tuple[float, ...], ticks: int = 1) -> None:
        """After a tick, or several alike: the axes whose bits have ``met`` their boards in it, and then the places of
        all axes.
        """
        if self._made is not None:
            return
        tick = self._ticks
        self._ticks += ticks
        self._see(tick, self._m.inputs)
        for number, axis in enumerate(self._axes):
            self._shown[number].append(([axis.bits], [ticks]))
            at = axis.column, axis.position, axis.state
            if at != self._at[number]:
                self._at[number] = at
                self._motions[number].append([(tick, *at)])
        for axis_met in met:
            self._touches.append((tick, axis_met, tuple(places[head] for head in self._strokes.heads)))
        self._look()

    def note_quiet(self, quiet: Quiet) -> None:
        """Notes a stretch that was foreseen (quiet.py): what each axis put out, and where its columns changed."""
        if self._made is not None:
            return
        first, ticks = self._ticks, quiet.ticks
        self._see(first, self._m.inputs)
        self._ticks += ticks
        for number, head in enumerate(self._strokes.heads):
            bits, motion = quiet.bits[head], quiet.motion[head]
            self._shown[number].append(bits or ([self._axes[number].bits], [ticks]))
            if motion is not None and motion.size:
                rows = np.concatenate(([(0, *self._at[number])], motion.T + np.array((first, 0, 0, 0))))
                self._motions[number].append(rows[1:][(rows[1:, 1:] != rows[:-1, 1:]).any(axis=1)])
                self._at[number] = tuple(rows[-1, 1:].tolist())
        self._look()

    def end(self) -> None:
        """The command ended well: from now on the stroke is known."""
        if self._made is not None:
            self._start.known[self._signature] = self._made

    def _look(self) -> None:
        """Once all heads rest the stroke is over, though other axes may go on."""
        if not any(axis.counting for axis in self._axes):
            self._made = self._stroke()

    def _stroke(self) -> Stroke:
        ticks = self._ticks
        self._see(ticks, self._world.inputs)
        grown = [
            tuple(after - before for after, before in zip(now, then, strict=True))
            for now, then in zip(self._count(), self._counters, strict=True)
        ]
        shown = tuple(
            (_joined([images for images, _ in parts], np.uint64), _joined([lasts for _, lasts in parts], np.int64))
            for parts in self._shown
        )
        none = np.zeros((0, 1 + len(MOTION)), np.int64)
        motions = tuple(_joined([none, *parts], np.int64) for parts in self._motions)
        last = tuple((axis.motion, axis.bits) for axis in self._axes)
        return Stroke(
            ticks, shown, tuple(self._inputs), tuple(self._touches), motions, tuple(grown),
            last, self._begins, self._strokes.here(SOUGHT),
        )  # fmt: skip

    def _see(self, tick: int, inputs: int) -> None:
        seen = inputs & self._strokes.mask
        if not self._inputs or self._inputs[-1][1] != seen:
            self._inputs.append((tick, seen))

    def _count(self) -> list[tuple[int, ...]]:
        return [tuple(getattr(axis, counter) for counter in COUNTERS) for axis in self._axes]
