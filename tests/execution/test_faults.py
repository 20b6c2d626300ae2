"""Every fault of the table, provoked; what the table says of it is what happens (docs/SPEC.md, 1.8)."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import pytest

from drillctl.execution.conditions import raise_fault
from drillctl.execution.motion import STOPPING
from drillctl.kmd import FAULTS, Condition, Fault, Reaction, Request
from drillctl.machine import EncoderIndex, HomingStep, ParameterRow, Parameters
from drillctl.machine.model import Input
from drillctl.machine.tool_change import ChangeStep, ToolChanger
from tests.support.bench import Bench, shipped

REST_COLUMNS = 3  # the paper's rotor rests every third column
CHANGE_FAULTS = (
    "CHANGE_Z_NOT_HOME", "CHANGE_FOOT", "CHANGE_NOT_THERE", "CHANGE_HEIGHT", "CHANGE_CHUCK", "TOOL_NOT_LEFT",
    "TOOL_NOT_TAKEN",
)  # fmt: skip
LONG_MOVE = "KMD_GOTO_X_Y 300 200; KMD_CZEKAJ 9"


def ready() -> Bench:
    return Bench(shipped("pcb-drill")).ready()


def limit() -> Bench:
    b = ready().queue(LONG_MOVE).tick(60)
    b.card.stuck_high = b.input_bit("x_max")
    return b


def wrong_count() -> Bench:
    b = ready().queue(LONG_MOVE).tick(60)
    b.m.axes[1].position += 20_000
    return b


def beyond_the_range() -> Bench:
    return ready().queue("KMD_GOTO_X_Y 10 20000; KMD_CZEKAJ 9")


def not_homed() -> Bench:
    return Bench(shipped("pcb-drill")).queue("KMD_GOTO_X_Y 10 10; KMD_CZEKAJ 9")


def sensor_never_lets_go() -> Bench:
    b = Bench(shipped("pcb-drill")).queue("KMD_INICJALIZACJA; KMD_CZEKAJ 9")
    b.card.stuck_high = b.input_bit("y_min")
    return b


def blunt_drill() -> Bench:
    b = ready().queue("KMD_WIERTLO_DOL; KMD_WIERTLO_GORA")
    b.card.stuck_low = b.input_bit("z_bottom")
    return b


def head_stays_down() -> Bench:
    b = ready().queue("KMD_WIERTLO_DOL").tick(900)
    b.card.stuck_low = b.input_bit("z_top")
    return b.queue("KMD_WIERTLO_GORA; KMD_CZEKAJ 9")


def slow_drill() -> Bench:
    return ready().queue("KMD_PREDKOSC 20; KMD_WIERTLO_DOL; KMD_CZEKAJ 9")


def both_ends() -> Bench:
    b = ready().queue(LONG_MOVE).tick(60)
    b.card.stuck_high = b.input_bit("x_min") | b.input_bit("x_max")
    return b


def no_answer() -> Bench:
    return ready().queue("KMD_CZEKAJ_WE x_max 1 20; KMD_CZEKAJ 9")


def unequal_line() -> Bench:
    machine = shipped("pcb-drill")
    x, y, z = machine.axes
    b = Bench(replace(machine, axes=(x, replace(y, columns_per_step=2), z)))
    return b.queue("KMD_LINIAd x=10 y=10; KMD_CZEKAJ 9")


def bound_to_zero() -> Bench:
    """After a fault that binds the machine to the return to zero, another command comes."""
    b = Bench(replace(shipped("pcb-drill"), only_zero_after=("LINE_MISMATCH",))).ready()
    raise_fault(b.m, Fault.LINE_MISMATCH)
    b.finish()
    return b.ask(Request.ACK).tick().queue("KMD_CZEKAJ 9")


def no_such_command() -> Bench:
    b = ready()
    strange = b.program("KMD_CZEKAJ 9")
    strange["opcode"][0] = 99
    return b.put(strange)


def coarse_line() -> Bench:
    """Half a step of 0.021 mm is more than 0.01 mm."""
    parameters = Parameters(system=ParameterRow((("interpolation_accuracy_mm", 0.01),)))
    return Bench(replace(shipped("pcb-drill"), parameters=parameters)).ready().queue("KMD_LINIAd x=9 y=5")


def emergency_stop() -> Bench:
    return ready().queue(LONG_MOVE).tick(60).ask(Request.ESTOP)


def long_gap() -> Bench:
    """400 ms, in a wait: from a state above 1 a rotor that stands still has lost its place."""
    b = ready().queue("KMD_CZEKAJ 99").tick(9)
    b.m.gap = 200
    return b


def homing_by_index(row: int, wire: str, level: int) -> Callable[[], Bench]:
    """A homing table for X that ends on an encoder's index, and from one of its rows on a wire that is stuck."""

    def provoke() -> Bench:
        machine = shipped("pcb-drill")
        index = EncoderIndex("x_index", 20, 1, axis=0, turn_steps=40, width_steps=4, at_steps=2)
        rows = [("raise", 2), ("fast", 0), ("slow", 0), ("back", 0), ("index", 0), ("seek", 1), ("creep", 1)]
        homing = tuple(HomingStep(do, (axis,), "min", 40 if do == "slow" else 90) for do, axis in rows)
        x_min, *others = machine.sensors  # away from the index
        sensors = (replace(x_min, edge_steps=-10, hysteresis_steps=4), *others)
        inputs = (Input(index.name, index.bit, index.active_level, "none"),)
        axes = (replace(machine.axes[0], start_steps=50, high_steps=100), *machine.axes[1:])  # a short search
        machine = replace(machine, axes=axes, sensors=sensors, homing=homing, indexes=(index,), inputs=inputs)
        b = Bench(machine).ready()
        b.queue("KMD_GOTO_X_Y 90 0; KMD_INICJALIZACJA").until(lambda: b.m.homing_row == row and not b.m.position_known)
        setattr(b.card, "stuck_high" if level else "stuck_low", b.input_bit(wire))
        return b

    return provoke


