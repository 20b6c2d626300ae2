"""New targets, holds and stops, put in at every state and every phase of the count: the last target is landed on."""

from collections.abc import Callable, Iterator

import pytest

from drillctl.execution.axis import Axis
from drillctl.execution.motion import AxisMotion
from tests.support.axes import RAMPS, lone_axis, next_step, steps_to_rest

# Through every state and down again.
MOVE_STEPS = {"seven-state": 12, "even-steps": 20, "whole-strokes": 20, "drive-servo": 24}
PLACES = ("ahead", "passed", "behind", "equal")
HELD_TICKS = (0, 1, 2, 5, 9, 30, 200)
EVERY_RAMP_BOTH_WAYS = pytest.mark.parametrize("way", [1, -1]), pytest.mark.parametrize("ramp", RAMPS)
COLUMNS = pytest.mark.parametrize("columns_per_step", [1, 2, 6])


def both_ways(test: Callable[..., None]) -> Callable[..., None]:
    for mark in EVERY_RAMP_BOTH_WAYS:
        test = mark(test)
    return test


def started(ramp: str, way: int, columns_per_step: int = 1) -> Axis:
    axis = lone_axis(ramp, columns_per_step)
    axis.set_target(MOVE_STEPS[ramp] * way, 0)
    return axis


def moves_cut_at_every_tick(ramp: str, way: int, columns_per_step: int = 1) -> Iterator[Axis]:
    """The same move again and again, each time left after one tick more: every state, every phase of its count."""
    ticks = 0
    while True:
        axis = started(ramp, way, columns_per_step)
        for _ in range(ticks):
            axis.interrupt()
        if not axis.counting:
            return
        yield axis
        ticks += 1


def check_to_rest(axis: Axis) -> None:
    """States go one at a time, the sign is the direction's, and the axis stops from state 0 or 1, on its target."""
    last = None
    for step in steps_to_rest(axis):
        assert abs(step.after - step.state) <= 1
        assert step.after * step.direction >= 0
        last = step
    assert axis.position == axis.target
    assert axis.state == axis.column_in_step == 0
    assert last is None or abs(last.state) <= 1


def new_targets(axis: Axis, way: int) -> dict[str, list[int]]:
    """By kind: where a new target may lie as seen from an axis in motion."""
    here, ahead = axis.position, axis.target
    return {
        "ahead": [here + way * distance for distance in (1, 2, 3, 4, 5, 8, 30)],
        "passed": [here - way * distance for distance in (1, 2, 3)],
        "behind": [here - way * distance for distance in (8, 30)],
        "equal": [here, ahead],
    }


@both_ways
@pytest.mark.parametrize("place", PLACES)
def test_a_new_target_at_every_tick_of_a_move(ramp: str, way: int, place: str) -> None:
    kinds = len(new_targets(started(ramp, way), way)[place])
    for choice in range(kinds):
        for axis in moves_cut_at_every_tick(ramp, way):
            target = new_targets(axis, way)[place][choice]
            axis.set_target(target, 0)
            check_to_rest(axis)
            assert axis.position == target


@COLUMNS
def test_a_new_target_between_the_columns_of_a_step(columns_per_step: int) -> None:
    for target in (-5, -1, 0, 1, 3, 20):
        for axis in moves_cut_at_every_tick("seven-state", 1, columns_per_step):
            axis.set_target(target, 0)
            check_to_rest(axis)
            assert axis.position == target


@both_ways
def test_two_new_targets_one_after_the_other(ramp: str, way: int) -> None:
    """The second comes while the axis brakes for, waits at, or comes back from the first."""
    for wait in range(0, 40, 3):
        for axis in moves_cut_at_every_tick(ramp, way):
            axis.set_target(axis.position - way * 4, 0)
            for _ in range(wait):
                if axis.counting:
                    axis.interrupt()
            axis.set_target(way * 9, 0)
            check_to_rest(axis)
            assert axis.position == way * 9


