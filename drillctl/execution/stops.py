"""What the table in conditions.py does on a request or a fault: the actions, each for a controller.

Rule: nothing here asks at which stage the controller is, nor changes it; the table has done both.

What was switched on by hand and would burn a winding (24 V at rest, both halves of a winding) goes off after HOT_S: the
table starts that time, and the tick ends it with ``cut_off``. It is counted in ticks, so a trace has it and replays;
whoever paces counts ticks while it lasts, though nothing moves. A column of a phase table is never touched.
"""

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.tool_change import leave_step, whole_strokes
from drillctl.kmd import Fault
from drillctl.kmd.queue import RequestBit, bit_and_value, pace_of
from drillctl.machine.levels import STOP
from drillctl.ports import with_bits

HOT_S = 1
SURVIVES_STATE = 1  # a rotor stops dead from states 0 and 1: the automaton itself stops from them


def hold_axes(m: Controller) -> None:
    """Brakes all axes down their ramps; their targets and the command stay."""
    for axis in m.axes:
        axis.hold()


def resume_axes(m: Controller) -> None:
    """Lets all axes go on towards their targets."""
    for axis in m.axes:
        axis.resume()


def stop_job(m: Controller) -> None:
    """Ends the job and brakes all axes down their ramps; where they come to rest are their targets."""
    _end_job(m)
    for axis in m.axes:
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        axis.ramp_down()


def finish_stop(m: Controller) -> None:
    """At rest after a stop: the outputs beside the axes take their levels. A return that was cut short has lost the
    position.
    """
    keep_position(m, kept=True)
    switch_outputs(m)


def drop_outputs(m: Controller) -> None:
    """Ends the job and takes the current off all phases, in this tick."""
    _end_job(m)
    for axis in m.axes:
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        axis.release()
    _stand_still(m)


def freeze(m: Controller) -> None:
    """Ends the job and stops all pulses in this tick; the current is held."""
    _end_job(m)
    _hold_current(m)


def arrive_home(m: Controller) -> None:
    """The return after a fault is through: the position is known, and the current is held."""
    m.position_known = True
    m.zero_first = False
    _hold_current(m)


def acknowledge(m: Controller) -> None:
    """Forgets the fault, so that the next one is the first again."""
    m.fault, m.fault_axes = Fault.NONE, 0
    m.stopped_by = STOP
    m.fault_kept = False
    m.estops = m.alarms = 0


def switch_outputs(m: Controller) -> None:
    """Sets the outputs beside the axes to their levels for what has stopped the machine."""
    kept, on = m.levels[m.stopped_by]
    m.switched = m.switched & kept | on
    m.speed_reached = m.dip_ticks = 0


def set_output(m: Controller) -> None:
    """Sets an output by hand. A coil's wire moves its rotor, so the position is lost."""
    place, on = bit_and_value(m.requests.hand)
    bit = 1 << place
    if bit & m.spindle_mask:
        m.speed_reached = m.dip_ticks = 0
    m.switched = with_bits(m.switched, bit & m.output_mask, on)
    for axis in m.axes:
        if axis.wires & bit:
            axis.set_wire(bit, on)
            m.position_known = False
    m.cut_off = 0
    hot = any(_hot(axis) for axis in m.axes)
    m.hot_until = (m.hot_until or m.tick + HOT_S * m.tick_hz) if hot else 0


def cut_off(m: Controller) -> None:
    """HOT_S are over: what the axes' tables don't have goes off, where it was dangerous."""
    m.hot_until = 0
    for axis in m.axes:
        hot = _hot(axis)
        if hot:
            m.cut_off = 1
            axis.set_wire(hot, 0)


def set_pace(m: Controller) -> None:
    """Sets another tick rate from the next tick on; the position stays, and so do the seconds of ``hot_until``."""
    before_hz = m.tick_hz
    m.set_rate(pace_of(m.requests.hand))
    if m.hot_until:
        m.hot_until = m.tick + max(1, (m.hot_until - m.tick) * m.tick_hz // before_hz)


def ignore_pace(m: Controller) -> None:
    """A rate that is asked for in motion or in a job is no request: the trace has only those that took effect, so that
    a reader knows how long each tick was.
    """
    m.served &= ~RequestBit.PACE.value


def restart_motors(m: Controller) -> None:
    """While the ticks stood still the rotors of a real machine stopped: those at speed start anew, or were lost."""
    if m.late:  # the gap before this tick has stopped them already
        m.position_known = m.position_known and not m.caught
    fast = [too_fast_to_stop(m, axis) for axis in m.axes]
    for index, axis in enumerate(m.axes):
        if axis.follows or (axis.counting and axis.state):
            m.position_known = m.position_known and not fast[index]
            axis.start_again()


def keep_position(m: Controller, kept: bool) -> None:
    """What was known and kept so far is known still, of the position and for the latched fault's report."""
    m.position_known = m.position_known and kept
    m.fault_kept = m.fault_kept and m.position_known


def stops_dead_in_place(m: Controller) -> bool:
    """Whether no axis is faster than a rotor can stop, and none stands between two columns of a step, where no count
    of steps says where it is.
    """
    return not any(too_fast_to_stop(m, axis) or (axis.column_in_step and not axis.drive) for axis in m.axes)


def too_fast_to_stop(m: Controller, axis: Axis) -> bool:
    """Whether a rotor that is stopped dead now loses steps. A follower is as fast as its leader."""
    return abs(m.line.leader.state if axis.follows else axis.state) > SURVIVES_STATE


def _end_job(m: Controller) -> None:
    m.epoch += 1
    m.busy = m.lifting = False
    m.time_limit = 0
    leave_step(m)
    whole_strokes(m)


def _hold_current(m: Controller) -> None:
    for axis in m.axes:
        axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
        axis.stop_now()
    _stand_still(m)


def _stand_still(m: Controller) -> None:
    m.moving = 0
    switch_outputs(m)


def _hot(axis: Axis) -> int:
    """The bits that were added by hand to what the axis holds, and would burn it. An axis that moves has none."""
    table = axis.hold_patterns[axis.direction * axis.direction_sign]
    added = axis.hold_bits & ~table[axis.column]
    hot = added & axis.forcing
    for pair in axis.halves:
        if axis.hold_bits & pair == pair:
            hot |= added & pair
    return hot
