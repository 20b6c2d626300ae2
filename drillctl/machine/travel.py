"""What follows from a ramp alone: the time of a move, by distance, feed and columns per step.

Rule: pure functions of a RampTable; no axis, no clock.
"""

import numpy as np
from numpy.typing import NDArray

from drillctl.machine.landing import least_distances
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
    head = np.array([travel_ticks(ramp, d, 0, columns_per_step) for d in range(computed + 1)], dtype=np.int64)
    cruise = ramp.interval[ramp.top] * columns_per_step
    tail = head[-1] + cruise * np.arange(1, longest_steps - computed + 1, dtype=np.int64)
    return np.concatenate([head, tail])


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
