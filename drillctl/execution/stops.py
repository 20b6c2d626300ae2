"""Requests, and how the machine stops: hold, stop, emergency stop, faults and the return after some of them.

Rule: whatever ends a job raises the epoch, so that commands already queued are never run; a fault is latched until
it is acknowledged. Requests come from tick, faults from guard, commands and homing.
"""

from collections.abc import Callable, Mapping

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.homing import begin_homing, carry_homing
from drillctl.execution.hot import output_set, rate_set
from drillctl.kmd import FAULTS, Condition, Fault, Reaction, Request
from drillctl.kmd.queue import RequestBit, bit_and_value, pace_of
from drillctl.ports import SAFE_IMAGE, with_bits

SURVIVES_STATE = 1  # a rotor stops dead from states 0 and 1: the automaton itself stops from them


def serve(m: Controller) -> None:
    """The requests that wait, in the order of the table below: what befell the motors, emergency stop, the rest."""
    for request, served in _SERVED.items():
        if m.served >> request & 1:
            served(m)


def raise_fault(m: Controller, fault: int) -> None:
    """Latches the first fault and reacts to it; a further one meanwhile only stops, or drops where it must."""
    spec = FAULTS[fault]
    holds = spec.reaction == Reaction.MACHINE and m.machine.emergency_stop == "hold"
    known = m.position_known
    first = m.fault == Fault.NONE
    if first:
        m.fault = fault
        m.fault_kept = True
    _keep_position(m, spec.position_kept or (holds and _stops_dead_on_its_place(m)))
    _end_job(m)
    if holds:
        _latch_at_once(m, drop=False)
    elif spec.reaction in (Reaction.DROP, Reaction.MACHINE):
        _latch_at_once(m, drop=True)
    else:
        returns = first and known and spec.reaction == Reaction.STOP_AND_RETURN
        m.return_wanted = returns and m.homes_by_sensor
        _brake(m)


def carry_on(m: Controller) -> None:
    """Called when nothing moves and the controller is not ready: the next stage of a stop or a return."""
    if m.condition == Condition.STOPPING:
        _stopped(m)
    elif m.condition == Condition.RETURNING and carry_homing(m, raise_fault):
        m.position_known = True
        _latch_at_once(m, drop=False)


def _keep_position(m: Controller, kept: bool) -> None:
    """What was known and kept so far is known still, of the position and for the latched fault's report."""
    m.position_known = m.position_known and kept
    m.fault_kept = m.fault_kept and m.position_known


def _stops_dead_on_its_place(m: Controller) -> bool:
    """Nothing is faster than a rotor can stop; and none stands between two columns of a step, where no count of steps
    says where it is.
    """
    return not any(too_fast_to_stop(m, axis) or (axis.column_in_step and not axis.drive) for axis in m.axes)


def too_fast_to_stop(m: Controller, axis: Axis) -> bool:
    """Whether a rotor that is stopped dead now loses steps. One that is led is as fast as its leader."""
    return abs(m.line.leader.state if axis.follower else axis.state) > SURVIVES_STATE


def _end_job(m: Controller) -> None:
    m.epoch += 1
    m.busy = m.job = False
    m.time_limit = 0


def _brake(m: Controller) -> None:
    m.condition = Condition.STOPPING
    for axis in m.axes:
        axis.feed_hold = False
        axis.seek_mask = axis.clear_mask = 0
        axis.ramp_down()


def _stopped(m: Controller) -> None:
    if m.return_wanted:
        m.return_wanted = False
        m.condition = Condition.RETURNING
        begin_homing(m)
        return
    _keep_position(m, kept=True)  # a return cut short has lost it
    m.switched = SAFE_IMAGE
    m.condition = Condition.LATCHED if m.fault else Condition.READY


def _latch_at_once(m: Controller, drop: bool) -> None:
    for axis in m.axes:
        axis.seek_mask = axis.clear_mask = 0
        if drop:
            axis.release()
        else:
            axis.stop_now()
    m.moving = 0
    m.switched = SAFE_IMAGE
    m.condition = Condition.LATCHED


def _emergency_stop(m: Controller) -> None:
    raise_fault(m, Fault.EMERGENCY_STOP)


def _stop(m: Controller) -> None:
    if m.condition != Condition.LATCHED:
        _end_job(m)
        m.return_wanted = False
        _brake(m)


def hold(m: Controller) -> None:
    """Brakes all axes down their ramps, keeping their targets; the command stays current."""
    if m.condition == Condition.READY and (m.busy or m.job):
        m.condition = Condition.HOLDING
        for axis in m.axes:
            axis.hold()


def _resume(m: Controller) -> None:
    if m.condition == Condition.HOLDING:
        m.condition = Condition.READY
        for axis in m.axes:
            axis.resume()


def _acknowledge(m: Controller) -> None:
    """For what was latched before: nobody has seen an emergency stop of this very tick."""
    if m.condition == Condition.LATCHED and not m.served & RequestBit.ESTOP:
        m.fault = Fault.NONE
        m.fault_kept = False
        m.condition = Condition.READY


def _set_output(m: Controller) -> None:
    """At rest and outside a job, else nothing: a coil's wire moves its rotor, and the position is lost."""
    if not _rests(m):
        return
    place, on = bit_and_value(m.requests.hand)
    bit = 1 << place
    m.switched = with_bits(m.switched, bit & m.output_mask, on)
    for axis in m.axes:
        if axis.wires & bit:
            axis.set_wire(bit, on)
            m.position_known = False
    output_set(m)


def _set_pace(m: Controller) -> None:
    """Another tick rate from the next tick on, at rest and outside a job; the position stays. At any other time it is
    no request at all: the trace has only those that took effect, so that a reader knows how long each tick was.
    """
    if _rests(m):
        before_hz = m.tick_hz
        m.set_rate(pace_of(m.requests.hand))
        rate_set(m, before_hz)
    else:
        m.served &= ~RequestBit.PACE.value


def _rests(m: Controller) -> bool:
    return m.condition == Condition.READY and not (m.busy or m.job or m.moving)


def _after_pause(m: Controller) -> None:
    """While the ticks stood still the rotors of a real machine stopped: those at speed start anew, or were lost."""
    if m.late:  # the gap before this tick has stopped them already
        m.position_known = m.position_known and not m.caught
    fast = [too_fast_to_stop(m, axis) for axis in m.axes]
    for index, axis in enumerate(m.axes):
        if axis.follower or (axis.counting and axis.state):
            m.position_known = m.position_known and not fast[index]
            axis.start_again()


_SERVED: Mapping[int, Callable[[Controller], None]] = {
    Request.PAUSE: _after_pause,
    Request.ESTOP: _emergency_stop,
    Request.STOP: _stop,
    Request.HOLD: hold,
    Request.RESUME: _resume,
    Request.ACK: _acknowledge,
    Request.OUTPUT: _set_output,
    Request.PACE: _set_pace,
}
