"""Linked axes: both ends exact, every follower within half a step of the ideal line (docs/SPEC.md, 3)."""

from collections.abc import Iterator
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.execution.axis import Axis
from drillctl.execution.line import Line
from drillctl.kmd import Fault, Request
from drillctl.machine import travel_ticks
from drillctl.machine.drive_ramp import drive_ramp
from drillctl.machine.parameters import ParameterRow
from tests.support.bench import Bench, shipped

REACHES = (0, 1, 2, 3, 5, 7, 8, 13, 30, 59)
SIGNS = ((1, 1), (1, -1), (-1, 1), (-1, -1))
LINE = "KMD_LINIAd x=60 y=-37 z=11"
LONGEST_JOB_TICKS = 10_000


def line_points(b: Bench, text: str) -> Iterator[list[int]]:
    """Positions after each step of any axis, from the start on."""
    yield from points_of_job(b.queue(text))


def points_of_job(b: Bench, hold_at: int = 0, held_ticks: int = 0) -> Iterator[list[int]]:
    """Positions after each step of any axis, from now on to the end of the job, with one hold at that tick."""
    last = b.positions()
    yield last
    for tick in range(LONGEST_JOB_TICKS):
        if held_ticks and tick == hold_at:
            b.ask(Request.HOLD)
        if held_ticks and tick == hold_at + held_ticks:
            b.ask(Request.RESUME)
        b.tick()
        if b.positions() != last:
            last = b.positions()
            yield last
        if b.ticker.over():
            return
    raise AssertionError("the job does not end")


def check_points(points: list[list[int]], reach: tuple[int, ...]) -> None:
    """One point a leader's step, and each follower nowhere more than half a step off."""
    farthest = max(abs(steps) for steps in reach)
    start = points[0]
    assert len(points) == farthest + 1
    for leader_steps, point in enumerate(points):
        for axis, steps in enumerate(reach):
            twice_off = abs(2 * (point[axis] - start[axis]) * farthest - 2 * steps * leader_steps)
            assert twice_off <= farthest, f"axis {axis} is off the line after {leader_steps} steps"


@pytest.mark.parametrize("signs", SIGNS)
def test_all_slopes_of_a_grid(signs: tuple[int, int]) -> None:
    b = Bench(shipped("pcb-drill"))
    for dx in REACHES:
        for dy in REACHES:
            reach = (dx * signs[0], dy * signs[1], 0)
            check_points(list(line_points(b, f"KMD_LINIAd x={reach[0]} y={reach[1]}")), reach)
            assert b.positions() == list(reach)
            b.queue(f"KMD_RUCHd x={-reach[0]} y={-reach[1]}")
            b.finish()
            assert not any(b.ticker.lost_steps())


@pytest.mark.parametrize("reach", [(60, -37, 11), (-11, 60, 60), (1, 2, 3), (9, 9, 9)])
@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis"])
def test_three_axes_on_one_line(name: str, reach: tuple[int, int, int]) -> None:
    machine = shipped(name)
    third = machine.axis_names[2]
    b = Bench(machine)
    points = list(line_points(b, f"KMD_LINIAd x={reach[0]} y={reach[1]} {third}={reach[2]}"))
    check_points(points, reach)
    assert not any(b.ticker.lost_steps())


@pytest.mark.parametrize("floor", [0, 3, 20])
def test_a_line_takes_its_leaders_time(floor: int) -> None:
    b = Bench(shipped("pcb-drill")).queue(f"KMD_PREDKOSC {floor}; KMD_LINIAd x=7 y=40")
    assert b.done_at(2) == travel_ticks(b.machine.axes[1].ramp, 40, floor)


