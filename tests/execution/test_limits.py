"""What keeps the machine inside itself: targets, sensors, counts, each without the others (docs/SPEC.md, 1.4, 1.9)."""

from dataclasses import replace

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine
from tests.support.bench import Bench, shipped

X_LOW, X_HIGH, X_SPAN = -10, 16535, 16545
X_REACH = 16528  # the last step before the far limit sensor answers


def bench() -> Bench:
    return Bench(shipped("pcb-drill"))


def refusal(b: Bench, text: str) -> Fault:
    """The fault with which a command is refused: at once, in its own tick, and nothing has moved."""
    places = b.positions()
    b.queue(text)
    b.until(lambda: b.m.condition == Condition.LATCHED or b.m.moving > 0 or not b.m.job)
    assert b.positions() == places
    return Fault(b.m.fault)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (f"KMD_RUCH x={X_LOW}", Fault.SOFT_LIMIT),
        ("KMD_RUCH x=-1", Fault.SOFT_LIMIT),
        ("KMD_RUCH x=0", Fault.NONE),
        (f"KMD_RUCH x={X_REACH}", Fault.NONE),
        (f"KMD_RUCH x={X_REACH + 1}", Fault.SOFT_LIMIT),
        (f"KMD_RUCHd x={X_REACH + 1}", Fault.SOFT_LIMIT),
        (f"KMD_LINIA x={X_REACH + 1} y=5", Fault.SOFT_LIMIT),
        ("KMD_RUCHd x=5 y=5 z=790", Fault.SOFT_LIMIT),
        (f"KMD_RUCH x={X_HIGH}", Fault.SOFT_LIMIT),
        (f"KMD_RUCHd x={X_HIGH + 1}", Fault.SOFT_LIMIT),
        ("KMD_GOTO_X_Y 5 99999", Fault.SOFT_LIMIT),
        ("KMD_LINIA x=5 y=99999", Fault.SOFT_LIMIT),
        ("KMD_RUCH x=5 y=5 z=826", Fault.SOFT_LIMIT),
    ],
)
def test_targets_are_checked_when_popped_and_all_before_any_axis_starts(text: str, fault: Fault) -> None:
    b = bench().ready()
    assert refusal(b, text) == fault
    assert b.m.position_known


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("KMD_GOTO_X_Y 0 0", Fault.HOMING_REQUIRED),
        ("KMD_RUCH z=1", Fault.HOMING_REQUIRED),
        ("KMD_LINIA x=1 y=1", Fault.HOMING_REQUIRED),
        (f"KMD_RUCHd x={X_SPAN}", Fault.NONE),
        (f"KMD_RUCHd x=-{X_SPAN}", Fault.NONE),
        (f"KMD_RUCHd x={X_SPAN + 1}", Fault.SOFT_LIMIT),
        (f"KMD_LINIAd x=-{X_SPAN + 1} y=1", Fault.SOFT_LIMIT),
    ],
)
def test_before_homing_only_moves_from_here_within_the_travel(text: str, fault: Fault) -> None:
    assert refusal(bench(), text) == fault


def test_from_beyond_its_reach_an_axis_is_sent_towards_it_and_no_farther() -> None:
    """Initialised, the head stands at 0, where its upper sensor holds; 12 is the first step that it is sent to."""
    b = bench().ready()
    for text, place in (("KMD_RUCHd z=1", 1), ("KMD_RUCH z=1", 1), ("KMD_RUCH z=100", 100), ("KMD_RUCH z=12", 12)):
        b.queue(text).finish()
        assert (b.m.fault, b.positions()[2]) == (Fault.NONE, place)
    for text in ("KMD_RUCH z=11", "KMD_RUCH z=0", "KMD_RUCHd z=-1", "KMD_LINIA x=3 z=0", "KMD_RUCHd x=1 z=-12"):
        assert refusal(b, text) == Fault.SOFT_LIMIT
        assert b.m.position_known
        b.ask(Request.ACK).tick()


@pytest.mark.parametrize("form", ["KMD_RUCHd x={}", "KMD_GOTOdXdY {} 0", "KMD_LINIAd x={} y=1"])
@pytest.mark.parametrize(
    ("ways", "fault"),
    [
        ((6000, 6000, 6000), Fault.SOFT_LIMIT),
        ((-6000, -6000, -6000), Fault.SOFT_LIMIT),
        ((6000, -6000, 6000, -6000), Fault.NONE),
        ((-6000, X_SPAN - 1, -X_SPAN), Fault.NONE),
        ((6000, -12000, -6000), Fault.SOFT_LIMIT),
    ],
)
def test_moves_from_an_unknown_place_are_within_the_travel_all_together(
    form: str, ways: tuple[int, ...], fault: Fault
) -> None:
    """Whichever way and in whatever command: no travel holds what is farther apart than it is long."""
    b = Bench(without_limits())
    for way in ways[:-1]:
        b.queue(form.format(way)).finish()
        assert b.m.fault == Fault.NONE
    assert refusal(b, form.format(ways[-1])) == fault