def off_the_switch() -> Bench:
    b = homing_by_index(1, "x_index", 0)()
    b.until(lambda: b.m.axes[0].motion == STOPPING)
    b.card.stuck_low = b.input_bit("x_min")
    return b


def spindle_that_does_not_turn(after: str = "KMD_CZEKAJ 9") -> Bench:
    machine = shipped("eight-axis")
    assert machine.spindle is not None
    b = Bench(replace(machine, spindle=replace(machine.spindle, reached_s=0.01, dip_s=0.01)))
    b.card.stuck_low = machine.input_words[0].mask
    return b.queue(f"KMD_WRZECIONO 30000; {after}")


def spindle_that_is_braked() -> Bench:
    b = spindle_that_does_not_turn("KMD_RUCHd x=2000")
    stuck, b.card.stuck_low = b.card.stuck_low, 0
    b.done_at(1)
    b.card.stuck_low = stuck
    return b


def drive_alarm() -> Bench:
    machine = shipped("pcb-drill")
    b = Bench(replace(machine, inputs=(Input("x_alarm", 20, 1, "none"),))).ready().queue(LONG_MOVE).tick(60)
    b.card.stuck_high = b.input_bit("x_alarm")
    return b


def feeling(text: str) -> Bench:
    """A head whose bit says where it touches, and a range beyond which it is broken."""
    parameters = Parameters(machining=ParameterRow((("breakage_range_mm", 0.2),)))
    machine = replace(shipped("pcb-drill"), inputs=(Input("contact_1", 21, 1, "none"),), parameters=parameters)
    return Bench(machine).ready().queue(text)


def nothing_below() -> Bench:
    b = feeling("KMD_DOTYK")
    b.card.stuck_low = b.input_bit("contact_1")
    return b


def broken_bit() -> Bench:
    b = feeling("KMD_DOTYK; KMD_WIERTLO_GORA; KMD_DOTYK")
    b.until(lambda: len(b.m.surfaces) > 0)
    b.m.surfaces[2] -= 100
    return b


