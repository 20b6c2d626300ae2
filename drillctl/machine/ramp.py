"""The acceleration automaton of 2n+1 states (paper, Table 2 and Fig. 5), as data and one rule.

``RampTable.after_step`` is the whole automaton: execution/axis steps by it, ``walk`` and travel.py foresee by it.
The rows are kept so that ``interval[state]`` works for a signed state: row -1 is Python's last, and so on.
ramp_file.py reads and checks the tables.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

from drillctl.machine.landing import first_miss, strokes_of


@dataclass(frozen=True, slots=True)
class RampTable:
    """A checked automaton. Each tuple has 2n+1 entries, indexed by the signed state from -n to n.

    interval       a new column is put out in every interval-th interrupt
    accelerate     steps to go (unsigned) above which the state rises
    brake          steps to go (unsigned) below which the state falls
    whole_strokes  a stroke too short for both its ramps is made in state 0, under the starting interval
    """

    name: str
    top: int
    interval: tuple[int, ...]
    accelerate: tuple[int, ...]
    brake: tuple[int, ...]
    whole_strokes: bool = field(default=False, repr=False)  # in the digest only where it is set (model.py)

    def after_step(self, state: int, direction: int, to_go: int, may_rise: bool) -> int:
        """Returns the state after a step in ``direction`` (+1, -1) that leaves ``to_go`` steps (negative: passed).

        A target that was passed, or is reached too fast, is braked through: ``to_go`` is then below every brake
        distance.
        """
        if to_go == 0 and -1 <= state <= 1:
            return 0
        if to_go < self.brake[state]:
            return state - direction if state else 0
        if may_rise and to_go > self.accelerate[state] and state * direction < self.top:
            return state + direction
        return state

    def walk(self, steps: int, floor_ticks: int = 0) -> Iterator[tuple[int, int]]:
        """Yields for each step of a move of ``steps`` (signed) from rest: interval waited, state in which it is made.

        After braking there is no accelerating until state 0; under a floor the state rises no further once its own
        interval is not above the floor.
        """
        for _, state, _ in self._course(steps, floor_ticks):
            yield max(self.interval[state], floor_ticks), state

    def straight_from(self) -> int:
        """Returns the distance from which on one step more is one cruising interval more."""
        return 2 * self.top + max(self.accelerate) + max(self.brake) + 1

    def first_inexact(self) -> tuple[int, int] | None:
        """Returns the first move that reaches its target too fast to stop there: (state, signed distance), or None.

        Proven for every distance, both ways, and under every floor that caps the automaton at a lower state, so that
        feeds and creeping land exactly too (landing.py).
        """
        found = [(miss.capped, direction, miss) for direction in (1, -1) if (miss := first_miss(self, direction))]
        if not found:
            return None
        _, direction, miss = min(found, key=lambda each: each[0])
        return direction * miss.state, direction * miss.distance

    def _course(self, steps: int, floor_ticks: int) -> Iterator[tuple[int, int, bool]]:
        """Yields for each step of a move from rest: steps to go after it, state in which it is made, braking begun."""
        direction = 1 if steps >= 0 else -1
        ramped_from = strokes_of(self).ramped_from(direction, floor_ticks)
        state, braked = 0, False
        for to_go in range(abs(steps) - 1, -1, -1):
            yield to_go, state, braked
            may_rise = not braked and self.interval[state] > floor_ticks and (state != 0 or to_go >= ramped_from)
            after = self.after_step(state, direction, to_go, may_rise)
            braked = after != 0 and (braked or abs(after) < abs(state))
            state = after