@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis"])
@pytest.mark.parametrize("held_ticks", [1, 8, 100])
def test_a_hold_anywhere_on_a_line_stays_on_it(name: str, held_ticks: int) -> None:
    machine = shipped(name)
    text = LINE.replace("z", machine.axis_names[2])
    whole = Bench(machine).queue(text).finish()
    for start in range(1, whole, max(1, whole // 40)):
        b = Bench(machine).queue(text)
        check_points(list(points_of_job(b, start, held_ticks)), (60, -37, 11))
        assert b.positions()[:3] == [60, -37, 11]
        assert not any(b.ticker.lost_steps())


@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis"])
def test_a_stop_anywhere_on_a_line_leaves_it_on_the_line_and_free(name: str) -> None:
    machine = shipped(name)
    text = LINE.replace("z", machine.axis_names[2])
    whole = Bench(machine).queue(text).finish()
    for start in range(1, whole, max(1, whole // 60)):
        b = Bench(machine).queue(text).tick(start).ask(Request.STOP)
        b.finish()
        x, y, z = b.positions()[:3]
        assert abs(2 * (y * 60 + 37 * x)) <= 60
        assert abs(2 * (z * 60 - 11 * x)) <= 60
        assert not any(b.ticker.lost_steps())
        b.queue(f"KMD_RUCHd x=3 y=5 {machine.axis_names[2]}=4")
        b.finish()
        assert b.positions()[:3] == [x + 3, y + 5, z + 4]


@pytest.mark.parametrize("start", [1, 7, 20, 50, 70])
def test_an_emergency_stop_on_a_line_ends_the_line(start: int) -> None:
    machine = replace(shipped("boiler-drum"), emergency_stop="hold", only_zero_after=())
    b = Bench(machine).ready().queue("KMD_LINIA x=60 y=37").tick(start)
    b.ask(Request.ESTOP).tick().ask(Request.ACK).tick()
    assert not any(axis.follows or axis.followers for axis in b.m.axes)
    homing = "" if b.m.position_known else "KMD_INICJALIZACJA;"
    b.queue(f"{homing}KMD_LINIA x=5 y=60; KMD_RUCH x=0 y=0")
    b.finish()
    assert (b.m.fault, b.positions()) == (Fault.NONE, [0, 0])


def test_lines_of_unequal_columns_a_step_are_refused_before_anything_moves() -> None:
    machine = shipped("pcb-drill")
    x, y, z = machine.axes
    b = Bench(replace(machine, axes=(x, replace(y, columns_per_step=2), z))).queue("KMD_LINIAd z=1 x=10 y=10")
    b.finish()
    assert (b.m.fault, b.positions()) == (Fault.LINE_MISMATCH, [0, 0, 0])
    assert [axis.target for axis in b.m.axes] == [0, 0, 0]


@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_no_follower_passes_its_own_speed_or_acceleration(data: st.DataObject) -> None:
    """Different drives: by the leader's intervals each follower, with its share of the way, is no faster than by
    its own greatest speed, and gains it no faster than by its own first step.
    """
    kinds = [(2400.0, 3_600_000.0), (1200.0, 3_600_000.0), (2400.0, 720_000.0), (600.0, 18_000_000.0)]
    tables = []
    for table in shipped("eight-axis").axes[:3]:
        speed, acceleration = data.draw(st.sampled_from(kinds))
        row = (("greatest_speed_mm_min", speed), ("acceleration_mm_min2", acceleration), ("s_share", 0.0),
               ("pulse_equivalent_mm", 0.01), ("gear_numerator", 1), ("gear_denominator", 1))  # fmt: skip
        tables.append(replace(table, ramp=drive_ramp(ParameterRow(row), 8000, 2)))
    line = Line(tuple(Axis(table, (0, 0, 0)) for table in tables))
    reach = data.draw(st.tuples(*[st.integers(-3000, 3000)] * 3).filter(any))
    for axis, steps in zip(line.axes, reach, strict=True):
        axis.target = steps
    leader = max(line.axes, key=lambda axis: abs(axis.target))
    own = leader.ramp_tables()
    line.start(leader, 0b111, 0)
    cruise = max(leader.interval[leader.ramp.top], leader.min_interval)
    for table, steps in zip(tables, reach, strict=True):
        ramp, share = table.ramp, abs(steps / leader.target)
        assert share / cruise <= 1 / ramp.interval[ramp.top] + 1e-12
        assert share / leader.interval[0] ** 2 <= 1 / ramp.interval[0] ** 2 + 1e-12
    while leader.counting:
        leader.interrupt()
    assert [axis.position for axis in line.axes] == list(reach)
    assert leader.ramp_tables() == own, "its own ramp again"
