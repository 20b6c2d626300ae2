"""How each KMD command starts and ends. Two tables at the end are the whole of it.

Rule: a command is checked when it is taken from the queue, and nothing moves unless all of it may; it ends in the
tick in which everything rests and its own condition holds. Both kinds of handler return a fault code, Fault.NONE for
none; one that ends a command may return GOES_ON instead, while its condition doesn't hold yet.
"""

from collections.abc import Callable, Mapping

from drillctl.execution.axis import Axis
from drillctl.execution.conditions import Event, occur, raise_fault
from drillctl.execution.controller import Controller
from drillctl.execution.depth import lower_to_contact, touched
from drillctl.execution.heads import heads_lowered, heads_raised, lower_heads, raise_heads
from drillctl.execution.homing import GOES_ON, begin_homing, carry_homing
from drillctl.execution.lifted_travel import lift_then_go, lifted_and_gone
from drillctl.execution.reach import refused, target_of
from drillctl.execution.return_to_zero import begin_return, carry_return
from drillctl.execution.spindle import spindle_reached, start_spindle
from drillctl.execution.tool_change import begin_step, fault_of_step, heads_home, home_heads, set_stroke
from drillctl.kmd import Command, Fault, Op
from drillctl.kmd.commands import Flag
from drillctl.ports import with_bits


def start_next(m: Controller) -> bool:
    """Takes the next command of this epoch from the queue and starts it. False where there is none."""
    command = m.command
    while m.queue.take(command):
        if command.epoch == m.epoch:
            m.busy = True
            occur(m, Event.COMMAND)
            m.elapsed = 0
            fault = _start(m, command)
            if fault:
                raise_fault(m, fault_of_step(m, fault))
            elif m.step_limit:
                m.time_limit = m.step_limit
            return True
    return False


def _start(m: Controller, command: Command) -> int:
    if m.zero_first and command.opcode != Op.POWROT:
        return Fault.ONLY_ZERO
    started = _STARTED.get(command.opcode)
    return started(m, command) if started else Fault.BAD_COMMAND


def finish(m: Controller) -> None:
    """Nothing moves: ends the current command if its own condition holds too."""
    ended = _ENDED.get(m.command.opcode)
    fault = ended(m, m.command) if ended else Fault.NONE
    if fault == Fault.NONE:
        m.busy = False
        m.time_limit = 0
        m.done = m.command.sequence
    elif fault != GOES_ON:
        raise_fault(m, fault_of_step(m, fault))


def _move(m: Controller, command: Command) -> int:
    fault = refused(m, command, command.axes)
    if fault:
        return fault
    _set_targets(m, command)
    if command.flags & Flag.LINKED:
        return _start_line(m, command)
    m.hole_begun = command.tag or m.hole_begun  # a peck or a spot begins a hole too
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1:
            axis.set_target(axis.target, command.floor_ticks)
    return Fault.NONE


def _set_targets(m: Controller, command: Command) -> None:
    """Sets the targets of axes that rest and may be sent there."""
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1:
            axis.target = target_of(axis, command, index)
            axis.seek_mask = axis.clear_mask = axis.halt_mask = 0


def _start_line(m: Controller, command: Command) -> int:
    leader, farthest = None, -1
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1:
            if leader is not None and axis.columns_per_step != leader.columns_per_step:
                return _forget_targets(m, Fault.LINE_MISMATCH)
            if abs(axis.target - axis.position) > farthest:
                leader, farthest = axis, abs(axis.target - axis.position)
    if leader is not None and _off_the_line(m, leader) > 1:
        return _forget_targets(m, Fault.LINE_TOO_COARSE)
    if leader is not None and farthest > 0:
        m.line.start(leader, command.axes, command.floor_ticks)
    return Fault.NONE


def _off_the_line(m: Controller, leader: Axis) -> float:
    """How far the followers may be off, each half a step: a square, as a part of what is allowed."""
    ways = zip(m.axes, m.roughness, strict=True)
    return sum(part for axis, part in ways if axis is not leader and axis.target != axis.position)


def _forget_targets(m: Controller, fault: int) -> int:
    for axis in m.axes:
        axis.target = axis.position
    return fault


def _initialise(m: Controller, command: Command) -> int:
    begin_homing(m)
    return Fault.NONE


def _initialised(m: Controller, command: Command) -> int:
    fault = carry_homing(m)
    m.position_known = fault == Fault.NONE
    return fault


def _take_base(m: Controller, command: Command) -> int:
    """Sets the working base of the axes named; else of all that position the board, not of the heads."""
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1 or (not command.axes and axis not in m.drill_axes):
            axis.base = axis.position
    return Fault.NONE


def _switch(m: Controller, command: Command) -> int:
    bit = 1 << (command.args[0] & 0xFF)
    if not bit & m.output_mask:
        return Fault.BAD_COMMAND
    m.switched = with_bits(m.switched, bit, command.args[1])
    if bit & m.spindle_mask:
        m.speed_reached = m.dip_ticks = 0
    return Fault.NONE


def _tool(m: Controller, command: Command) -> int:
    m.tool = command.args[0]
    return Fault.NONE


def _release(m: Controller, command: Command) -> int:
    m.position_known = False
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1 or not command.axes:
            axis.release()
    return Fault.NONE


def _nothing(m: Controller, command: Command) -> int:
    return Fault.NONE


def _waited(m: Controller, command: Command) -> int:
    return Fault.NONE if m.elapsed >= command.args[0] else GOES_ON


def _answered(m: Controller, command: Command) -> int:
    reached = m.sensors >> (command.args[0] & 0xFF) & 1
    if reached == command.args[1]:
        return Fault.NONE
    return Fault.INPUT_TIMEOUT if m.elapsed >= command.args[2] else GOES_ON


def _end(m: Controller, command: Command) -> int:
    occur(m, Event.JOB_END)
    return Fault.NONE


Handler = Callable[[Controller, Command], int]

_STARTED: Mapping[int, Handler] = {
    Op.GOTO_DXDY: _move,
    Op.GOTO_X_Y: _move,
    Op.RUCH: _move,
    Op.RUCH_D: _move,
    Op.LINIA: _move,
    Op.LINIA_D: _move,
    Op.WIERTLO_DOL: lower_heads,
    Op.WIERTLO_GORA: raise_heads,
    Op.INICJALIZACJA: _initialise,
    Op.BAZA: _take_base,
    Op.PREDKOSC: _nothing,  # its ticks stand in the moves that follow
    Op.CZEKAJ: _nothing,
    Op.WYJSCIE: _switch,
    Op.CZEKAJ_WE: _nothing,
    Op.WRZECIONO: start_spindle,
    Op.NARZEDZIE: _tool,
    Op.FAZY_WYL: _release,
    Op.KONIEC: _nothing,
    Op.POWROT: begin_return,
    Op.GORA_X_Y: lift_then_go,
    Op.KROK: begin_step,
    Op.WIERTLO_DOM: home_heads,
    Op.DOTYK: lower_to_contact,
    Op.SUW: set_stroke,
}
_ENDED: Mapping[int, Handler] = {
    Op.WIERTLO_DOL: heads_lowered,
    Op.WIERTLO_GORA: heads_raised,
    Op.INICJALIZACJA: _initialised,
    Op.CZEKAJ: _waited,
    Op.CZEKAJ_WE: _answered,
    Op.WRZECIONO: spindle_reached,
    Op.KONIEC: _end,
    Op.POWROT: carry_return,
    Op.GORA_X_Y: lifted_and_gone,
    Op.WIERTLO_DOM: heads_home,
    Op.DOTYK: touched,
}