def from_the_wiring(fault: Fault) -> Callable[[], Bench]:
    """Ports and processes are lost between ticks, where the wiring sees it and says so."""

    def provoke() -> Bench:
        b = ready().queue(LONG_MOVE).tick(60)
        b.before_tick = lambda: raise_fault(b.m, fault)
        return b

    return provoke


def step_too_slow(fault: Fault) -> Callable[[], Bench]:
    """A step of a tool change whose move takes longer than its time limit."""

    def provoke() -> Bench:
        changer = ToolChanger("together", 1.0, 1.0, (ChangeStep("xy", 0.05, fault.name, to="parking"),))
        b = Bench(replace(shipped("pcb-drill"), tool_changer=changer)).ready()
        return b.queue("KMD_KROK 1; " + LONG_MOVE).tick(3)

    return provoke


PROVOKED: Mapping[Fault, Callable[[], Bench]] = {
    Fault.LIMIT: limit,
    Fault.RANGE: wrong_count,
    Fault.SOFT_LIMIT: beyond_the_range,
    Fault.HOMING_REQUIRED: not_homed,
    Fault.HOMING_NOT_FOUND: sensor_never_lets_go,
    Fault.DRILL_NOT_DOWN: blunt_drill,
    Fault.HEAD_NOT_UP: head_stays_down,
    Fault.DRILLING_TIME: slow_drill,
    Fault.SENSOR_CONTRADICTION: both_ends,
    Fault.INPUT_TIMEOUT: no_answer,
    Fault.LINE_MISMATCH: unequal_line,
    Fault.LINE_TOO_COARSE: coarse_line,
    Fault.BAD_COMMAND: no_such_command,
    Fault.EMERGENCY_STOP: emergency_stop,
    Fault.LATE_TICK: long_gap,
    Fault.PORT_LOST: from_the_wiring(Fault.PORT_LOST),
    Fault.HEARTBEAT_LOST: from_the_wiring(Fault.HEARTBEAT_LOST),
    Fault.TICKER_LOST: from_the_wiring(Fault.TICKER_LOST),
    Fault.PORT_SLOW: from_the_wiring(Fault.PORT_SLOW),
    Fault.ONLY_ZERO: bound_to_zero,
    Fault.SPINDLE_SPEED: spindle_that_does_not_turn,
    Fault.SPINDLE_LOST: spindle_that_is_braked,
    Fault.DRIVE_ALARM: drive_alarm,
    Fault.NO_CONTACT: nothing_below,
    Fault.BIT_BROKEN: broken_bit,
    Fault.HOMING_NO_SWITCH: homing_by_index(1, "x_min", 0),
    Fault.HOMING_OFF_SWITCH: off_the_switch,
    Fault.HOMING_ON_SWITCH: homing_by_index(3, "x_min", 1),
    Fault.HOMING_NO_INDEX: homing_by_index(4, "x_index", 0),
    Fault.HOMING_EARLY_INDEX: homing_by_index(3, "x_index", 1),
    **{fault: step_too_slow(fault) for fault in Fault if fault.name in CHANGE_FAULTS},
}
every_fault = pytest.mark.parametrize("fault", PROVOKED, ids=lambda fault: fault.name)


def test_every_fault_of_the_table_is_provoked_here() -> None:
    assert set(PROVOKED) == set(FAULTS) == set(Fault) - {Fault.NONE}


@every_fault
def test_the_fault_is_latched_and_ends_the_job(fault: Fault) -> None:
    b = PROVOKED[fault]()
    epoch = b.m.epoch
    b.finish()
    assert (b.m.fault, b.m.condition, b.m.job) == (fault, Condition.LATCHED, False)
    assert b.m.epoch > epoch
    made = [axis.made for axis in b.m.axes]
    b.tick(200)
    assert [axis.made for axis in b.m.axes] == made, "something moved while latched"


@every_fault
def test_the_position_is_kept_or_lost_as_the_table_says(fault: Fault) -> None:
    b = PROVOKED[fault]()
    known = b.m.position_known
    b.until(lambda: b.m.fault != Fault.NONE)
    kept = known and FAULTS[fault].position_kept
    assert b.m.fault_kept == kept
    assert b.m.position_known == kept or b.m.condition == Condition.RETURNING
    b.finish()
    assert b.m.fault_kept == kept


