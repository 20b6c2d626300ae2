"""Hold, resume, stop, emergency stop, acknowledgement, and a job that starves (docs/SPEC.md, 1.6, 1.7, 1.8, 1.13)."""

from dataclasses import replace

import pytest

from drillctl.kmd import Condition, Fault, Request
from tests.support.bench import Bench, shipped

JOB = "KMD_GOTO_X_Y 40 25; KMD_WIERTLO_DOL; KMD_WIERTLO_GORA; KMD_CZEKAJ 30; KMD_LINIA x=5 y=60; KMD_GOTO_X_Y 0 0"
JOB_TICKS = 1_900


def ready(name: str = "pcb-drill") -> Bench:
    return Bench(shipped(name)).ready()


def holding() -> Bench:
    """A machine that holds its current on an emergency stop and may go on afterwards."""
    return Bench(replace(shipped("boiler-drum"), emergency_stop="hold", only_zero_after=())).ready()


def plain_end(name: str) -> tuple[list[int], int]:
    """Where an undisturbed job ends, and when."""
    b = ready(name).queue(JOB)
    ticks = b.finish()
    return b.positions(), ticks


@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab"])
@pytest.mark.parametrize("held_ticks", [1, 6, 50])
def test_a_hold_anywhere_in_a_job_loses_nothing(name: str, held_ticks: int) -> None:
    where, _ = plain_end(name)
    for start in range(0, JOB_TICKS, 97):
        b = ready(name).queue(JOB).tick(start + 1)
        b.ask(Request.HOLD).tick(held_ticks).ask(Request.RESUME)
        b.finish()
        assert (b.m.fault, b.positions(), b.m.holes_done) == (Fault.NONE, where, 0)
        assert b.m.position_known
        assert not any(b.ticker.lost_steps())


def test_held_the_axes_come_to_rest_and_stay() -> None:
    b = ready().queue("KMD_GOTO_X_Y 200 100").tick(60)
    b.ask(Request.HOLD).tick(40)
    places = b.positions()
    assert all(axis.state == 0 and not axis.counting for axis in b.m.axes)
    b.tick(500)
    assert (b.positions(), b.m.busy, b.m.condition) == (places, True, Condition.HOLDING)


def test_counting_starts_at_one_in_the_tick_of_the_resume() -> None:
    b = ready().queue("KMD_GOTO_X_Y 200 100").tick(60).ask(Request.HOLD).tick(40)
    b.ask(Request.RESUME).tick()
    assert [axis.count for axis in b.m.axes[:2]] == [1, 1]


@pytest.mark.parametrize("held_ticks", [1, 10, 400])
def test_a_wait_does_not_count_while_held(held_ticks: int) -> None:
    b = ready().queue("KMD_CZEKAJ 100").tick(30)
    b.ask(Request.HOLD).tick(held_ticks).ask(Request.RESUME)
    assert b.until(lambda: not b.m.busy) == 70


def test_drilling_time_does_not_count_while_held() -> None:
    machine = shipped("pcb-drill")
    patient = replace(machine, configuration=replace(machine.configuration, longest_drilling_s=2.0))
    b = Bench(patient).ready().queue("KMD_WIERTLO_DOL").tick(400)
    b.ask(Request.HOLD).tick(5_000).ask(Request.RESUME)
    b.finish()
    assert b.m.fault == Fault.NONE


def test_a_hold_without_a_job_is_nothing() -> None:
    b = ready().ask(Request.HOLD).tick(3)
    assert b.m.condition == Condition.READY


def test_resume_without_a_hold_is_nothing() -> None:
    b = ready().queue("KMD_CZEKAJ 9").tick(2).ask(Request.RESUME).tick(2)
    assert (b.m.condition, b.m.elapsed) == (Condition.READY, 4)


