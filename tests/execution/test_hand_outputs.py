"""OUTPUT and PAUSE: an output set by hand at rest and at no other time, a motor's wire at the price of the position;
and what a clock that stood still did to real motors (docs/SPEC.md, 1.17 and 1.18).
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.kmd import Condition, Op, Request
from drillctl.machine.shape import MOST_CARDS
from tests.support.bench import MACHINES, Bench, shipped

JOB = "KMD_GOTO_X_Y 60 25; KMD_WIERTLO_DOL; KMD_WIERTLO_GORA; KMD_CZEKAJ 30; KMD_LINIA x=5 y=60"
JOB_TICKS = 900
BITS = MOST_CARDS * 32
USED_BITS = [bit for axis in shipped("pcb-drill").axes for bit in axis.wire_bits]


def ready(name: str = "pcb-drill") -> Bench:
    return Bench(shipped(name)).ready()


def by_hand(b: Bench, bit: int, value: int) -> Bench:
    assert b.ticker.requests.set_output(bit, value)
    return b.tick()


def spindle(b: Bench) -> int:
    return dict(b.machine.outputs)["spindle"]


def test_an_output_is_switched_and_the_position_stays() -> None:
    b = ready("cnc-shield")
    bit, coils = spindle(b), b.m.image
    by_hand(b, bit, 1)
    assert b.images[-1] == coils | 1 << bit and b.m.position_known
    by_hand(b, bit, 0)
    assert b.images[-1] == coils and b.m.position_known


@pytest.mark.parametrize("name", MACHINES)
def test_any_wire_of_any_axis_can_be_put_out_and_costs_the_position(name: str) -> None:
    for axis in shipped(name).axes:
        for bit in axis.wire_bits:
            b = Bench(shipped(name))
            b.m.position_known = True
            before = b.tick().images[-1]
            by_hand(b, bit, 1 - (before >> bit & 1))
            assert b.images[-1] == before ^ 1 << bit and not b.m.position_known
            b.tick(3)
            assert b.images[-1] == before ^ 1 << bit, "it stays until somebody changes it"


def test_the_next_step_puts_its_own_column_out() -> None:
    b = ready()
    bit = b.machine.axes[0].wire_bits[0]
    by_hand(b, bit, 1)
    b.queue("KMD_RUCHd x=12").finish()
    plain = ready().queue("KMD_RUCHd x=12")
    plain.finish()
    assert b.m.image == plain.m.image


def test_a_rotor_pulled_by_hand_is_seen_by_the_plant() -> None:
    b = ready()
    x = b.machine.axes[0]
    for wire, bit in zip(x.phase.wires, x.wire_bits, strict=True):
        by_hand(b, bit, wire.forward[6])  # half a cycle on from the column that is out, by way of the ones between
    assert any(b.ticker.lost_steps())


def test_outputs_are_set_one_a_tick_in_the_order_asked() -> None:
    b = ready("cnc-shield")
    bit = 1 << spindle(b)
    for value in (1, 0, 1):
        assert b.ticker.requests.set_output(spindle(b), value)
    b.images.clear()
    b.tick(4)
    assert [bool(image & bit) for image in b.images] == [True, False, True, True]


@given(bit=st.sampled_from(USED_BITS), value=st.integers(0, 1), after=st.integers(0, JOB_TICKS))
@settings(max_examples=60, deadline=None)
def test_in_a_job_no_output_is_set(bit: int, value: int, after: int) -> None:
    """Whatever the tick: a job that was asked puts out, to the byte, what one puts out that was not."""
    asked, plain = ready().queue(JOB).tick(after + 1), ready().queue(JOB).tick(after + 1)
    if asked.m.job:
        asked.ticker.requests.set_output(bit, value)
        asked.finish()
        plain.finish()
        assert asked.images == plain.images and asked.m.position_known


@pytest.mark.parametrize("end", [True, False], ids=["in a wait", "starved"])
def test_at_rest_in_a_job_no_output_is_set(end: bool) -> None:
    b = ready().queue("KMD_RUCHd x=3; KMD_CZEKAJ 400" if end else "KMD_RUCHd x=3", end=end).tick(120)
    assert b.m.job and not b.m.moving and b.m.busy == end
    before = b.m.image
    for bit in USED_BITS:
        by_hand(b, bit, 1 - (before >> bit & 1))
        assert b.m.image == before and b.m.position_known


@pytest.mark.parametrize("meanwhile", [Request.HOLD, Request.STOP, Request.ESTOP])
def test_held_braking_or_latched_no_output_is_set(meanwhile: Request) -> None:
    for later in (1, 5, 60):
        asked, plain = (ready().queue("KMD_GOTO_X_Y 200 100").tick(60).ask(meanwhile).tick(later) for _ in range(2))
        if asked.m.condition != Condition.READY:
            by_hand(asked, spindle_or_any(asked), 1)
            assert asked.images[-1] == plain.tick().images[-1]


def spindle_or_any(b: Bench) -> int:
    return dict(b.machine.outputs).get("spindle", b.machine.axes[2].wire_bits[0])


def test_a_bit_without_a_wire_changes_nothing() -> None:
    b = ready()
    used = b.m.output_mask | sum(1 << bit for axis in b.machine.axes for bit in axis.wire_bits)
    before = b.m.image
    for bit in set(range(BITS)) - set(range(used.bit_length())):
        by_hand(b, bit, 1)
        assert b.images[-1] == before and b.m.position_known


def test_a_command_in_the_same_tick_finds_the_position_lost() -> None:
    b = ready().queue("KMD_GOTO_X_Y 9 9")
    by_hand(b, b.machine.axes[0].wire_bits[0], 1)
    assert b.m.command.opcode == Op.GOTO_X_Y and b.m.fault and not b.m.moving


def test_a_pause_at_speed_loses_the_position_and_the_way_is_gone_on_with() -> None:
    b = ready().queue("KMD_GOTO_X_Y 200 100").tick(60)
    assert b.m.axes[0].state > 1
    b.ask(Request.PAUSE).tick()
    assert [axis.state for axis in b.m.axes[:2]] == [0, 0] and not b.m.position_known
    b.finish()
    assert b.positions()[:2] == [200, 100]


def test_a_pause_before_every_tick_still_comes_to_the_target() -> None:
    """Single steps of a real machine: each step from rest, and nothing lost."""
    b = ready().queue("KMD_GOTO_X_Y 5 3")
    ticks = 0
    while not b.ticker.over() or not ticks:
        b.ask(Request.PAUSE).tick()
        ticks += 1
        assert ticks < 2_000
    assert b.positions()[:2] == [5, 3] and b.m.position_known and not any(b.ticker.lost_steps())


def test_after_a_pause_in_a_line_nobody_keeps_forcing_and_all_come_to_their_targets() -> None:
    b = ready().queue("KMD_LINIA x=200 y=140").tick(60)
    b.ask(Request.PAUSE).tick()
    assert not b.m.image & (b.forcing("x") | b.forcing("y"))
    b.finish()
    assert b.positions()[:2] == [200, 140]