@every_fault
def test_the_machine_reacts_as_the_table_says(fault: Fault) -> None:
    b = PROVOKED[fault]()
    known = b.m.position_known
    b.until(lambda: b.m.fault != Fault.NONE)
    reaction = FAULTS[fault].reaction
    if reaction in (Reaction.DROP, Reaction.MACHINE):
        assert (b.images[-1], b.latched()) == (0, True)
    elif any(b.images):
        assert b.images[-1] & ~b.forcing("x"), "the current is gone, although the machine was to brake"
    returned = b.m.condition == Condition.RETURNING
    while not b.ticker.over():
        b.tick()
        returned = returned or b.m.condition == Condition.RETURNING
    assert returned == (known and reaction == Reaction.STOP_AND_RETURN)
    if returned:
        assert (b.m.position_known, b.positions()[:2]) == (True, [0, 0])
        assert b.card.plant.inputs & b.input_bit("z_top")


@every_fault
def test_after_the_acknowledgement_the_machine_works_again(fault: Fault) -> None:
    b = PROVOKED[fault]()
    b.finish()
    b.card.stuck_high = b.card.stuck_low = 0
    b.ask(Request.ACK).tick()
    if b.m.condition == Condition.ZERO_ONLY:
        b.queue("KMD_POWROT").finish()
    assert (b.m.condition, b.m.fault) == (Condition.READY, Fault.NONE)
    b.queue("KMD_INICJALIZACJA; KMD_GOTO_X_Y 20 30")
    b.finish()
    assert (b.m.fault, b.positions()[:2]) == (Fault.NONE, [20, 30])
    assert not any(b.ticker.lost_steps()[:2])
    places = [b.card.plant.position_steps(axis) for axis in (0, 1)]
    assert places == pytest.approx([20, 30], abs=REST_COLUMNS)


@pytest.mark.parametrize("args", [(40, 1), (0, 1)], ids=["no such bit", "a motor's wire"])
def test_only_the_machines_own_outputs_can_be_switched(args: tuple[int, int]) -> None:
    b = Bench(shipped("eight-axis"))
    program = b.program("KMD_WYJSCIE spindle 1")
    program["args"][0, :2] = args
    b.put(program).finish()
    assert (b.m.fault, b.images[-1]) == (Fault.BAD_COMMAND, 0)


@pytest.mark.parametrize(
    ("stuck", "returning_from"),
    [("x_min", slow_drill), ("z_top", slow_drill), ("x_min", blunt_drill)],
)
def test_a_second_fault_on_the_way_home_only_stops(stuck: str, returning_from: Callable[[], Bench]) -> None:
    b = returning_from()
    b.until(lambda: b.m.fault != Fault.NONE)
    first = b.m.fault
    b.card.stuck_low |= b.input_bit(stuck)
    before = b.m.condition
    returns = int(before == Condition.RETURNING)
    while not b.ticker.over():
        b.tick()
        returns += b.m.condition == Condition.RETURNING != before
        before = b.m.condition
    assert (b.m.fault, returns) == (first, 1)
    assert (b.m.position_known, b.m.fault_kept) == (False, False)


@pytest.mark.parametrize(("request_", "image_is_safe"), [(Request.STOP, False), (Request.ESTOP, True)])
def test_a_request_on_the_way_home_ends_it(request_: Request, image_is_safe: bool) -> None:
    b = slow_drill()
    b.until(lambda: b.m.condition == Condition.RETURNING)
    b.tick(30).ask(request_)
    b.finish()
    assert (b.m.fault, b.m.position_known, b.m.fault_kept) == (Fault.DRILLING_TIME, False, False)
    assert (b.images[-1] == 0) == image_is_safe
    assert b.latched()


def test_a_drop_after_a_fault_takes_back_what_the_fault_had_kept() -> None:
    b = beyond_the_range()
    b.finish()
    assert b.m.fault_kept
    b.ask(Request.ESTOP).tick()
    assert (b.m.fault, b.m.fault_kept, b.m.position_known) == (Fault.SOFT_LIMIT, False, False)