@pytest.mark.parametrize("name", ["pcb-drill", "pcb-drill-ramp-lab"])
def test_a_stop_anywhere_keeps_the_position_and_flushes_the_queue(name: str) -> None:
    for start in range(0, JOB_TICKS, 97):
        b = ready(name).queue(JOB).tick(start + 1)
        epoch = b.m.epoch
        b.ask(Request.STOP)
        b.finish()
        b.tick(5)
        places = b.positions()
        assert (b.m.epoch, b.m.job, len(b.ticker.queue)) == (epoch + 1, False, 0)
        assert (b.m.fault, b.m.position_known) == (Fault.NONE, True)
        assert not any(b.ticker.lost_steps())
        b.queue("KMD_RUCHd x=11 y=7")
        b.finish()
        assert b.positions() == [places[0] + 11, places[1] + 7, places[2]], "the next move is not whole"


def test_commands_of_an_older_epoch_are_discarded_whenever_they_come() -> None:
    b = ready().queue("KMD_GOTO_X_Y 200 100").tick(60).ask(Request.STOP)
    b.finish()
    place = b.positions()
    b.m.epoch -= 1
    b.queue("KMD_RUCHd x=50")  # sent before the stop was seen
    b.m.epoch += 1
    b.tick(100)
    assert (b.positions(), len(b.ticker.queue)) == (place, 0)


def test_a_stop_switches_the_outputs_off() -> None:
    b = ready("eight-axis").queue("KMD_WYJSCIE spindle 1; KMD_CZEKAJ 50").tick(10)
    assert b.images[-1] >> 16 & 1
    b.ask(Request.STOP).tick()
    assert not b.images[-1] >> 16 & 1


def test_a_stop_while_held_ends_the_job() -> None:
    b = ready().queue("KMD_LINIA x=200 y=100").tick(60).ask(Request.HOLD).tick(40).ask(Request.STOP)
    b.finish()
    b.queue("KMD_GOTO_X_Y 3 4")
    b.finish()
    assert b.positions()[:2] == [3, 4]


@pytest.mark.parametrize("start", [1, 7, 30, 60, 150])
def test_an_emergency_stop_drops_everything_in_its_tick(start: int) -> None:
    b = ready().queue("KMD_LINIA x=200 y=100").tick(start).ask(Request.ESTOP).tick()
    assert b.images[-1] == 0
    assert (b.m.fault, b.m.condition) == (Fault.EMERGENCY_STOP, Condition.LATCHED)
    assert not b.m.position_known
    b.tick(100)
    assert not any(b.images[-100:])


@pytest.mark.parametrize("start", [1, 7, 30, 60, 150])
@pytest.mark.parametrize("move", ["KMD_LINIA x=200 y=100", "KMD_GOTO_X_Y 200 3", "KMD_RUCHd x=0 y=150"])
def test_a_machine_that_holds_stops_its_pulses_and_keeps_its_place_from_states_0_and_1(start: int, move: str) -> None:
    b = holding().queue(move).tick(start)
    place, current = b.positions(), b.images[-1]
    slow = all(abs(axis.state) <= 1 for axis in b.m.axes)
    assert slow == (start < 30), "the ramp of this machine rises a state with each step"
    b.ask(Request.ESTOP).tick(50)
    assert set(b.images[-50:]) == {current}
    assert (b.positions(), b.m.position_known, b.m.fault_kept) == (place, slow, slow)
    b.ask(Request.ACK).tick().queue("KMD_GOTO_X_Y 0 0")
    b.finish()
    assert (b.positions(), b.m.fault) == (([0, 0], Fault.NONE) if slow else (place, Fault.HOMING_REQUIRED))
    assert not any(b.ticker.lost_steps())


def test_a_gap_that_stops_a_follower_is_judged_by_the_speed_of_its_leader() -> None:
    """The leader's own ramp is too gentle to be stopped by it; the follower's is not."""
    machine = shipped("pcb-drill")
    x, y, z = machine.axes
    patient = replace(x, ramp=replace(x.ramp, interval=(400, *x.ramp.interval[1:])))
    b = Bench(replace(machine, axes=(patient, y, z)))
    b.m.position_known = True
    b.queue("KMD_LINIAd x=300 y=200").until(lambda: b.m.axes[0].state == 3)
    b.m.gap = 200
    b.tick()
    assert (b.m.fault, b.m.position_known) == (Fault.LATE_TICK, False)


