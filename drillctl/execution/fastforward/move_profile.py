"""All moves of one axis in one direction under one least interval: how long each takes, and what it puts out.

Rule: the ramp's own walk says the intervals; beyond the distance from which head and tail of a move don't touch, one
step more is one cruising step more in its middle. So a move is three slices of the pool: head, cruise, tail, for every
column that it may begin at. There is one for each axis, direction and least interval that a job has.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.machine.travel import cruising_from, cruising_state
from drillctl.trace.tapes import PERIOD, Count, ImagePool

LONGEST_STRIP = 1 << 20  # words that the strips of one distance may take; an interval beyond that is left to tick


class MoveProfile:
    """Moves by distance, in steps of the controller (unsigned). ``first_wait`` ticks pass before the first column."""

    def __init__(self, axis: Axis, direction: int, min_interval: int):
        ramp, self._axis, self._columns = axis.ramp, axis, axis.columns_per_step
        self._turn = direction * axis.direction_sign
        self._direction, self._min_interval = direction, min_interval
        self.first_wait = max(axis.interval[0], min_interval)
        state = direction * cruising_state(ramp, min_interval, direction)
        self._pace = max(axis.interval[state], min_interval)
        self._straight = cruising_from(ramp, min_interval, direction)
        walk = list(ramp.walk(direction * self._straight, min_interval))
        self._cruise = [made_in for _, made_in in walk].index(state)  # steps before the cruise begins
        self._split = self._cruise * self._columns
        self._known: dict[int, tuple[int, int]] = {}  # by distance: ticks of the move, and those before its last column
        self._walks: dict[int, Count] = {}  # by distance: interval and state of each step
        self._strips: dict[int, int] = {}
        self._cycle = -1

    @property
    def foreseeable(self) -> bool:
        """Whether its strips are of a sensible size."""
        return self._axis.length * self._straight * self._columns * self._pace <= LONGEST_STRIP

    def ticks(self, steps: Count) -> Count:
        """Ticks from rest to rest of moves of ``steps`` (n,)."""
        short = np.minimum(steps, self._straight)
        distances, places = np.unique(short, return_inverse=True)
        ticks = np.array([self._timed(distance)[0] for distance in distances.tolist()], np.int64)
        return ticks[places] + (steps - short) * (self._columns * self._pace)

    def last_wait(self, steps: int) -> int:
        """The interval before the last column."""
        return self._timed(min(steps, self._straight))[1]

    def slices(self, pool: ImagePool, steps: Count, column: Count) -> tuple[Count, Count, Count]:
        """Start, ticks and period of head, cruise and tail of moves (n,) beginning at columns (n,): each (n, 3).

        They begin with the first column, ``first_wait - 1`` ticks after the move was taken.
        """
        axis, turn = self._axis, self._turn
        short = np.minimum(steps, self._straight)
        extra = (steps - short) * self._columns
        begins, lengths = self._laid(pool, short)
        head = np.where(extra > 0, sum(self._waits(self._straight)[1 : self._split + 1]), lengths)
        start = np.zeros((len(steps), 3), np.int64)
        ticks, period = start.copy(), np.full_like(start, PERIOD + 1)
        start[:, 0] = begins + column * lengths
        ticks[:, 0] = head
        first = (column + turn * (self._split + 1)) % axis.length
        start[:, 1] = self._cycle_start(pool) + (turn * first) % axis.length * self._pace
        ticks[:, 1] = extra * self._pace
        period[:, 1] = self._cycle_period
        start[:, 2] = begins + (column + turn * extra) % axis.length * lengths + head
        ticks[:, 2] = lengths - head
        period[:, (0, 2)] = np.maximum(lengths, PERIOD + 1)[:, None]
        return start, ticks, period

    def motion(self, steps: int) -> Count:
        """For each column of a move of so many steps: its tick, the columns and whole steps made, and the state then:
        (4, columns). Ticks count from that in which the move was taken.
        """
        short = min(steps, self._straight)
        times = np.ones(short, np.int64)
        times[self._cruise : self._cruise + 1] += steps - short
        waits, states = np.repeat(self._walk(short), times, axis=1)
        columns = np.arange(1, steps * self._columns + 1)
        made = columns // self._columns
        ticks = np.cumsum(np.repeat(waits, self._columns)) - 1
        return np.stack((ticks, columns, made, np.append(states, 0)[made]))

    def _walk(self, steps: int) -> Count:
        """Returns interval and state of each step of a move, (2, steps)."""
        if steps not in self._walks:
            walk = [*self._axis.ramp.walk(self._direction * steps, self._min_interval)]
            self._walks[steps] = np.array(walk, np.int64).reshape(-1, 2).T
        return self._walks[steps]

    def _timed(self, steps: int) -> tuple[int, int]:
        """Ticks of a move, and those before its last column (0 of none)."""
        if steps not in self._known:
            waits = self._waits(steps)
            self._known[steps] = sum(waits), waits[-1] if waits else 0
        return self._known[steps]

    def _waits(self, steps: int) -> list[int]:
        """Ticks before each column of a move."""
        walk = self._axis.ramp.walk(self._direction * steps, self._min_interval)
        return [interval for interval, _ in walk for _ in range(self._columns)]

    def _laid(self, pool: ImagePool, short: Count) -> tuple[Count, Count]:
        """Where the strips of these distances begin, those of the columns one after the other, and their length."""
        begins, lengths = np.zeros((2, self._straight + 1), np.int64)
        for steps in np.flatnonzero(np.bincount(short, minlength=1)).tolist():
            shown_for = [*self._waits(steps)[1:], 1]
            if steps not in self._strips:
                self._strips[steps] = pool.add(self._images(np.repeat(np.arange(1, len(shown_for) + 1), shown_for)))
            begins[steps], lengths[steps] = self._strips[steps], sum(shown_for)
        return begins[short], lengths[short]

    def _images(self, made: NDArray[np.int64]) -> list[int]:
        """For each column to begin at: the images after so many columns ``made``, tick by tick."""
        axis = self._axis
        shown = np.array(axis.drive_patterns[self._turn], np.uint64)
        columns = (np.arange(axis.length)[:, None] + self._turn * made) % axis.length
        return shown[columns].ravel()

    def _cycle_start(self, pool: ImagePool) -> int:
        """A strip that goes round and round at cruising pace, from the table's first column."""
        if self._cycle < 0:
            round_about = self._turn * np.arange(self._axis.length) % self._axis.length
            once = np.repeat(np.array(self._axis.drive_patterns[self._turn], np.uint64)[round_about], self._pace)
            self._cycle = pool.add(np.tile(once, self._cycle_period // len(once) + 1))
        return self._cycle

    @property
    def _cycle_period(self) -> int:
        """Whole rounds, PERIOD ticks or more, and never PERIOD itself: that is the mark of a steady image."""
        cycle = self._axis.length * self._pace
        return cycle * (PERIOD // cycle + 1)