def test_the_sum_begins_anew_where_the_phases_were_off() -> None:
    b = Bench(without_limits())
    for end in ("KMD_FAZY_WYL x", "KMD_FAZY_WYL", "KMD_CZEKAJ 1"):
        b.queue(f"KMD_RUCHd x=10000; {end}").finish()
        assert b.m.fault == Fault.NONE
    b.ask(Request.ESTOP).tick().ask(Request.ACK).tick()
    b.queue("KMD_RUCHd x=10000").finish()
    assert b.m.fault == Fault.NONE
    assert refusal(b, "KMD_RUCHd x=10000") == Fault.SOFT_LIMIT


def test_what_was_moved_before_a_stop_counts_and_what_was_not_does_not() -> None:
    b = Bench(without_limits()).queue(f"KMD_RUCHd x={X_SPAN}").tick(200).ask(Request.STOP)
    b.finish()
    there = b.positions()[0]
    assert 0 < there < 220
    assert refusal(b, f"KMD_RUCHd x={X_SPAN - there + 1}") == Fault.SOFT_LIMIT
    b.ask(Request.ACK).tick()
    assert refusal(b, f"KMD_RUCHd x={X_SPAN - there}") == Fault.NONE


def test_a_head_that_does_not_find_its_sensor_does_not_look_farther_each_time() -> None:
    b = bench()
    b.card.stuck_low = b.input_bit("z_bottom")
    made = []
    for _ in range(3):
        b.queue("KMD_WIERTLO_DOL").finish()
        assert b.m.fault == Fault.DRILL_NOT_DOWN
        made.append(b.m.axes[2].made)
        b.ask(Request.ACK).tick()
    assert made == [b.m.axes[2].span] * 3


def without_limits() -> Machine:
    """Where only the sum of all moves says how far an axis may go."""
    plain = shipped("pcb-drill")
    states = len(plain.axes[0].ramp.interval)
    quick = [replace(axis, ramp=replace(axis.ramp, interval=(2, *[1] * (states - 1)))) for axis in plain.axes]
    return replace(plain, sensors=(), homing=(), axes=tuple(quick))


@pytest.mark.parametrize("name", ["boiler-drum", "eight-axis"])
def test_a_head_is_fed_by_a_distance_where_the_machine_gives_one(name: str) -> None:
    """Whether or not that end of the axis has a limit sensor. A distance is from zero, so zero must be known."""
    assert refusal(Bench(shipped(name)), "KMD_WIERTLO_DOL") == Fault.HOMING_REQUIRED
    b = Bench(shipped(name)).ready().queue("KMD_WIERTLO_DOL")
    b.finish()
    heads = [b.positions()[axis] for axis in b.machine.drill_axes]
    assert (b.m.fault, set(heads)) == (Fault.NONE, {b.machine.drill_down_steps})


def test_targets_are_meant_from_the_working_base_and_checked_from_zero() -> None:
    b = bench().ready().queue("KMD_GOTO_X_Y 100 50; KMD_BAZA; KMD_GOTO_X_Y 5 -7")
    b.finish()
    assert b.positions()[:2] == [105, 43]
    b.queue("KMD_GOTO_X_Y -111 0")
    b.finish()
    assert (b.m.fault, b.positions()[:2]) == (Fault.SOFT_LIMIT, [105, 43])


def test_a_limit_ahead_brakes_and_loses_the_position() -> None:
    b = bench().ready().queue("KMD_RUCH x=500").tick(100)
    assert b.m.axes[0].state == 3
    at = b.positions()[0]
    b.card.stuck_high = b.input_bit("x_max")
    b.finish()
    assert (b.m.fault, b.positions()[0]) == (Fault.LIMIT, at + 3)
    assert not b.m.position_known
    assert not any(b.ticker.lost_steps())