@pytest.mark.parametrize(("state", "kept"), [(0, True), (1, True), (2, False), (3, False)])
def test_a_real_machine_stopped_by_a_gap_keeps_its_position_from_states_0_and_1(state: int, kept: bool) -> None:
    """A short gap, which is no fault; whoever paces real motors tells of it by PAUSE."""
    b = ready("pcb-drill").queue("KMD_RUCHd x=300 y=2")
    b.until(lambda: b.m.axes[0].state == state and b.m.moving)
    b.m.gap = 10
    b.ask(Request.PAUSE).tick()
    assert (b.m.fault, b.m.position_known) == (Fault.NONE, kept)
    b.finish()
    assert b.positions()[:2] == [300, 2]


def test_a_machine_that_holds_between_the_columns_of_a_step_has_lost_its_place() -> None:
    b = Bench(replace(shipped("pcb-drill-ramp-lab"), emergency_stop="hold")).ready().queue("KMD_RUCHd x=20")
    b.until(lambda: b.m.axes[0].column_in_step == 3)
    b.ask(Request.ESTOP).tick()
    assert (b.m.position_known, b.m.fault_kept) == (False, False)


def test_a_drive_that_is_halted_in_its_pulse_has_made_the_step() -> None:
    b = Bench(replace(shipped("eight-axis"), emergency_stop="hold")).ready().queue("KMD_RUCHd x=20")
    x = b.m.axes[0]
    b.until(lambda: x.column_in_step == 1 and x.position > 0)
    assert x.state == 1
    b.ask(Request.ESTOP).tick(3)
    assert b.m.position_known
    assert b.ticker.places()[0] == x.position
    assert b.card.plant.position_steps(0) == x.position


def test_latched_until_acknowledged() -> None:
    b = ready().queue("KMD_CZEKAJ 50").tick(5).ask(Request.ESTOP).tick()
    place = b.positions()
    b.queue("KMD_RUCHd x=5").ask(Request.RESUME).tick(50).ask(Request.STOP).tick(5).ask(Request.HOLD).tick(5)
    assert (b.m.condition, b.m.fault, b.positions()) == (Condition.LATCHED, Fault.EMERGENCY_STOP, place)
    b.ask(Request.ACK).tick()
    assert (b.m.condition, b.m.fault) == (Condition.READY, Fault.NONE)


def test_an_acknowledgement_does_not_lift_the_emergency_stop_that_comes_with_it() -> None:
    b = ready().ask(Request.ACK, Request.ESTOP).tick()
    assert (b.m.condition, b.m.fault) == (Condition.LATCHED, Fault.EMERGENCY_STOP)


def test_an_emergency_stop_goes_before_all_other_requests() -> None:
    b = ready().queue("KMD_CZEKAJ 50").tick(5)
    b.ask(Request.RESUME, Request.HOLD, Request.STOP, Request.ESTOP).tick()
    assert (b.m.condition, b.images[-1]) == (Condition.LATCHED, 0)


def test_the_job_starves_and_the_ticks_stand_still() -> None:
    b = ready().queue("KMD_CZEKAJ 3", end=False)
    before = b.m.tick
    b.tick(3)
    assert (b.m.tick - before, b.m.underruns) == (3, 0)
    b.tick(40)
    assert (b.m.tick - before, b.m.underruns) == (3, 40)
    b.queue("KMD_KONIEC").tick(10)
    assert (b.m.tick - before, b.m.underruns, b.m.job) == (13, 40, False)


@pytest.mark.parametrize(
    ("asked", "condition", "job"),
    [
        (Request.HOLD, Condition.HOLDING, True),
        (Request.STOP, Condition.READY, False),
        (Request.ESTOP, Condition.LATCHED, False),
    ],
)
def test_a_starving_job_answers_requests(asked: Request, condition: Condition, job: bool) -> None:
    b = ready().queue("KMD_CZEKAJ 3", end=False).tick(10).ask(asked)
    before = b.m.tick
    b.tick()
    assert (b.m.tick - before, b.m.condition, b.m.job) == (1, condition, job)


def test_without_a_job_ticks_go_on() -> None:
    b = ready()
    before = b.m.tick
    b.tick(25)
    assert (b.m.tick - before, b.m.underruns) == (25, 0)
