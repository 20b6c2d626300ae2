"""What the machine does on each event at each stage: one table, ``TABLE``, and ``occur``, which follows it.

A controller is always at one *stage*. The status record shows nine stages as six conditions (controller.py):

    READY      IDLE (no job) or RUNNING (from a job's first command to KMD_KONIEC)
    ZERO_ONLY  no job, and the first command that is taken must be the return to zero (KMD_POWROT)
    HOLDING    braking or resting on hold; command, targets and job stay
    STOPPING   braking down the ramps after STOP; or FAULT_STOPPING, after a fault; or RETURN_STOPPING, after a fault
               that sends the machine home
    RETURNING  through the homing table after such a fault
    LATCHED    a fault or an emergency stop waits to be acknowledged, and nothing moves

An *event* is a request, a fault, or what the tick itself sees: a command taken, the job's end, everything at rest. A
row names a stage and an event, the stage that comes next, and what is done. A pair without a row changes nothing: a
HOLD outside a job, a RESUME of what is not held, anything but a fault while latched.

Inputs with an action (``[[input]]``) ask in every tick for as long as they are on: a pause is a HOLD, an emergency stop
its fault, a stop INPUT_STOP, which unlike a STOP does nothing to a machine that has stopped already.

Faults come as four events, after their reaction (kmd/faults.py): FAULT_STOP brakes, FAULT_RETURN brakes and then goes
home, FAULT_DROP puts out the safe image in this tick, FAULT_FREEZE stops the pulses in this tick and holds the current.
The first fault is the one that is shown; a further one never sends the machine home, it only stops it.

Whatever ends a job raises the epoch, so that commands that are queued already are never run. A long gap in time is a
HOLD or the fault LATE_TICK (clock.py). docs/STATES.md is made from this table.
"""

from collections.abc import Callable, Mapping
from enum import IntEnum

from drillctl.execution import stops
from drillctl.execution.controller import Controller, Stage
from drillctl.execution.homing import GOES_ON, begin_homing, carry_homing
from drillctl.kmd import Fault, Reaction
from drillctl.kmd.queue import RequestBit
from drillctl.machine.levels import ESTOP, FAULT

IDLE, ZERO_ONLY, RUNNING, HOLDING, STOPPING, FAULT_STOPPING, RETURN_STOPPING, RETURNING, LATCHED = Stage
Action = Callable[[Controller], None]


class Event(IntEnum):
    """What happens to a controller."""

    COMMAND = 0  # a command of this epoch was taken from the queue
    JOB_END = 1  # KMD_KONIEC is done
    REST = 2  # nothing moves at the end of a tick, and no command waits for that
    HOME = 3  # the homing table is through
    PAUSE = 4  # ticker: the ticks stood still while real motors' time went on
    STOP = 5
    HOLD = 6
    RESUME = 7
    ACK = 8
    OUTPUT = 9
    PACE = 10
    INPUT_STOP = 11  # an input that asks for a stop is on
    FAULT_STOP = 12
    FAULT_RETURN = 13
    FAULT_DROP = 14
    FAULT_FREEZE = 15
    ZERO_FIRST = 16  # it rests without a job, after a fault after which the machine must return to zero


def occur(m: Controller, event: Event) -> None:
    """Follows the table: the next stage, then the action. A pair that the table doesn't have changes nothing."""
    row = TABLE.get((m.stage, event))
    if row is not None:
        following, action = row
        m.enter(following)
        action(m)


def raise_fault(m: Controller, fault: int) -> None:
    """Ends the job and reacts to a fault, dtype kmd.Fault; the first one since the last acknowledgement is kept."""
    spec = m.reactions[fault]
    event = _REACTIONS[spec.reaction]
    if event == Event.FAULT_RETURN and not (m.position_known and m.homes_by_sensor):
        event = Event.FAULT_STOP
    if m.fault == Fault.NONE:
        m.fault, m.fault_axes = fault, m.blamed
        m.fault_kept = True
    m.blamed = 0
    m.stopped_by = max(m.stopped_by, ESTOP if fault == Fault.EMERGENCY_STOP else FAULT)
    in_place = event != Event.FAULT_FREEZE or stops.stops_dead_in_place(m)
    stops.keep_position(m, spec.position_kept and in_place)
    m.zero_first = m.zero_first or fault in m.only_zero_after
    occur(m, event)


def serve(m: Controller) -> None:
    """Serves the requests of this tick: PAUSE, emergency stop, then the others in the order of ``_REQUESTS``."""
    served = m.served
    if served & RequestBit.PAUSE:
        occur(m, Event.PAUSE)
    if served & RequestBit.ESTOP:
        raise_fault(m, Fault.EMERGENCY_STOP)
        served &= ~RequestBit.ACK.value  # an emergency stop of this tick is acknowledged later: nobody has seen it yet
    for bit, event in _REQUESTS.items():
        if served & bit:
            occur(m, event)


