"""Where one axis is before and after each of many commands, and what it puts out meanwhile.

Rule: an axis that nobody sends anywhere rests, its forcing off; one that is sent moves at once and then rests until the
command ends. Made by engine.py for every axis; strokes that end on a sensor are laid over it by course.py.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.fastforward.move_profile import MoveProfile
from drillctl.trace.tapes import LAP, Count, ImagePool

Strides = Callable[[int, int], MoveProfile]  # by direction and floor


@dataclass(frozen=True, eq=False)
class AxisBatch:
    """One axis through n commands; arrays are (n,), but ``position`` and ``column`` (n+1,): before each, and at last.

    sent      whether the command is a move of this axis, be it of no steps; ``absolute``: to a place
    steps     signed; 0 where it rests
    floor     of the command
    ticks     of its own motion
    """

    axis: Axis
    strides: Strides
    sent: NDArray[np.bool_]
    absolute: NDArray[np.bool_]
    floor: Count
    steps: Count
    position: Count
    column: Count
    ticks: Count

    @classmethod
    def of(cls, axis: Axis, strides: Strides, given: Count, absolute: NDArray[np.bool_], sent: NDArray[np.bool_],
           floor: Count) -> "AxisBatch":  # fmt: skip
        """From the arguments ``given`` (n,): places from the working base where ``absolute``, else distances."""
        position = _positions(axis, given, absolute & sent, ~absolute & sent)
        steps = np.diff(position)
        travel = np.cumsum(steps * (axis.columns_per_step * axis.sense))
        column = np.concatenate(([axis.column], (axis.column + travel) % axis.length))
        return cls(axis, strides, sent, absolute, floor, steps, position, column, np.zeros(len(given), np.int64))

    def timed(self) -> bool:
        """Finds the ticks of each move; False where a move is not to be foreseen."""
        for stride, rows in self._moves():
            if not stride.foreseeable:
                return False
            self.ticks[rows] = stride.ticks(np.abs(self.steps[rows]))
        return True

    def upto(self, count: int) -> "AxisBatch":
        """The first ``count`` commands alone."""
        rows, places = slice(count), slice(count + 1)
        return AxisBatch(self.axis, self.strides, self.sent[rows], self.absolute[rows], self.floor[rows],
                       self.steps[rows], self.position[places], self.column[places], self.ticks[rows])  # fmt: skip

    def travel(self) -> int:
        """Columns on the way, forward less backward, as the controller counts them."""
        return int(self.steps.sum()) * self.axis.columns_per_step

    def slices(self, reel: ImagePool, ticks: Count) -> tuple[Count, Count, Count]:
        """Start, ticks and lap (n, 5) while the commands take ``ticks`` (n,): wait, head, cruise, tail, rest."""
        start, length = np.zeros((2, len(ticks), 5), np.int64)
        lap = np.full_like(start, LAP)
        start[:, 0], start[:, 4] = self._rests(reel)
        length[:, 0] = ticks
        for stride, rows in self._moves():
            start[rows, 1:4], length[rows, 1:4], lap[rows, 1:4] = stride.slices(
                reel, np.abs(self.steps[rows]), self.column[rows]
            )
            length[rows, 0] = stride.first_wait - 1
            length[rows, 4] = ticks[rows] - self.ticks[rows]
        return start, length, lap

    def motion(self, starts: Count) -> Count:
        """Tick, column, position and state at the beginning and at every column put out, (4, k), by rising tick;
        the commands begin at the ticks ``starts`` (n,).
        """
        parts = [np.array([[-1], [self.column[0]], [self.position[0]], [0]], np.int64)]
        for stride, rows in self._moves():
            distance = self.steps[rows]
            for steps in np.unique(distance).tolist():
                parts.append(self._moved(stride.motion(abs(steps)), rows[distance == steps], starts))
        motion = np.concatenate(parts, axis=1)
        return motion[:, np.argsort(motion[0], kind="stable")]

    def _moved(self, once: Count, rows: NDArray[np.intp], starts: Count) -> Count:
        """The same move, made in each of these commands; ``once`` is as Stride.motion has it."""
        ticks, columns, made, states = once
        way = np.sign(self.steps[rows])[:, None]
        column = (self.column[rows][:, None] + way * self.axis.sense * columns) % self.axis.length
        position = self.position[rows][:, None] + way * made
        told = (starts[rows][:, None] + ticks, column, position, np.broadcast_to(states, column.shape))
        return np.stack([each.ravel() for each in told])

    def _rests(self, reel: ImagePool) -> tuple[Count, Count]:
        """Where the image lies that stands before a command's first column, and after its last one: (n,) each."""
        axis, turn = self.axis, np.sign(self.steps) * self.axis.sense
        moved = np.flatnonzero(turn)
        cold = np.array([[reel.steady(image) for image in axis.resting[t] or (0,) * axis.length] for t in (0, 1, -1)])
        last = np.maximum.accumulate(np.where(turn != 0, np.arange(1, len(turn) + 1), 0)) if len(turn) else moved
        after = np.concatenate(([reel.steady(axis.cold)], cold[turn, self.column[1:]]))[last]
        before = np.concatenate(([reel.steady(axis.cold)], after[:-1]))[: len(turn)]
        if axis.drive:  # the direction wire stands before the first pulse
            before[moved] = cold[turn[moved], self.column[moved]]
        return before, after

    def _moves(self) -> list[tuple[MoveProfile, NDArray[np.intp]]]:
        """The commands in which this axis moves, by direction and floor."""
        found = []
        for direction in (1, -1):
            rows = np.flatnonzero(self.steps * direction > 0)
            for floor in np.unique(self.floor[rows]).tolist():
                found.append((self.strides(direction, floor), rows[self.floor[rows] == floor]))
        return found

    def leave(self, longest: Count) -> None:
        """The axis as it stands after the last command; ``longest`` (n,) are the commands' ticks."""
        axis = self.axis
        axis.was_at(int(self.position.min()), int(self.position.max()))
        axis.cool()
        if not self.sent.any():
            return
        axis.position = axis.target = int(self.position[-1])
        axis.floor = int(self.floor[self.sent][-1])
        axis.seek_mask = axis.clear_mask = 0
        axis.braked = False
        if self.steps.any():
            self._leave_moved(int(longest[-1]))

    def _leave_moved(self, longest: int) -> None:
        axis, row = self.axis, int(np.flatnonzero(self.steps)[-1])
        axis.made += int(np.abs(self.steps).sum())
        axis.travelled += self.travel()
        axis.column = int(self.column[-1])
        axis.direction = int(np.sign(self.steps[row]))
        axis.count = 0
        axis.wait = self.strides(axis.direction, int(self.floor[row])).last_wait(abs(int(self.steps[row])))
        turn = axis.direction * axis.sense
        axis.cold = axis.resting[turn][axis.column]
        axis.cooling = row == len(self.steps) - 1 and int(self.ticks[row]) == longest  # just come to rest
        axis.bits = axis.shown[turn][axis.column] if axis.cooling else axis.cold


def _positions(axis: Axis, given: Count, placed: NDArray[np.bool_], shifted: NDArray[np.bool_]) -> Count:
    """The position before each command and after the last, from places and distances mixed."""
    shifts = np.concatenate(([axis.position], np.where(shifted, given, 0))).cumsum()
    known = np.concatenate(([axis.position], np.where(placed, given + axis.base, 0)))
    last = np.maximum.accumulate(np.where(np.concatenate(([True], placed)), np.arange(len(known)), 0))
    positions: Count = known[last] + shifts - shifts[last]
    return positions
