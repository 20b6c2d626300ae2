"""Where one axis is before and after each of many commands, and what it puts out meanwhile.

Rule: an axis that gets no target rests, its forcing off; one that is sent moves at once and then rests until the
command ends. Strokes that end on a sensor are not in it: batch.py has them.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.fastforward.move_profile import MoveProfile
from drillctl.execution.motion import REST, SETTLING
from drillctl.trace.tapes import PERIOD, Count, ImagePool

Profiles = Callable[[int, int], MoveProfile]  # by direction and min_interval


@dataclass(frozen=True, eq=False)
class AxisBatch:
    """One axis through n commands; arrays are (n,), but ``position`` and ``column`` (n+1,): before each, and at last.

    sent      whether the command is a move of this axis, be it of no steps; ``absolute``: to a place
    steps     signed; 0 where it rests
    min_interval  of the command, in ticks
    ticks     of its own motion
    delay     ticks of the command before it starts
    """

    axis: Axis
    profiles: Profiles
    sent: NDArray[np.bool_]
    absolute: NDArray[np.bool_]
    min_interval: Count
    steps: Count
    position: Count
    column: Count
    ticks: Count
    delay: Count

    @classmethod
    def of(cls, axis: Axis, profiles: Profiles, given: Count, absolute: NDArray[np.bool_], sent: NDArray[np.bool_],
           min_interval: Count) -> "AxisBatch":  # fmt: skip
        """From the arguments ``given`` (n,): places from the working base where ``absolute``, else distances."""
        position = _positions(axis, given, absolute & sent, ~absolute & sent)
        steps = np.diff(position)
        travel = np.cumsum(steps * (axis.columns_per_step * axis.direction_sign))
        column = np.concatenate(([axis.column], (axis.column + travel) % axis.length))
        ticks = np.zeros(len(given), np.int64)
        return cls(axis, profiles, sent, absolute, min_interval, steps, position, column, ticks, ticks.copy())

    def timed(self) -> bool:
        """Finds the ticks of each move; False where a move is not to be foreseen."""
        for profile, rows in self._moves():
            if not profile.foreseeable:
                return False
            self.ticks[rows] = profile.ticks(np.abs(self.steps[rows]))
        return True

    def ends(self) -> Count:
        """In each command, the ticks up to where it rests again, (n,); 0 where it doesn't move."""
        return np.where(self.steps != 0, self.delay + self.ticks, 0)

    def upto(self, count: int, delay: Count) -> "AxisBatch":
        """The first ``count`` commands alone, with the ``delay`` (count,) of each."""
        return replace(self._part(slice(count), slice(count + 1)), delay=delay)

    def last(self) -> "AxisBatch":
        """The last command alone."""
        return self._part(slice(-1, None), slice(-2, None))

    def _part(self, rows: slice, places: slice) -> "AxisBatch":
        return AxisBatch(
            self.axis, self.profiles, self.sent[rows], self.absolute[rows], self.min_interval[rows], self.steps[rows],
            self.position[places], self.column[places], self.ticks[rows], self.delay[rows],
        )  # fmt: skip

    def travel(self) -> int:
        """Columns on the way, forward less backward, as the controller counts them."""
        return int(self.steps.sum()) * self.axis.columns_per_step

    def slices(self, pool: ImagePool, ticks: Count) -> tuple[Count, Count, Count]:
        """Start, ticks and period (n, 6) while the commands take ``ticks`` (n,): delay, wait, head, cruise, tail and
        rest.
        """
        start, length = np.zeros((2, len(ticks), 6), np.int64)
        period = np.full_like(start, PERIOD)
        start[:, 0], start[:, 1], start[:, 5] = self._rests(pool)
        length[:, 0] = ticks
        for profile, rows in self._moves():
            start[rows, 2:5], length[rows, 2:5], period[rows, 2:5] = profile.slices(
                pool, np.abs(self.steps[rows]), self.column[rows]
            )
            length[rows, 0] = self.delay[rows]
            length[rows, 1] = profile.first_wait - 1
            length[rows, 5] = ticks[rows] - self.delay[rows] - self.ticks[rows]
        return start, length, period

    def motion(self, starts: Count) -> Count:
        """Tick, column, position and state at the beginning and at every column put out, (4, k), by rising tick;
        the commands begin at the ticks ``starts`` (n,).
        """
        parts = [np.array([[-1], [self.column[0]], [self.position[0]], [0]], np.int64)]
        begins = starts[: len(self.delay)] + self.delay
        for profile, rows in self._moves():
            distance = self.steps[rows]
            for steps in sorted(set(distance.tolist())):  # np.unique would import numpy.ma
                parts.append(self._moved(profile.motion(abs(steps)), rows[distance == steps], begins))
        parts.sort(key=lambda part: int(part[0, 0]))  # mostly that is the order of all ticks already
        motion = np.concatenate(parts, axis=1)
        return motion[:, np.argsort(motion[0], kind="stable")]

    def _moved(self, once: Count, rows: NDArray[np.intp], starts: Count) -> Count:
        """The same move, made in each of these commands; ``once`` is as MoveProfile.motion has it."""
        ticks, columns, made, states = once
        way = np.sign(self.steps[rows])[:, None]
        column = (self.column[rows][:, None] + way * self.axis.direction_sign * columns) % self.axis.length
        position = self.position[rows][:, None] + way * made
        moved = (starts[rows][:, None] + ticks, column, position, np.broadcast_to(states, column.shape))
        return np.stack([each.ravel() for each in moved])

    def _rests(self, pool: ImagePool) -> tuple[Count, Count, Count]:
        """Where the image lies that stands before an axis starts, before its first column, and after its last one:
        (n,) each.
        """
        axis, turn = self.axis, np.sign(self.steps) * self.axis.direction_sign
        moved = np.flatnonzero(turn)
        patterns = [axis.hold_patterns[way] or (0,) * axis.length for way in (0, 1, -1)]
        at_rest = np.array([[pool.steady(image) for image in pattern] for pattern in patterns])
        last = np.maximum.accumulate(np.where(turn != 0, np.arange(1, len(turn) + 1), 0)) if len(turn) else moved
        after = np.concatenate(([pool.steady(axis.hold_bits)], at_rest[turn, self.column[1:]]))[last]
        before = np.concatenate(([pool.steady(axis.hold_bits)], after[:-1]))[: len(turn)]
        turned = before.copy()
        if axis.drive:  # the direction wire stands before the first pulse
            turned[moved] = at_rest[turn[moved], self.column[moved]]
        return before, turned, after

    def _moves(self) -> list[tuple[MoveProfile, NDArray[np.intp]]]:
        """The commands in which this axis moves, by direction and min_interval."""
        found = []
        for direction in (1, -1):
            rows = np.flatnonzero(self.steps * direction > 0)
            for min_interval in sorted(set(self.min_interval[rows].tolist())):
                found.append((self.profiles(direction, min_interval), rows[self.min_interval[rows] == min_interval]))
        return found

    def leave(self, longest: Count) -> None:
        """The axis as it stands after the last command; ``longest`` (n,) are the commands' ticks."""
        axis = self.axis
        axis.was_at(int(self.position.min()), int(self.position.max()))
        axis.cool()
        if not self.sent.any():
            return
        axis.position = axis.target = int(self.position[-1])
        axis.min_interval = int(self.min_interval[self.sent][-1])
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        if self.steps.any():
            self._leave_moved(int(longest[-1]))
        axis.ramped_from = axis.strokes.ramped_from(axis.direction, axis.min_interval)

    def _leave_moved(self, longest: int) -> None:
        axis, row = self.axis, int(np.flatnonzero(self.steps)[-1])
        axis.made += int(np.abs(self.steps).sum())
        axis.travelled += self.travel()
        axis.column = int(self.column[-1])
        axis.direction = int(np.sign(self.steps[row]))
        axis.count = 0
        axis.wait = self.profiles(axis.direction, int(self.min_interval[row])).last_wait(abs(int(self.steps[row])))
        turn = axis.direction * axis.direction_sign
        axis.hold_bits = axis.hold_patterns[turn][axis.column]
        just_at_rest = row == len(self.steps) - 1 and int(self.ends()[row]) == longest
        axis.motion = SETTLING if just_at_rest else REST
        axis.bits = axis.drive_patterns[turn][axis.column] if just_at_rest else axis.hold_bits