def serve_inputs(m: Controller) -> bool:
    """Does what the machine's inputs ask for as long as they are on: an emergency stop that was acknowledged is raised
    again, a job that was resumed is held again. Returns whether a fault was raised.
    """
    on = m.sensors & m.action_mask
    pressed, m.estops = on & m.estop_mask & ~m.estops, on & m.estop_mask
    if pressed:
        raise_fault(m, Fault.EMERGENCY_STOP)
    if on & m.stop_mask:
        occur(m, Event.INPUT_STOP)
    if on & m.pause_mask:
        occur(m, Event.HOLD)
    return pressed > 0


def _finish_stop(m: Controller) -> None:
    """At rest after a stop: the outputs beside the axes take their levels. A return that was cut short has lost the
    position.
    """
    stops.finish_stop(m)
    _bind_to_zero(m)


def _acknowledge(m: Controller) -> None:
    """Forgets the fault, so that the next one is the first again."""
    stops.acknowledge(m)
    _bind_to_zero(m)


def _bind_to_zero(m: Controller) -> None:
    """Without a known position there is no way back to zero, and the machine is not bound to it."""
    m.zero_first = m.zero_first and m.position_known
    if m.zero_first and not m.fault:
        occur(m, Event.ZERO_FIRST)


def _no_action(m: Controller) -> None:
    """Does nothing: only the stage changes."""


def _carry_home(m: Controller) -> None:
    """One row of the homing table has ended: the next, or the end of the return."""
    fault = carry_homing(m)
    if fault == Fault.NONE:
        occur(m, Event.HOME)
    elif fault != GOES_ON:
        raise_fault(m, fault)


_REACTIONS: Mapping[Reaction, Event] = {
    Reaction.STOP: Event.FAULT_STOP,
    Reaction.STOP_AND_RETURN: Event.FAULT_RETURN,
    Reaction.DROP: Event.FAULT_DROP,
    Reaction.HOLD: Event.FAULT_FREEZE,
}
_REQUESTS: Mapping[int, Event] = {
    RequestBit.STOP: Event.STOP,
    RequestBit.HOLD: Event.HOLD,
    RequestBit.RESUME: Event.RESUME,
    RequestBit.ACK: Event.ACK,
    RequestBit.OUTPUT: Event.OUTPUT,
    RequestBit.PACE: Event.PACE,
}
_WITHOUT_FAULT = (IDLE, ZERO_ONLY, RUNNING, HOLDING, STOPPING)
_AFTER_FAULT = (FAULT_STOPPING, RETURN_STOPPING, RETURNING)

TABLE: Mapping[tuple[int, int], tuple[Stage, Action]] = {
    (IDLE, Event.COMMAND): (RUNNING, _no_action),
    (IDLE, Event.ZERO_FIRST): (ZERO_ONLY, _no_action),
    (ZERO_ONLY, Event.COMMAND): (RUNNING, _no_action),
    (RUNNING, Event.JOB_END): (IDLE, _no_action),
    (RUNNING, Event.HOLD): (HOLDING, stops.hold_axes),
    (HOLDING, Event.RESUME): (RUNNING, stops.resume_axes),
    (STOPPING, Event.REST): (IDLE, _finish_stop),
    (FAULT_STOPPING, Event.REST): (LATCHED, _finish_stop),
    (RETURN_STOPPING, Event.REST): (RETURNING, begin_homing),
    (RETURNING, Event.REST): (RETURNING, _carry_home),
    (RETURNING, Event.HOME): (LATCHED, stops.arrive_home),
    (LATCHED, Event.ACK): (IDLE, _acknowledge),
    (IDLE, Event.OUTPUT): (IDLE, stops.set_output),
    (IDLE, Event.PACE): (IDLE, stops.set_pace),
    **{(stage, Event.PACE): (stage, stops.ignore_pace) for stage in Stage if stage != IDLE},
    **{(stage, Event.PAUSE): (stage, stops.restart_motors) for stage in Stage},
    **{(stage, Event.STOP): (STOPPING, stops.stop_job) for stage in _WITHOUT_FAULT},
    **{(stage, Event.STOP): (FAULT_STOPPING, stops.stop_job) for stage in _AFTER_FAULT},
    **{(stage, Event.INPUT_STOP): (STOPPING, stops.stop_job) for stage in (RUNNING, HOLDING)},
    **{(stage, Event.INPUT_STOP): (FAULT_STOPPING, stops.stop_job) for stage in (RETURN_STOPPING, RETURNING)},
    **{(stage, Event.FAULT_STOP): (FAULT_STOPPING, stops.stop_job) for stage in Stage},
    **{(stage, Event.FAULT_RETURN): (RETURN_STOPPING, stops.stop_job) for stage in _WITHOUT_FAULT},
    **{(stage, Event.FAULT_RETURN): (FAULT_STOPPING, stops.stop_job) for stage in (*_AFTER_FAULT, LATCHED)},
    **{(stage, Event.FAULT_DROP): (LATCHED, stops.drop_outputs) for stage in Stage},
    **{(stage, Event.FAULT_FREEZE): (LATCHED, stops.freeze) for stage in Stage},
}