@both_ways
@pytest.mark.parametrize("held_ticks", HELD_TICKS)
def test_a_hold_at_every_tick_loses_nothing(ramp: str, way: int, held_ticks: int) -> None:
    for axis in moves_cut_at_every_tick(ramp, way):
        target, last_state = axis.target, axis.state
        axis.hold()
        for _ in range(held_ticks):
            if axis.counting:
                axis.interrupt()
                assert abs(axis.state) <= abs(last_state), "accelerated while held"
                last_state = axis.state
        axis.resume()
        check_to_rest(axis)
        assert axis.position == target


@both_ways
def test_a_hold_takes_one_state_off_after_each_step(ramp: str, way: int) -> None:
    for axis in moves_cut_at_every_tick(ramp, way):
        state = abs(axis.state)
        axis.hold()
        assert [abs(step.after) for step in steps_to_rest(axis)] == list(range(state - 1, -1, -1))
        assert axis.target == MOVE_STEPS[ramp] * way


@COLUMNS
def test_a_hold_between_the_columns_of_a_step_ends_on_a_whole_step(columns_per_step: int) -> None:
    for axis in moves_cut_at_every_tick("seven-state", 1, columns_per_step):
        axis.hold()
        list(steps_to_rest(axis))
        assert axis.column_in_step == 0
        assert axis.travelled == axis.position * columns_per_step
        axis.resume()
        check_to_rest(axis)


@both_ways
def test_giving_up_at_every_tick_makes_the_resting_place_the_target(ramp: str, way: int) -> None:
    for axis in moves_cut_at_every_tick(ramp, way):
        state, position = abs(axis.state), axis.position
        axis.ramp_down()
        list(steps_to_rest(axis))
        assert axis.position == axis.target == position + way * state
        axis.set_target(0, 0)
        check_to_rest(axis)
        assert axis.position == 0


def test_a_new_target_in_state_0_restarts_the_count() -> None:
    axis = started("seven-state", 1)
    for _ in range(5):
        axis.interrupt()
    axis.set_target(3, 0)
    assert next_step(axis).ticks == 7


def test_a_new_target_in_motion_keeps_the_count() -> None:
    axis = started("seven-state", 1)
    for _ in range(7 + 2):
        axis.interrupt()
    axis.set_target(3, 0)
    assert next_step(axis).ticks == 4 - 2


def test_counting_starts_anew_when_a_hold_in_state_0_is_lifted() -> None:
    axis = started("seven-state", 1)
    for _ in range(5):
        axis.interrupt()
    axis.hold()
    assert not axis.counting
    axis.resume()
    assert next_step(axis).ticks == 7


def test_a_new_target_lifts_the_ban_on_accelerating() -> None:
    axis = started("seven-state", 1)
    while axis.motion != AxisMotion.BRAKING:
        next_step(axis)
    state = axis.state
    axis.set_target(axis.position + 50, 0)
    next_step(axis)
    assert axis.state == state + 1


def test_a_resume_lifts_the_ban_on_accelerating() -> None:
    axis = started("seven-state", 1)
    while axis.state < 3:
        next_step(axis)
    axis.hold()
    next_step(axis)
    axis.resume()
    assert next_step(axis).after == 3


@pytest.mark.parametrize("floor", [2, 4, 7, 20])
def test_a_new_target_under_another_floor_in_motion(floor: int) -> None:
    for axis in moves_cut_at_every_tick("seven-state", 1):
        axis.set_target(-6, floor)
        check_to_rest(axis)
        assert axis.position == -6


def test_waiting_in_state_0_in_mid_move_keeps_the_forcing_bits() -> None:
    waits_with_forcing = 0
    for axis in moves_cut_at_every_tick("seven-state", 1):
        axis.set_target(axis.position - 5, 0)
        while axis.direction > 0 and axis.counting:
            next_step(axis)
        hot = axis.bits
        waits_with_forcing += hot != axis.hold_bits
        for _ in range(6):
            axis.interrupt()
            assert (axis.bits, axis.counting) == (hot, True)
    assert waits_with_forcing > 0