def _positions(axis: Axis, given: Count, placed: NDArray[np.bool_], shifted: NDArray[np.bool_]) -> Count:
    """The position before each command and after the last, from places and distances mixed."""
    shifts = np.concatenate(([axis.position], np.where(shifted, given, 0))).cumsum()
    known = np.concatenate(([axis.position], np.where(placed, given + axis.base, 0)))
    last = np.maximum.accumulate(np.where(np.concatenate(([True], placed)), np.arange(len(known)), 0))
    positions: Count = known[last] + shifts - shifts[last]
    return positions


def turns_of(axis: Axis, column: Count, position: Count, before: tuple[int, int]) -> Count:
    """Returns the columns that an axis puts out in each row of its motion, as the wires have it: 1, 0 or -1, (n,). A
    motion goes on to a whole step, so the next step made tells the direction. ``before`` are column and position before
    the first row.
    """
    steps = np.diff(position, prepend=before[1])
    made = np.flatnonzero(steps)
    if not len(made):
        return np.zeros(len(column), np.int64)
    put_out = np.diff(column, prepend=before[0]) != 0 if axis.length > 1 else steps != 0
    following = np.minimum(np.cumsum(steps != 0) - (steps != 0), len(made) - 1)
    turns: Count = put_out * np.sign(steps[made[following]]) * axis.direction_sign
    return turns
