"""Proof that an automaton lands exactly on every distance, in time proportional to its states and brake distances.

Rule: the proof follows ``RampTable.after_step`` and knows only this of it: a move from rest rises a state a step, may
stay in a state, and from the first fall on only stays or falls. A place is a state and the steps to go after a step.
All moves that wait in a state leave it at the same place, so a state is proven once for all distances.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drillctl.machine.ramp import RampTable


@dataclass(frozen=True, slots=True)
class Miss:
    """A move that reaches its target in a state too fast to stop: its distance (unsigned), the state of its last step,
    and whether it needs a floor that caps the automaton.
    """

    capped: bool
    distance: int
    state: int


def least_distances(ramp: "RampTable", direction: int) -> list[int]:
    """Returns, by state (unsigned), the least distance of a move from rest that makes a step in that state."""
    distances = [1]
    for state in range(ramp.top):
        needed = max(ramp.brake[direction * state], ramp.accelerate[direction * state] + 1)
        # ``needed`` steps are to go after the step in this state, the state-th from 0.
        distances.append(max(distances[-1], needed + state + 1))
    return distances


def first_miss(ramp: "RampTable", direction: int) -> Miss | None:
    """Returns the first move in a direction (+1, -1) that is not landed on exactly: without a floor, else the shortest
    under any floor; None where every move lands.
    """
    return min(_misses(ramp, direction), key=lambda miss: (miss.capped, miss.distance), default=None)


def _misses(ramp: "RampTable", direction: int) -> Iterator[Miss]:
    brake = [ramp.brake[direction * state] for state in range(ramp.top + 1)]
    accelerate = [ramp.accelerate[direction * state] for state in range(ramp.top + 1)]
    reached, caps, falls = least_distances(ramp, direction), set(_caps(ramp, direction)), _Falls()
    for state in range(1, ramp.top + 1):
        for to_go in range(reached[state] - state - 1, brake[state]):  # it falls at once, having just risen
            if last := falls.last_state(state, to_go):
                yield Miss(False, to_go + state + 1, last)
        last = falls.last_state(state, brake[state] - 1)
        falls.add(state, brake[state], last)
        waiting = max(reached[state], brake[state] + state + 1)
        if last and (state == ramp.top or waiting <= accelerate[state] + state + 1):
            yield Miss(False, waiting, last)
        elif last and state in caps:
            yield Miss(True, waiting, last)


def _caps(ramp: "RampTable", direction: int) -> Iterator[int]:
    """Yields the states that a floor can cap the automaton at: each that is quicker than all below it."""
    least = None
    for state in range(ramp.top + 1):
        if least is None or ramp.interval[direction * state] < least:
            least = ramp.interval[direction * state]
            yield state


class _Falls:
    """Where falls end. A fall from a state loses a state and a step at once, so it keeps ``to go - state`` until it
    waits: in the highest state below whose brake distance is not above its steps to go.
    """

    def __init__(self) -> None:
        self._margins = [0]  # brake distance less the state: a fall that keeps this or more waits there
        self._ends = [0]  # the state in which a move that waited there makes its last step, 0 where it lands

    def last_state(self, state: int, to_go: int) -> int:
        """Returns the state in which a fall from here reaches its target, 0 where it lands: a state of 0 or 1, or by
        waiting where waiting lands. State 0 is a new move of what is left.
        """
        below = bisect_right(self._margins, to_go - state) - 1
        if below >= 0:
            return self._ends[below]
        last = state - to_go
        return last if last > 1 else 0

    def add(self, state: int, brake: int, end: int) -> None:
        """Notes how waiting in a state ends. It hides lower states at which the same falls would have waited."""
        while self._margins and self._margins[-1] >= brake - state:
            self._margins.pop()
            self._ends.pop()
        self._margins.append(brake - state)
        self._ends.append(end)


@lru_cache(maxsize=64)
def strokes_of(ramp: "RampTable") -> "Strokes":
    """Returns the strokes of a ramp, the same for all that have it."""
    return Strokes(ramp)


class Strokes:
    """From which distance on a ramp accelerates at all. Built once for a ramp; asking takes no walk through it."""

    def __init__(self, ramp: "RampTable"):
        self._whole = ramp.whole_strokes
        self._distances: tuple[list[int], ...] = ([], [], [])  # index 1 for forward, -1 for backward (0 unused)
        self._quickness: tuple[list[int], ...] = ([], [], [])  # the same: minus the least interval up to each state
        if self._whole:
            for direction in (1, -1):
                states = range(0, direction * (ramp.top + 1), direction)
                least = accumulate((ramp.interval[state] for state in states), min)
                self._distances[direction].extend(least_distances(ramp, direction))
                self._quickness[direction].extend(-interval for interval in least)

    def ramped_from(self, direction: int, floor_ticks: int) -> int:
        """Returns the steps that must be to go after a first step for the state to rise, in a direction (+1, -1)
        under a floor: 0, but where a stroke shorter than its two ramps runs whole in state 0.
        """
        if not self._whole:
            return 0
        quickness = self._quickness[direction]
        cruising = min(bisect_left(quickness, -floor_ticks), len(quickness) - 1)
        return self._distances[direction][cruising] - 1
