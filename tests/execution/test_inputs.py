"""Inputs without an axis: pause, stop, emergency stop by a switch; a limit line that all ends share (SPEC 1.23)."""

from dataclasses import replace
from random import Random

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine
from drillctl.machine.model import Input
from drillctl.plant import IdealPlant
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.sampler import signals
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Recorder
from tests.support.bench import Bench, shipped
from tests.support.invariants import Invariants
from tests.support.twins import ran, remembered, trace

DRUM = replace(shipped("boiler-drum"), only_zero_after=())
STOP = Input("stop", 4, 1, "stop")
CLAMP = Input("clamp", 5, 0, "none")
MACHINE = replace(DRUM, inputs=(*DRUM.inputs, STOP, CLAMP))
MOVES = "KMD_RUCHd x=300; KMD_RUCHd y=120; KMD_RUCHd x=-40"
LAST = [260, 120]


def at_work(ticks: int, machine: Machine = MACHINE) -> Bench:
    """A job in mid-course, after so many ticks."""
    return switched(Bench(machine).ready(), clamp=1).queue(MOVES).tick(ticks)


def switched(b: Bench, **levels: int) -> Bench:
    """Sets inputs by name: 1 is on, whatever the level of the wire."""
    for name, on in levels.items():
        line = next(line for line in b.machine.inputs if line.name == name)
        high = on == line.active_level
        b.card.stuck_high = b.card.stuck_high & ~(1 << line.bit) | (high << line.bit)
        b.card.stuck_low = b.card.stuck_low & ~(1 << line.bit) | ((not high) << line.bit)
    return b


def true_places(b: Bench) -> bool:
    """Whether every rotor is where the controller has its axis; zero was taken where a simulation begins."""
    turned = [round(b.card.plant.position_steps(i) - table.start_steps) for i, table in enumerate(b.machine.axes)]
    return not any(b.ticker.lost_steps()) and b.positions() == turned


@pytest.mark.parametrize("ticks", [3, 40, 300, 600])
def test_a_pause_holds_for_as_long_as_it_is_on(ticks: int) -> None:
    b = switched(at_work(ticks), pause=1)
    b.until(lambda: b.m.condition == Condition.HOLDING and not b.m.moving)
    places = b.positions()
    b.ask(Request.RESUME).tick(30)
    assert (b.m.condition, b.positions()) == (Condition.HOLDING, places), "a resume under the switch moved something"
    switched(b, pause=0).tick(5)
    assert b.m.condition == Condition.HOLDING, "to let the switch go is no resume"
    b.ask(Request.RESUME).finish()
    assert (b.positions(), b.m.fault, true_places(b)) == (LAST, Fault.NONE, True)


def test_a_job_that_begins_under_a_pause_makes_no_step() -> None:
    b = switched(at_work(0), pause=1).tick(40)
    assert (b.m.condition, b.positions(), len(b.ticker.queue)) == (Condition.HOLDING, [0, 0], 3)


def test_a_stop_ends_the_job_and_those_that_come_after() -> None:
    b = switched(at_work(300), stop=1)
    b.finish()
    epoch, places = b.m.epoch, b.positions()
    assert (b.m.condition, b.m.position_known, true_places(b)) == (Condition.READY, True, True)
    b.tick(50)
    assert b.m.epoch == epoch, "a machine that has stopped is stopped again"
    b.queue(MOVES).finish()
    b.tick(50)
    assert (b.m.epoch > epoch, b.positions(), b.m.job) == (True, places, False)
    switched(b, stop=0).queue(MOVES).finish()
    assert b.positions() == [place + way for place, way in zip(places, LAST, strict=True)]


def test_an_emergency_stop_is_acknowledged_once_its_switch_is_off() -> None:
    b = switched(at_work(300), emergency_stop=1)
    b.finish()
    for _ in range(2):
        b.ask(Request.ACK).tick()
        b.until(b.latched)
        assert (b.m.fault, b.m.position_known) == (Fault.EMERGENCY_STOP, True)
    switched(b, emergency_stop=0).ask(Request.ACK).tick()
    assert (b.m.condition, b.m.fault) == (Condition.READY, Fault.NONE)


def test_an_emergency_stop_that_comes_while_another_fault_brakes_is_served() -> None:
    b = at_work(300, replace(MACHINE, emergency_stop="drop"))
    b.card.stuck_high |= b.input_bit("limits")
    b.until(lambda: b.m.fault == Fault.LIMIT)
    switched(b, emergency_stop=1).tick()
    assert (b.images[-1], b.m.position_known, b.latched()) == (0, False, True)


def test_an_input_without_an_action_is_only_waited_for() -> None:
    b = switched(Bench(MACHINE).ready(), clamp=0).queue("KMD_CZEKAJ_WE clamp 1 500; KMD_RUCHd x=4").tick(100)
    assert (b.positions(), b.m.fault) == ([0, 0], Fault.NONE)
    switched(b, clamp=1).finish()
    assert (b.positions(), b.m.fault) == ([4, 0], Fault.NONE)