def test_a_limit_sensor_is_met_for_real_before_homing() -> None:
    """From the place where the machine was found the far sensor lies nearer than the whole travel."""
    b = bench().queue("KMD_RUCHd y=11500")
    b.finish()
    assert b.m.fault == Fault.LIMIT
    edge = b.machine.sensor_at(1, "max")
    assert edge is not None
    assert b.card.plant.position_steps(1) == pytest.approx(edge.edge_steps + 3, abs=3)  # it rests every third column


def test_from_an_active_limit_one_may_move_away_and_no_step_further() -> None:
    b = bench().queue("KMD_RUCHd y=11500")
    b.finish()
    y = b.m.axes[1]
    b.ask(Request.ACK).tick().queue("KMD_RUCHd y=2")
    made = y.made
    b.finish()
    assert (b.m.fault, y.made) == (Fault.LIMIT, made)
    b.ask(Request.ACK).tick().queue("KMD_RUCHd y=-400")
    b.finish()
    assert (b.m.fault, y.made) == (Fault.NONE, made + 400)


@pytest.mark.parametrize("line", ["KMD_LINIAd x=9 y=0", "KMD_LINIAd x=9 y=-3", "KMD_RUCHd x=9 y=0"])
def test_an_axis_that_stays_or_leaves_is_not_stopped_by_its_limit(line: str) -> None:
    b = bench().ready()
    b.card.stuck_high = b.input_bit("y_max")
    b.m.axes[1].reach = (-3, 11804)
    b.queue(f"KMD_RUCHd x=50 y=0; {line}")
    b.finish()
    assert b.m.fault == Fault.NONE
    assert b.positions()[0] == 59


def test_a_linked_axis_that_runs_into_its_limit_stops_the_line() -> None:
    b = bench().ready().queue("KMD_LINIA x=300 y=200").tick(80)
    b.card.stuck_high = b.input_bit("y_max")
    x, y = b.positions()[:2]
    b.finish()
    assert b.m.fault == Fault.LIMIT
    assert b.positions()[0] == x + 3
    assert y <= b.positions()[1] <= y + 3


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_both_ends_at_once_drop_the_machine_moving_or_not(axis: str) -> None:
    ends = {"x": ("x_min", "x_max"), "y": ("y_min", "y_max"), "z": ("z_top", "z_bottom")}[axis]
    b = bench().ready().queue("KMD_CZEKAJ 100").tick(10)
    b.card.stuck_high = b.input_bit(ends[0]) | b.input_bit(ends[1])
    b.tick()
    assert (b.m.fault, b.images[-1], b.latched()) == (Fault.SENSOR_CONTRADICTION, 0, True)


@pytest.mark.parametrize("place", [X_LOW - 1, X_HIGH + 1, 10**6])
def test_a_wrong_count_is_caught_although_the_target_was_allowed(place: int) -> None:
    b = bench().ready().queue("KMD_GOTO_X_Y 300 200").tick(60)
    b.m.axes[0].position = place
    b.tick()
    assert b.m.fault == Fault.RANGE


def test_counts_are_not_judged_while_the_position_is_unknown() -> None:
    b = bench().queue("KMD_RUCHd x=30").tick(20)
    b.m.axes[0].position = b.m.axes[0].target - 5
    b.m.axes[0].low = b.m.axes[0].high = 0
    b.finish()
    assert b.m.fault == Fault.NONE


def test_with_its_sensor_dead_the_count_alone_stops_the_head_inside_the_range() -> None:
    b = bench().ready()
    b.card.stuck_low = b.input_bit("z_bottom")
    b.queue("KMD_WIERTLO_DOL")
    deepest = 0

    def watched() -> bool:
        nonlocal deepest
        deepest = max(deepest, b.positions()[2])
        return b.ticker.over()

    b.until(watched)
    assert (b.m.fault, deepest) == (Fault.DRILL_NOT_DOWN, b.machine.axes[2].high_steps)


def test_the_drilling_time_ends_in_its_tick() -> None:
    b = bench().ready().queue("KMD_PREDKOSC 20; KMD_WIERTLO_DOL").tick(1)
    started = b.m.tick
    b.until(lambda: b.m.fault != Fault.NONE)
    assert b.m.fault == Fault.DRILLING_TIME
    assert b.m.tick - started == b.machine.longest_drilling_ticks + 1


@pytest.mark.parametrize("timeout", [1, 2, 20])
def test_a_wait_for_an_input_ends_in_its_last_tick(timeout: int) -> None:
    b = bench().queue(f"KMD_CZEKAJ_WE x_max 1 {timeout}")
    assert b.until(lambda: b.m.fault == Fault.INPUT_TIMEOUT) == timeout
