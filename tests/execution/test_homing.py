"""Initialisation by the machine's table: head up, off the sensors, to them, slowly off again (docs/SPEC.md, 1.11)."""

from dataclasses import replace

import pytest

from drillctl.kmd import Fault, Request
from drillctl.machine import Machine
from tests.support.bench import MACHINES, Bench, shipped

STARTS = (-10, -6, -5, -4, -1, 0, 1, 4, 5, 6, 59, 60, 61, 1200)


def found_at(name: str, start_steps: int) -> Machine:
    """The machine with X and Y switched on elsewhere."""
    machine = shipped(name)
    x, y, *heads = machine.axes
    moved = (replace(x, start_steps=start_steps), replace(y, start_steps=start_steps), *heads)
    return replace(machine, axes=moved)


@pytest.mark.parametrize("start_steps", STARTS)
@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab", "eight-axis"])
def test_zero_is_the_same_place_wherever_the_machine_was_found(name: str, start_steps: int) -> None:
    b = Bench(found_at(name, start_steps)).queue("KMD_INICJALIZACJA")
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.NONE, True)
    assert b.positions()[:2] == [0, 0]
    rest_steps = 3 / b.machine.axes[0].columns_per_step  # the rotor rests every third column
    for axis in (0, 1):
        sensor = b.machine.sensor_at(axis, "min")
        assert sensor is not None
        index = b.machine.index_of(axis)
        let_go = index.at_steps if index else sensor.edge_steps + sensor.hysteresis_steps
        assert let_go <= b.card.plant.position_steps(axis) <= let_go + max(1, rest_steps)
    assert not any(b.ticker.lost_steps())


@pytest.mark.parametrize("name", MACHINES)
def test_it_can_be_done_again_and_ends_where_it_began(name: str) -> None:
    b = Bench(shipped(name)).queue("KMD_INICJALIZACJA; KMD_RUCH x=90 y=70")
    b.finish()
    before = [b.card.plant.position_steps(axis) for axis in (0, 1)]
    b.queue("KMD_INICJALIZACJA; KMD_RUCH x=90 y=70")
    b.finish()
    if b.m.homes_by_sensor:
        assert [b.card.plant.position_steps(axis) for axis in (0, 1)] == pytest.approx(before, abs=3)
    assert b.positions()[:2] == [90, 70]


def test_the_head_is_up_before_anything_else_moves() -> None:
    b = Bench(shipped("pcb-drill")).ready().queue("KMD_GOTO_X_Y 300 300; KMD_WIERTLO_DOL")
    b.finish()
    b.queue("KMD_INICJALIZACJA")
    made = [axis.made for axis in b.m.axes]
    b.until(lambda: [axis.made for axis in b.m.axes[:2]] != made[:2])
    assert b.card.plant.inputs & b.input_bit("z_top")
    assert not b.m.axes[2].counting


def test_the_last_stretch_is_no_faster_than_state_1() -> None:
    b = Bench(shipped("pcb-drill")).queue("KMD_INICJALIZACJA")
    b.until(lambda: b.m.homing_row == 4)
    x = b.m.axes[0]
    states = set()

    def watched() -> bool:
        states.add(x.state)
        return b.ticker.over()

    b.until(watched)
    assert states == {0, 1}


def test_the_position_is_unknown_until_the_end_and_the_base_is_zero_then() -> None:
    b = Bench(shipped("pcb-drill")).ready().queue("KMD_GOTO_X_Y 30 30; KMD_BAZA; KMD_INICJALIZACJA")
    b.until(lambda: b.m.axes[0].base == 30)
    b.tick()
    assert not b.m.position_known
    b.finish()
    assert b.m.position_known
    assert b.m.axes[0].base == 0


@pytest.mark.parametrize(
    ("sensor", "stuck"),
    [("x_min", "stuck_low"), ("y_min", "stuck_low"), ("x_min", "stuck_high"), ("y_min", "stuck_high")],
)
def test_a_sensor_that_never_answers_or_never_lets_go(sensor: str, stuck: str) -> None:
    b = Bench(shipped("pcb-drill-ramp-lab")).queue("KMD_INICJALIZACJA")
    setattr(b.card, stuck, b.input_bit(sensor))
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.HOMING_NOT_FOUND, False)


def test_a_head_that_does_not_come_up_ends_it_before_the_board_moves() -> None:
    b = Bench(shipped("pcb-drill")).ready().queue("KMD_GOTO_X_Y 50 50; KMD_WIERTLO_DOL")
    b.finish()
    b.card.stuck_low = b.input_bit("z_top")
    b.queue("KMD_INICJALIZACJA")
    b.finish()
    assert (b.m.fault, b.m.position_known) == (Fault.HEAD_NOT_UP, False)
    assert b.positions()[:2] == [50, 50]


def test_the_search_ends_a_tenth_beyond_the_range() -> None:
    b = Bench(shipped("pcb-drill-ramp-lab")).queue("KMD_INICJALIZACJA")
    b.card.stuck_low = b.input_bit("x_min")
    b.finish()
    span = b.machine.axes[0].span_steps
    assert b.m.axes[0].made == span + span // 10


def test_getting_off_the_sensor_ends_at_its_limit_of_steps() -> None:
    b = Bench(shipped("pcb-drill")).queue("KMD_INICJALIZACJA")
    b.card.stuck_high = b.input_bit("x_min")
    b.finish()
    assert b.m.axes[0].made == 60


@pytest.mark.parametrize("start", [3, 40, 900, 1400, 1500])
def test_a_hold_during_the_search_loses_nothing(start: int) -> None:
    b = Bench(shipped("pcb-drill")).queue("KMD_INICJALIZACJA; KMD_GOTO_X_Y 6 6").tick(start)
    b.ask(Request.HOLD).tick(60).ask(Request.RESUME)
    b.finish()
    assert (b.m.fault, b.positions()[:2]) == (Fault.NONE, [6, 6])
    assert [b.card.plant.position_steps(axis) for axis in (0, 1)] == pytest.approx([6, 6], abs=3)