@pytest.mark.parametrize("seed", range(12))
def test_after_a_switch_at_any_tick_the_places_are_true(seed: int) -> None:
    random = Random(seed)
    b = at_work(random.randrange(800))
    check = Invariants(b.m)
    switched(b, **{random.choice(["pause", "stop", "emergency_stop"]): 1})
    b.ticker.run(2_000, check)
    assert not b.m.moving and b.m.position_known and true_places(b)
    assert not any(axis.bits & axis.forcing for axis in b.m.axes)


def near_the_end(axis: int, end: str) -> Bench:
    """The tool was set, and so zero taken, 100 steps before an end of an axis."""
    sensor = DRUM.sensor_at(axis, end)
    assert sensor is not None
    start = sensor.edge_steps + (100 if end == "min" else -100)
    axes = tuple(replace(table, start_steps=start) if i == axis else table for i, table in enumerate(DRUM.axes))
    return Bench(replace(DRUM, axes=axes)).ready()


ENDS = pytest.mark.parametrize(
    ("axis", "end", "way"), [(0, "min", "x=-250"), (0, "max", "x=250"), (1, "min", "y=-250"), (1, "max", "y=250")]
)


def beyond(b: Bench) -> Bench:
    """The work range as the zero has it, which is not that of the machine's file."""
    for axis in b.m.axes:
        axis.low, axis.reach = -1_000, (-1_000, axis.reach[1])
    return b


@ENDS
def test_on_the_shared_line_an_axis_may_only_go_back(axis: int, end: str, way: str) -> None:
    b = beyond(near_the_end(axis, end))
    b.queue(f"KMD_RUCHd {way}").finish()
    assert (b.m.fault, b.m.position_known, true_places(b)) == (Fault.LIMIT, True, True)
    stopped = b.positions()
    b.ask(Request.ACK).tick().queue(f"KMD_RUCHd {way}").finish()
    assert (b.m.fault, b.positions()) == (Fault.LIMIT, stopped), "it went on towards the end"
    other = "xy"[1 - axis]
    b.ask(Request.ACK).tick().queue(f"KMD_RUCHd {other}=20; KMD_RUCHd {other}=-20; KMD_RUCHd {'xy'[axis]}=0").finish()
    assert (b.m.fault, b.positions()) == (Fault.NONE, stopped), "the other axis was not let go"
    back = -stopped[axis]
    b.queue(f"KMD_RUCHd {'xy'[axis]}={back}").finish()
    assert (b.m.fault, b.positions(), b.m.axes[axis].met) == (Fault.NONE, [0, 0], 0)


def test_a_line_that_came_on_at_rest_lets_nothing_move() -> None:
    b = Bench(DRUM).ready()
    b.card.stuck_high = b.input_bit("limits")
    for way in ("x=5", "x=-5", "y=5", "y=-5"):
        b.tick(3).queue(f"KMD_RUCHd {way}").finish()
        assert (b.m.fault, b.positions()) == (Fault.LIMIT, [0, 0])
        b.ask(Request.ACK).tick()


def test_a_line_that_flickers_at_rest_keeps_its_end() -> None:
    b = beyond(near_the_end(0, "max"))
    b.queue("KMD_RUCHd x=250").finish()
    b.ask(Request.ACK).tick()
    b.card.stuck_low = b.input_bit("limits")
    b.tick(3)
    b.card.stuck_low = 0
    b.tick(3).queue("KMD_RUCHd x=5").finish()
    assert b.m.fault == Fault.LIMIT
    b.ask(Request.ACK).tick().queue("KMD_RUCHd x=-50").finish()
    assert b.m.fault == Fault.NONE


def test_both_ends_on_one_line_are_no_contradiction() -> None:
    b = Bench(DRUM).ready().queue(MOVES).tick(300)
    b.card.stuck_high = b.input_bit("limits")
    b.finish()
    assert b.m.fault == Fault.LIMIT


def test_a_head_without_a_line_of_its_own_is_not_raised_to_a_sensor() -> None:
    b = Bench(DRUM).queue("KMD_WIERTLO_GORA")
    b.finish()
    assert b.m.fault == Fault.HOMING_REQUIRED


def test_fast_is_tick_with_inputs() -> None:
    """With requests among them, and an input that is on from the beginning."""
    for active in (0, 1):
        inputs = tuple(replace(line, active_level=active) for line in MACHINE.inputs)
        sensors = tuple(replace(sensor, active_level=active) for sensor in MACHINE.sensors)
        machine = replace(MACHINE, inputs=inputs, sensors=sensors)
        program = Bench(machine).program(f"KMD_INICJALIZACJA; {MOVES}; KMD_CZEKAJ_WE clamp 0 9; {MOVES}")
        keeper = Recorder(signals(machine, IdealPlant.lanes, derived=True))
        fast = FastTicker.ideal(machine, traced=True, keeper=keeper, rotors=True)
        slow = Ticker.simulated(machine, traced=True, derived=True)
        requests = {700: 1 << Request.HOLD, 900: 1 << Request.RESUME}
        ran(slow, program.copy(), requests, 20_000)
        ran(fast, program.copy(), requests, 20_000)
        assert remembered(slow) == remembered(fast)
        assert slow.controller.fault == Fault.NONE and trace(slow) == trace(fast)
