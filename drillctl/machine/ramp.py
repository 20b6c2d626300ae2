"""Ramp tables: the acceleration automaton of 2n+1 states (paper, Table 2 and Fig. 5), as data and one rule.

``RampTable.after_step`` is the whole automaton: execution/axis steps by it, ``walk`` and travel.py foresee by it.
The rows are kept so that ``interval[state]`` works for a signed state: row -1 is Python's last, and so on.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Annotated

import msgspec

from drillctl.language import Message
from drillctl.machine.phase import Name
from drillctl.machine.source import Source

MOST_STATES = 64
LONGEST_INTERVAL = 100_000
LONGEST_DISTANCE = 1000  # the proof that every move lands exactly walks through all of them
Interval = Annotated[int, msgspec.Meta(ge=1, le=LONGEST_INTERVAL)]
Distance = Annotated[int, msgspec.Meta(ge=-LONGEST_DISTANCE, le=LONGEST_DISTANCE)]


class _Row(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    state: Annotated[int, msgspec.Meta(ge=-MOST_STATES, le=MOST_STATES)]
    accelerate: Distance
    brake: Distance
    interval: Interval


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    state: Annotated[list[_Row], msgspec.Meta(min_length=3, max_length=2 * MOST_STATES + 1)]
    description: str = ""


class _WrittenRow(msgspec.Struct, frozen=True):
    state: int
    accelerate: int
    brake: int
    interval: int


class _Written(msgspec.Struct, frozen=True):
    """The rows of an editor: any number is allowed, so that a wrong one can be shown and corrected."""

    state: list[_WrittenRow]


@dataclass(frozen=True, slots=True)
class RampTable:
    """A checked automaton. Each tuple has 2n+1 entries, indexed by the signed state from -n to n.

    interval    a new column is put out in every interval-th interrupt
    accelerate  steps to go (unsigned) above which the state rises
    brake       steps to go (unsigned) below which the state falls
    """

    name: str
    top: int
    interval: tuple[int, ...]
    accelerate: tuple[int, ...]
    brake: tuple[int, ...]

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

        Tried: every distance up to where moves only grow by cruising steps, both ways, and under every floor that caps
        the automaton at a lower state, so that feeds and creeping land exactly too.
        """
        for direction, floor_ticks in product((1, -1), (0, *sorted(set(self.interval)))):
            proven: set[tuple[int, int, bool]] = set()
            for distance in range(1, self.straight_from() + 2):
                state = self._last_state(direction * distance, floor_ticks, proven)
                if abs(state) > 1:
                    return state, direction * distance
        return None

    def _course(self, steps: int, floor_ticks: int) -> Iterator[tuple[int, int, bool]]:
        """Yields for each step of a move from rest: steps to go after it, state in which it is made, braking begun."""
        direction = 1 if steps >= 0 else -1
        state, braked = 0, False
        for to_go in range(abs(steps) - 1, -1, -1):
            yield to_go, state, braked
            may_rise = not braked and self.interval[state] > floor_ticks
            after = self.after_step(state, direction, to_go, may_rise)
            braked = after != 0 and (braked or abs(after) < abs(state))
            state = after

    def _last_state(self, steps: int, floor_ticks: int, proven: set[tuple[int, int, bool]]) -> int:
        """Returns the state of a move's last step; 0 once the move goes on as one that was found to land."""
        state = 0
        for place in self._course(steps, floor_ticks):
            if place in proven:
                return 0
            proven.add(place)
            state = place[1]
        return state


def read_ramp(file: Path) -> RampTable:
    """Reads and checks a ramp table. Raises TableError naming the file, the state and the reason."""
    return parse_ramp(Source.read(file))


def parse_ramp(source: Source) -> RampTable:
    """As ``read_ramp``, from a text. Every distance must be landed on exactly."""
    raw = source.records(_File)
    for index, row in enumerate(raw.state):
        _check_row(source, index, row)
    rows = _rows_by_state(source, raw)
    top = max(rows)
    order = [raw.state[rows[state]] for state in (*range(top + 1), *range(-top, 0))]
    ramp = RampTable(
        raw.name,
        top,
        tuple(row.interval for row in order),
        tuple(abs(row.accelerate) for row in order),
        tuple(abs(row.brake) for row in order),
    )
    _check_order(source, raw, rows)
    if (inexact := ramp.first_inexact()) is not None:
        state, steps = inexact
        reason = Message(
            "state {state}: a move of {steps} steps is not landed on exactly; brake earlier", state=state, steps=steps
        )
        raise source.error(reason, "state", rows[state], "brake")
    return ramp


def ramp_rows(source: Source) -> list[tuple[int, int, int, int]]:
    """Returns state, accelerate, brake and interval of each row as written, by state, right or wrong. Raises
    TableError.
    """
    rows = source.records(_Written).state
    return sorted((row.state, row.accelerate, row.brake, row.interval) for row in rows)


def proposals(top_row: tuple[int, int, int, int]) -> Iterator[tuple[int, int, int, int]]:
    """Yields rows for the state above the top one, for an editor to try: as fast as that one, braking ever earlier."""
    state, accelerate, brake, interval = top_row
    for further in range(1, 2 * state + 2):
        yield state + 1, accelerate + 1, brake + further, interval


def _rows_by_state(source: Source, raw: _File) -> dict[int, int]:
    """Returns the index of each state's row; every state from -n to n must have just one."""
    rows: dict[int, int] = {}
    for index, row in enumerate(raw.state):
        if row.state in rows:
            raise source.error(
                Message("state {state}: a second row of this state", state=row.state), "state", index, "state"
            )
        rows[row.state] = index
    top = max(map(abs, rows))
    if missing := [state for state in range(-top, top + 1) if state not in rows]:
        reason = Message(
            "no row for state {states}; a ramp has all from {lowest} to {top}",
            states=", ".join(map(str, missing)),
            lowest=-top,
            top=top,
        )
        raise source.error(reason, "state", 0)
    return rows


def _check_row(source: Source, index: int, row: _Row) -> None:
    for key, distance in (("accelerate", row.accelerate), ("brake", row.brake)):
        if distance * row.state < 0 or (row.state == 0) != (distance == 0):
            reason = Message(
                "state {state}: {key} distance {distance} must have the state's sign (0 for state 0)",
                state=row.state,
                key=key,
                distance=distance,
            )
            raise source.error(reason, "state", index, key)


def _check_order(source: Source, raw: _File, rows: dict[int, int]) -> None:
    for state, index in rows.items():
        below = state - (state > 0) + (state < 0)
        if state and abs(raw.state[index].brake) < abs(raw.state[rows[below]].brake):
            distance = raw.state[index].brake
            reason = Message(
                "state {state}: brake distance {distance} is below state {below}'s",
                state=state,
                distance=distance,
                below=below,
            )
            raise source.error(reason, "state", index, "brake")
