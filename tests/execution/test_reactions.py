"""What a machine's file sets of a fault: its reaction, the position kept or lost, the emergency stop that brakes."""

from dataclasses import replace

import pytest

from drillctl.kmd import FAULTS, Condition, Fault, Request
from drillctl.kmd.faults import Reaction, reactions_of
from drillctl.machine.model import FaultReaction
from drillctl.machine.reactions import FAULT_NAMES, FIXED, NOT_KEPT
from tests.support.bench import Bench, shipped

PCB = shipped("pcb-drill")
LONG_WAIT = "KMD_GOTOdXdY 400 200"


def limit_at_speed(do: str, kept: bool) -> Bench:
    """A limit sensor answers ahead of an axis at full speed, on a machine with this reaction."""
    b = Bench(replace(PCB, reactions=(FaultReaction("LIMIT", do, kept),))).ready().queue(LONG_WAIT).tick(60)
    assert b.m.axes[0].state == 3
    b.card.stuck_high = b.input_bit("x_max")
    b.tick()
    assert b.m.fault == Fault.LIMIT
    return b


def test_the_faults_are_those_that_machines_have() -> None:
    assert sorted(fault.name for fault in Fault if fault) == FAULT_NAMES
    assert all(not FAULTS[Fault[name]].position_kept for name in NOT_KEPT)
    assert {name for name in FIXED if name != "EMERGENCY_STOP"} == {
        spec.fault.name for spec in FAULTS.values() if spec.reaction == Reaction.DROP
    } - {"SENSOR_CONTRADICTION"}


@pytest.mark.parametrize("kept", [True, False])
def test_a_fault_that_brakes_keeps_the_position_where_the_file_says_so(kept: bool) -> None:
    b = limit_at_speed("brake", kept)
    assert b.m.condition == Condition.STOPPING and b.images[-1]
    b.finish()
    assert (b.m.position_known, b.m.fault_kept, any(b.ticker.lost_steps())) == (kept, kept, False)


def test_a_fault_that_holds_at_speed_has_lost_the_position_whatever_the_file_says() -> None:
    b = limit_at_speed("hold", True)
    assert (b.m.condition, b.m.position_known) == (Condition.LATCHED, False)
    assert b.images[-1], "the current is gone"


def test_a_fault_that_holds_a_slow_machine_keeps_the_position() -> None:
    machine = replace(PCB, reactions=(FaultReaction("LIMIT", "hold", True),))
    b = Bench(machine).ready().queue("KMD_PREDKOSC 7; KMD_GOTOdXdY 400 200").tick(60)
    b.card.stuck_high = b.input_bit("x_max")
    b.tick()
    assert (b.m.condition, b.m.position_known, any(b.ticker.lost_steps())) == (Condition.LATCHED, True, False)


def test_a_fault_that_drops_puts_the_safe_image_out() -> None:
    b = limit_at_speed("drop", False)
    assert (b.images[-1], b.m.condition, b.m.position_known) == (0, Condition.LATCHED, False)


def test_a_fault_that_returns_goes_home_by_the_sensors() -> None:
    b = limit_at_speed("return", True)
    b.card.stuck_high = 0
    b.until(lambda: b.m.condition == Condition.RETURNING)
    b.finish()
    assert (b.m.fault, b.m.position_known, b.positions()[:2]) == (Fault.LIMIT, True, [0, 0])


@pytest.mark.parametrize("name", ["pcb-drill", "boiler-drum", "eight-axis", "pcb-drill-ramp-lab"])
def test_an_emergency_stop_that_brakes_keeps_position_and_current(name: str) -> None:
    b = Bench(replace(shipped(name), emergency_stop="brake", only_zero_after=())).ready()
    b.queue("KMD_RUCHd x=200 y=100").tick(150).ask(Request.ESTOP).tick()
    assert (b.m.fault, b.m.condition) == (Fault.EMERGENCY_STOP, Condition.STOPPING)
    b.finish()
    assert 0 < b.positions()[0] < 200 and not any(b.ticker.lost_steps())
    assert (b.m.position_known, b.m.fault_kept, b.images[-1] > 0) == (True, True, True)
    b.ask(Request.ACK).tick().queue("KMD_GOTO_X_Y 0 0").finish()
    assert (b.positions()[:2], b.m.fault) == ([0, 0], Fault.NONE)


def test_a_machine_that_says_nothing_has_the_reactions_of_the_table() -> None:
    made = reactions_of("drop", ())
    assert made[Fault.EMERGENCY_STOP].reaction == Reaction.DROP
    assert {fault: spec for fault, spec in made.items() if fault != Fault.EMERGENCY_STOP} == {
        fault: spec for fault, spec in FAULTS.items() if fault != Fault.EMERGENCY_STOP
    }
