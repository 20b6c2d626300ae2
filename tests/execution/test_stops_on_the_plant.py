"""Pause, emergency stop and limit at any tick and gear: the rotors are where they are said to be, or are said lost.

Each case is a seed: gear, stop, tick and direction are drawn from it. The drum's drill runs on the dynamic plant where
its motors are described; pcb-drill-ramp-lab, whose motors lose steps without their ramp, always does.
"""

from dataclasses import replace
from functools import cache
from random import Random

import pytest

from drillctl.execution.axis import Axis
from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, interval_ticks
from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import HomingStep, Library, Machine, shipped_tables, travel_ticks
from drillctl.machine.model import FaultReaction, Input
from drillctl.plant.choice import DYNAMIC, IDEAL, PlantChoice
from tests.support.bench import Bench

SETTLED_S = 0.3  # by then a rotor that swings has come to rest
DAILY, LONG = range(16), range(1_000)
COSTLY = (0, 5, 10)  # of the drum, a seed for each stop: a simulated second takes a tenth of one
FASTEST = (13, 14, 15)  # the gears from which a dead stop would lose steps, a seed for each stop
SWITCHES = {"pause": "pause", "emergency_stop": "emergency_stop", "limit": "limits"}


def centred(name: str) -> Machine:
    """A shipped machine that stands in the middle of its travel, and has its zero there."""
    machine = Library((shipped_tables(),)).machine(name)
    half = [axis.high_steps // 2 for axis in machine.axes]
    axes = tuple(
        replace(axis, low_steps=-far, high_steps=far, start_steps=0)
        for axis, far in zip(machine.axes, half, strict=True)
    )
    edges = [far - axis.ramp.top for far, axis in zip(half, axes, strict=True)]
    sensors = tuple(
        replace(sensor, edge_steps=edges[sensor.axis] * (-1 if sensor.end == "min" else 1))
        for sensor in machine.sensors
    )
    return replace(machine, axes=axes, sensors=sensors)


@cache
def drum() -> Machine:
    """The drum's drill as it is shipped."""
    return centred("boiler-drum")


@cache
def lab() -> Machine:
    """The ramp lab's machine with the drum's switches and stops, and zero where it stands."""
    machine = centred("pcb-drill-ramp-lab")
    inputs = (Input("pause", 20, 1, "pause"), Input("emergency_stop", 21, 1, "estop"), Input("limits", 22, 1, "none"))
    sensors = tuple(replace(sensor, bit=22, line="limits") for sensor in machine.sensors)
    return replace(
        machine, inputs=inputs, sensors=sensors, emergency_stop="brake", drill_down_steps=60,
        homing=(HomingStep("zero", (0, 1, 2), "min", 60),), reactions=(FaultReaction("LIMIT", "brake", True),),
        only_zero_after=("LIMIT", "EMERGENCY_STOP"),
    )  # fmt: skip


MACHINES = {"drum": drum, "lab": lab}


class Case:
    """One stop of one machine: ``random`` draws all of it; ``fastest``: but it comes in the middle of a long stroke."""

    def __init__(self, machine: Machine, seed: int, fastest: bool = False):
        self.random = Random(f"{machine.name} {seed}")
        self.swings = all(axis.dynamics for axis in machine.axes)
        self.b = Bench(machine, plant=PlantChoice(DYNAMIC if self.swings else IDEAL, seed=seed).build(machine)).ready()
        gear = seed % len(GEARS_MM_MIN)
        self.axis = self.random.randrange(2)
        table = machine.axes[self.axis]
        own = sorted(set(table.ramp.interval))  # at an interval between them the lab's motors lose steps in any move
        fine = machine.tick_hz == drum().tick_hz
        floor_ticks = interval_ticks(gear, table, machine.tick_hz) if fine else own[gear % len(own)]
        long = self.b.m.axes[self.axis].strokes.ramped_from(1, floor_ticks) + 1
        least = self.random.choice([long if fastest else 2, long])
        steps = self.random.choice([1, -1]) * (least + self.random.randrange(20))
        self.moves = f"KMD_PREDKOSC {floor_ticks}; KMD_RUCHd {table.name}={steps}; KMD_RUCHd {table.name}={-steps}"
        travel = travel_ticks(table.ramp, steps, floor_ticks, table.columns_per_step)
        self.ticks = travel // 2 if fastest else self.random.randrange(travel)

    def begun(self) -> Bench:
        """The moves, up to the tick of the stop; nothing, if they are over by then."""
        self.b.queue(self.moves).tick(self.ticks)
        return self.b

    def press(self, name: str, on: bool = True) -> None:
        """Switches an input."""
        self.b.card.stuck_high = self.b.input_bit(SWITCHES.get(name, name)) if on else 0

    def rest(self) -> Bench:
        """Waits until nothing moves, and the rotors neither."""
        self.b.tick(2)
        self.b.until(lambda: not self.b.m.moving)
        return self.b.tick(round(SETTLED_S * self.b.machine.tick_hz) if self.swings else 1)

    def agree(self) -> bool:
        """Whether every rotor is where the controller has it."""
        return not any(map(round, self.b.ticker.lost_steps()))


def check_stop(machine: Machine, seed: int, fastest: bool = False) -> None:
    """A stop keeps the places true, and from it the machine goes on, or back to zero, to the step."""
    case = Case(machine, seed, fastest)
    b, stop = case.begun(), list(SWITCHES)[seed % 3]
    case.press(stop)
    case.rest()
    m = b.m
    assert m.position_known and case.agree(), f"{machine.name}, seed {seed}: {stop} in tick {case.ticks}: {case.moves}"
    if m.fault:
        assert m.fault == (Fault.LIMIT if stop == "limit" else Fault.EMERGENCY_STOP)
        case.press(stop, stop == "limit")  # the carriage is still on its limit switch
        b.ask(Request.ACK).tick()
        assert m.condition == Condition.ZERO_ONLY
        b.queue("KMD_POWROT").tick()
    else:
        case.press(stop, on=False)
        b.ask(Request.RESUME).tick()
    b.until(b.ticker.over)
    case.rest()
    assert (b.positions()[:2], m.fault, case.agree()) == ([0, 0], Fault.NONE, True), f"{machine.name}, seed {seed}"


def stopped_dead(machine: Machine, seed: int, stop: str) -> tuple[bool, bool]:
    """Whether the position is said to be known after a stop without a ramp, and whether it is true."""
    case = Case(replace(machine, emergency_stop=stop), seed)
    case.begun().ask(Request.ESTOP)
    case.rest()
    return case.b.m.position_known, case.agree()


@pytest.mark.timeout(600)
@pytest.mark.parametrize("name", MACHINES)
def test_after_a_stop_at_any_tick_and_gear_the_places_are_true(name: str) -> None:
    for seed in COSTLY if name == "drum" else DAILY:
        check_stop(MACHINES[name](), seed)


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", MACHINES)
def test_after_a_stop_at_any_tick_and_gear_the_places_are_true_a_thousand_times(name: str) -> None:
    for seed in LONG:
        check_stop(MACHINES[name](), seed)


def test_a_dead_stop_that_loses_steps_says_so() -> None:
    known = [stopped_dead(lab(), seed, "hold") for seed in DAILY]
    assert (True, False) not in known, "a lost position was called known"
    assert {(True, True), (False, True)} <= set(known)
    assert not any(says for says, _ in (stopped_dead(lab(), seed, "drop") for seed in range(3)))


@pytest.mark.timeout(600)
@pytest.mark.parametrize("seed", FASTEST)
def test_at_the_drums_top_speeds_the_ramp_keeps_places_true(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """With braking replaced by a dead stop the same check fails."""
    check_stop(drum(), seed, fastest=True)
    monkeypatch.setattr(Axis, "ramp_down", Axis.stop_now)
    monkeypatch.setattr(Axis, "hold", stop_dead)
    with pytest.raises(AssertionError, match=f"seed {seed}: "):
        check_stop(drum(), seed, fastest=True)


def stop_dead(axis: Axis) -> None:
    """Takes the place of a hold's ramp: all pulses stop in this tick, the target stays."""
    target = axis.target
    axis.stop_now()
    axis.target = target


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", MACHINES)
def test_a_dead_stop_that_loses_steps_says_so_a_thousand_times(name: str) -> None:
    known = [stopped_dead(MACHINES[name](), seed, "hold") for seed in LONG]
    assert (True, False) not in known
    assert (False, True) in known or (False, False) in known, "no stop was from above the starting frequency"
