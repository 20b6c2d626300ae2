"""What follows from a ramp alone: the time of a move, by distance, feed and columns per step.

Rule: pure functions of a RampTable; no axis, no clock.
"""

from bisect import bisect_right
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from drillctl.machine.landing import least_distances, strokes_of
from drillctl.machine.ramp import RampTable


def intervals(ramp: RampTable, steps: int, floor_ticks: int = 0) -> list[int]:
    """Returns the ticks waited before each step of a move of ``steps`` (signed) from rest: ``[7, 4, 2, 4]`` for 4."""
    return [interval for interval, _ in ramp.walk(steps, floor_ticks)]


def travel_ticks(ramp: RampTable, steps: int, floor_ticks: int = 0, columns_per_step: int = 1) -> int:
    """Returns the ticks of a move from rest to rest: its intervals, each waited for every column of a step."""
    direction = 1 if steps >= 0 else -1
    short = min(abs(steps), cruising_from(ramp, floor_ticks, direction))
    ticks = sum(intervals(ramp, direction * short, floor_ticks))
    state = cruising_state(ramp, floor_ticks, direction)
    cruise = max(ramp.interval[direction * state], floor_ticks)
    return (ticks + (abs(steps) - short) * cruise) * columns_per_step


def travel_table(ramp: RampTable, longest_steps: int, columns_per_step: int = 1) -> NDArray[np.int64]:
    """Returns travel ticks by distance, shape (longest_steps + 1,). Not monotone: 3 steps take 18 ticks, 4 take 17."""
    computed = min(longest_steps, cruising_from(ramp, 0))
    head = np.array(_short_moves(ramp, computed), dtype=np.int64) * columns_per_step
    cruise = ramp.interval[ramp.top] * columns_per_step
    tail = head[-1] + cruise * np.arange(1, longest_steps - computed + 1, dtype=np.int64)
    return np.concatenate([head, tail])


def _short_moves(ramp: RampTable, longest: int) -> list[int]:
    """Returns travel ticks by distance, of moves that may be too short to cruise, each from those of shorter ones."""
    risen = [*accumulate(ramp.interval[state] for state in range(ramp.top + 1))]
    distances, ramped_from = least_distances(ramp, 1), strokes_of(ramp).ramped_from(1, 0)
    ticks = [0]
    known: dict[tuple[int, int], int] = {}
    for steps in range(1, longest + 1):
        state = bisect_right(distances, steps) - 1 if steps > ramped_from else 0
        ticks.append(risen[state] + _ticks_left(ramp, (state, steps - 1 - state), ticks, known))
    return ticks


def _ticks_left(ramp: RampTable, place: tuple[int, int], ticks: list[int], known: dict[tuple[int, int], int]) -> int:
    """Returns the ticks of the rest of a move that rises no more, from a place: a state and the steps to go after a
    step in it. ``ticks`` are those of shorter moves by distance; ``known`` are those left by place, and grows.
    """
    passed = []
    state, to_go = place
    while state and to_go and (state, to_go) not in known:
        waited = max(0, to_go - max(ramp.brake[state], 1) + 1)
        falls = 0 if waited or state == 1 else 1  # a step, in the state below; in state 0 a new move begins
        passed.append(((state, to_go), waited * ramp.interval[state] + falls * ramp.interval[state - 1]))
        state, to_go = (state, to_go - waited) if waited else (state - 1, to_go - falls)
    left = known[state, to_go] if state and to_go else ticks[to_go]
    for before, cost in reversed(passed):
        left += cost
        known[before] = left
    return left


def cruising_state(ramp: RampTable, floor_ticks: int, direction: int = 1) -> int:
    """Returns the state (unsigned) that a long move reaches: it stops rising once the floor decides its interval."""
    states = range(ramp.top)
    return next((s for s in states if ramp.interval[s * direction] <= floor_ticks), ramp.top)


def cruising_from(ramp: RampTable, floor_ticks: int, direction: int = 1) -> int:
    """Returns the distance (unsigned) from which on one step more is one cruising interval more."""
    state = cruising_state(ramp, floor_ticks, direction)
    return max(least_distances(ramp, direction)[state], state + 1 + ramp.brake[direction * state])


def stopping(ramp: RampTable, state: int) -> tuple[int, int]:
    """Returns steps and ticks from a state to rest when braking begins at once, as a hold does."""
    direction = 1 if state > 0 else -1
    steps = ticks = 0
    while state:
        ticks += ramp.interval[state]
        steps += 1
        state = ramp.after_step(state, direction, 0, may_rise=False)
    return steps, ticks
