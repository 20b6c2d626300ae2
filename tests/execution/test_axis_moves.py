"""The automaton, every distance: exact landing, states one at a time, the paper's intervals (SPEC.md, 1.2, 1.3)."""

from dataclasses import dataclass

import pytest

from drillctl.execution.axis import Axis
from drillctl.execution.motion import AxisMotion
from drillctl.machine import travel_ticks
from tests.support.axes import RAMPS, Step, lone_axis, next_step, steps_to_rest
from tests.support.paper import INTERVALS

LONGEST_STEPS = 5000
BOTH_WAYS = (1, -1)
FLOORS = (0, 1, 2, 3, 4, 5, 7, 8, 50)


@dataclass(frozen=True)
class Node:
    """All that decides how a move goes on after a step; states and distance are told in the direction of motion."""

    state: int
    braked: bool
    to_go: int


@dataclass(frozen=True)
class Case:
    ramp: str
    direction: int
    columns_per_step: int = 1
    floor: int = 0

    def __str__(self) -> str:
        way = "+" if self.direction > 0 else "-"
        return f"{self.ramp}{way}-{self.columns_per_step}col-floor{self.floor}"


EVERY_DISTANCE = [Case(ramp, way) for ramp in RAMPS for way in BOTH_WAYS]
SHORTER = [
    Case(ramp, way, columns, floor) for ramp in RAMPS for way in BOTH_WAYS for columns in (1, 2, 6) for floor in FLOORS
]


def place(axis: Axis, node: Node, case: Case) -> None:
    """The axis in mid-move, just after the step that led to this node."""
    axis.position, axis.target = 0, node.to_go * case.direction
    axis.state = node.state * case.direction
    axis.direction, axis.min_interval, axis.count = case.direction, case.floor, 0
    axis.wait = max(axis.interval[axis.state], case.floor)
    axis.ramped_from = axis.strokes.ramped_from(case.direction, case.floor)
    axis.motion = AxisMotion.BRAKING if node.braked else AxisMotion.MOVING


def check_step(axis: Axis, node: Node, case: Case, step: Step) -> None:
    """What must be true of any step of a plain move."""
    ramp = RAMPS[case.ramp]
    assert step.ticks == case.columns_per_step * max(ramp.interval[step.state], case.floor)
    assert step.direction == case.direction
    assert abs(step.after - step.state) <= 1
    rises = abs(step.after) > abs(step.state)
    assert not (rises and ramp.interval[step.state] <= case.floor), "rose under its floor"
    assert not (rises and node.braked), "accelerated again after braking"
    if not axis.counting:
        assert (axis.position, axis.state) == (axis.target, 0)
        assert abs(step.state) <= 1, "stopped from a state above 1"


def ticks_of_every_distance(case: Case, longest: int) -> list[int]:
    """Ticks by distance. A move is a path through nodes; each node is stepped by the real axis, once."""
    axis = lone_axis(case.ramp, case.columns_per_step)
    ticks_from: dict[Node, int] = {}
    for distance in range(1, longest + 1):
        path: list[tuple[Node, int]] = []
        node: Node | None = Node(0, False, distance)
        while node is not None and node not in ticks_from:
            place(axis, node, case)
            step = next_step(axis)
            check_step(axis, node, case, step)
            path.append((node, step.ticks))
            node = Node(abs(axis.state), axis.motion == AxisMotion.BRAKING, node.to_go - 1) if axis.counting else None
        total = ticks_from[node] if node is not None else 0
        for passed, ticks in reversed(path):
            total += ticks
            ticks_from[passed] = total
    return [ticks_from[Node(0, False, distance)] for distance in range(1, longest + 1)]


@pytest.mark.parametrize("case", EVERY_DISTANCE, ids=str)
def test_every_distance_is_landed_on_exactly_and_in_the_ticks_foreseen(case: Case) -> None:
    ticks = ticks_of_every_distance(case, LONGEST_STEPS)
    ramp = RAMPS[case.ramp]
    assert ticks == [travel_ticks(ramp, d * case.direction) for d in range(1, LONGEST_STEPS + 1)]


@pytest.mark.parametrize("case", SHORTER, ids=str)
def test_the_same_under_floors_and_with_more_columns_a_step(case: Case) -> None:
    ticks = ticks_of_every_distance(case, 60)
    ramp = RAMPS[case.ramp]
    foreseen = [travel_ticks(ramp, d * case.direction, case.floor, case.columns_per_step) for d in range(1, 61)]
    assert ticks == foreseen


def test_from_eight_steps_on_a_move_of_the_paper_takes_its_steps_and_21_ticks() -> None:
    for way in BOTH_WAYS:
        ticks = ticks_of_every_distance(Case("seven-state", way), LONGEST_STEPS)
        assert ticks[7:] == [distance + 21 for distance in range(8, LONGEST_STEPS + 1)]


@pytest.mark.parametrize("way", BOTH_WAYS)
@pytest.mark.parametrize("columns_per_step", [1, 2, 6])
@pytest.mark.parametrize("distance", INTERVALS)
def test_the_papers_intervals(distance: int, columns_per_step: int, way: int) -> None:
    axis = lone_axis("seven-state", columns_per_step)
    axis.set_target(distance * way, 0)
    waited = [step.ticks for step in steps_to_rest(axis)]
    assert waited == [columns_per_step * interval for interval in INTERVALS[distance]]


@pytest.mark.parametrize("ramp", RAMPS)
def test_whole_moves_tick_by_tick_there_and_back(ramp: str) -> None:
    """The same without placing anything: one axis goes out by each distance and comes back."""
    axis = lone_axis(ramp)
    for distance in (*range(1, 41), 100, 999, 1000, 5000):
        for target in (distance, 0, -distance, 0):
            axis.set_target(target, 0)
            steps = list(steps_to_rest(axis))
            assert (axis.position, axis.state, len(steps)) == (target, 0, distance)
            assert abs(steps[-1].state) <= 1


@pytest.mark.parametrize("invert", [False, True])
def test_columns_are_put_out_in_the_tables_order(invert: bool) -> None:
    axis = lone_axis("seven-state", invert=invert)
    axis.set_target(30, 0)
    columns = []
    while axis.counting:
        next_step(axis)
        columns.append(axis.column)
    backward = [column % 12 for column in range(10, -20, -1)]
    assert columns == (backward if invert else [column % 12 for column in range(30)])


def test_no_move_needs_no_tick() -> None:
    axis = lone_axis("seven-state")
    axis.set_target(0, 0)
    assert not axis.counting


@pytest.mark.long
@pytest.mark.parametrize("way", BOTH_WAYS)
def test_every_distance_tick_by_tick(way: int) -> None:
    """The exhaustive test above once more, each move run whole: some 27 million ticks."""
    for distance in range(1, LONGEST_STEPS + 1):
        axis = lone_axis("seven-state")
        axis.set_target(distance * way, 0)
        ticks = 0
        while axis.counting:
            axis.interrupt()
            ticks += 1
        assert axis.position == distance * way
        assert ticks == (distance + 21 if distance >= 8 else sum(INTERVALS[distance]))
