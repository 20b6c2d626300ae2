"""KMD_POWROT, and the condition in which it is the only command that is taken (docs/SPEC.md, 1.25)."""

from dataclasses import replace
from random import Random

import pytest

from drillctl.kmd import Condition, Fault, Request
from drillctl.machine import Machine
from tests.support.bench import MACHINES, Bench, shipped

DRUM = shipped("boiler-drum")
PROGRAM = "KMD_RUCHd x=90; KMD_RUCHd y=70; KMD_RUCHd y=-70; KMD_RUCHd x=-30; KMD_RUCHd y=40"


def stopped(machine: Machine, request: Request, ticks: int, program: str = PROGRAM) -> Bench:
    """A machine at rest after a request at a tick of a program."""
    b = Bench(machine).ready().queue(program).tick(ticks).ask(request)
    b.finish()
    return b


def home(b: Bench) -> list[int]:
    """Where the axes are after a return to zero: as near to it as their sensors allow."""
    return [axis.up for axis in b.m.axes]


@pytest.mark.parametrize("name", MACHINES)
def test_the_heads_go_back_first_at_the_speed_of_the_machines_file(name: str) -> None:
    machine = replace(shipped(name), return_interval=9)
    b = Bench(machine).ready().queue("KMD_RUCHd x=60; KMD_WIERTLO_DOL").tick(1)
    b.finish()
    assert b.m.fault == Fault.NONE
    b.queue("KMD_POWROT")
    heads = b.m.drill_axes
    while not b.ticker.over() or len(b.ticker.queue):
        b.tick()
        others = [axis for axis in b.m.axes if axis not in heads and axis.counting]
        assert not others or all(axis.position == axis.up for axis in heads), "another axis went before the heads"
        assert all(axis.wait >= 9 for axis in b.m.axes if axis.counting)
    assert (b.positions(), b.m.fault, any(b.ticker.lost_steps())) == (home(b), Fault.NONE, False)


@pytest.mark.parametrize("seed", range(10))
def test_from_every_point_of_a_program(seed: int) -> None:
    b = stopped(DRUM, Random(seed).choice([Request.STOP, Request.ESTOP]), 40 + 70 * seed)
    b.ask(Request.ACK).tick().queue("KMD_POWROT").finish()
    assert (b.positions(), b.m.fault, b.m.condition, b.m.position_known) == ([0, 0], 0, Condition.READY, True)
    assert not any(b.ticker.lost_steps())
    assert [round(b.card.plant.position_steps(axis)) for axis in (0, 1)] == [0, 0]


def test_without_a_known_position_there_is_no_way_back() -> None:
    b = Bench(DRUM).queue("KMD_RUCHd x=4; KMD_POWROT")
    b.finish()
    assert (b.m.fault, b.positions()) == (Fault.HOMING_REQUIRED, [4, 0])


def test_after_an_emergency_stop_everything_else_is_refused_by_name() -> None:
    b = stopped(DRUM, Request.ESTOP, 200)
    places, rate = b.positions(), b.m.tick_hz
    for command in ("KMD_RUCHd x=4", "KMD_INICJALIZACJA", "KMD_FAZY_WYL", "KMD_CZEKAJ 5", "KMD_KONIEC"):
        b.ask(Request.ACK).tick()
        assert (b.m.condition, b.m.fault, b.m.job) == (Condition.ZERO_ONLY, Fault.NONE, False)
        b.queue(command).finish()
        assert (b.m.fault, b.m.position_known, b.positions()) == (Fault.ONLY_ZERO, True, places), command
    b.ask(Request.ACK, Request.HOLD, Request.RESUME).tick()
    assert b.ticker.requests.set_rate(99) and b.ticker.requests.set_output(0, 1)
    b.tick(5)
    assert (b.m.condition, b.m.tick_hz, b.m.position_known, b.m.job) == (Condition.ZERO_ONLY, rate, True, False)
    b.queue("KMD_POWROT; KMD_RUCHd x=4").finish()
    assert (b.m.fault, b.positions()) == (Fault.NONE, [4, 0])


@pytest.mark.parametrize("request_", [Request.STOP, Request.ESTOP, Request.HOLD])
def test_a_return_that_is_cut_short_is_to_be_made_again(request_: Request) -> None:
    b = stopped(DRUM, Request.ESTOP, 700)
    b.ask(Request.ACK).tick().queue("KMD_POWROT").tick(60).ask(request_).tick(400)
    assert b.m.position_known and b.positions() != [0, 0] and not b.m.moving
    b.ask(Request.RESUME if request_ == Request.HOLD else Request.ACK).tick()
    assert (b.m.condition == Condition.ZERO_ONLY) == (request_ != Request.HOLD)
    if request_ != Request.HOLD:
        b.queue("KMD_POWROT")
    b.finish()
    assert (b.positions(), b.m.condition) == ([0, 0], Condition.READY)


def test_a_position_that_is_lost_meanwhile_ends_the_condition() -> None:
    """Without it no return is possible: the machine is to be initialised."""
    b = stopped(replace(DRUM, emergency_stop="hold"), Request.ESTOP, 400)
    assert not b.m.position_known
    b.ask(Request.ACK).tick()
    assert b.m.condition == Condition.READY
    b.queue("KMD_INICJALIZACJA; KMD_RUCHd x=4").finish()
    assert (b.m.fault, b.positions()) == (Fault.NONE, [4, 0])


def test_a_limit_is_left_by_the_return_alone() -> None:
    """Beyond the switch of the large carriage, with the tool out: the tool comes back first, with the line on."""
    sensor = DRUM.sensor_at(0, "max")
    assert sensor is not None
    x, y = DRUM.axes
    b = Bench(replace(DRUM, axes=(replace(x, start_steps=sensor.edge_steps - 100), y))).ready()
    b.queue("KMD_RUCHd y=30; KMD_RUCHd x=250").finish()
    assert (b.m.fault, b.m.position_known) == (Fault.LIMIT, True)
    b.ask(Request.ACK).tick()
    assert b.m.condition == Condition.ZERO_ONLY
    b.queue("KMD_POWROT").finish()
    assert (b.m.fault, b.positions(), any(b.ticker.lost_steps())) == (Fault.NONE, [0, 0], False)
