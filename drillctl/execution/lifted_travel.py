"""KMD_GORA_X_Y: the heads go up, and as soon as all of them are clear of the board, X and Y start to their place.

The machine's file says down to where a head is clear (``[drill] clear``); without that X and Y start when all heads
rest. The command ends when all axes rest. Rule: X and Y are never started while a head of the machine is lower, and not
in a hold.
"""

from drillctl.execution.controller import Controller, Stage
from drillctl.execution.heads import heads_raised, raise_heads
from drillctl.execution.homing import GOES_ON
from drillctl.execution.reach import refused, target_of
from drillctl.kmd import Command, Fault

RUNNING = Stage.RUNNING.value


def lift_then_go(m: Controller, command: Command) -> int:
    """Starts the command: checks the place, and sends the heads up. Returns a fault code."""
    fault = refused(m, command, command.axes & ~m.head_mask) or raise_heads(m, command)
    m.lifting = not fault and _has_a_way(m, command)
    if not fault and not m.lifting:
        _go(m, command)
    return fault


def go_once_clear(m: Controller) -> None:
    """In each tick while X and Y wait: starts them, if the heads are clear."""
    if m.stage == RUNNING and heads_clear(m):
        m.lifting = False
        _go(m, m.command)


def lifted_and_gone(m: Controller, command: Command) -> int:
    """All axes rest: ends the command, unless X and Y have yet to start. Returns a fault code or GOES_ON."""
    fault = heads_raised(m, command)
    if fault or not m.lifting:
        return fault
    return GOES_ON if heads_clear(m) else Fault.HEAD_NOT_UP


def heads_clear(m: Controller) -> bool:
    """Whether every head of the machine is clear of the board."""
    clear = m.machine.drill_clear_steps
    if clear is None:
        return not any(head.counting for head in m.drill_axes)
    return all(head.position <= clear for head in m.drill_axes)


def _go(m: Controller, command: Command) -> None:
    for index, axis in enumerate(m.axes):
        if _travels(m, command, index):
            axis.seek_mask = axis.clear_mask = axis.halt_mask = 0
            axis.set_target(target_of(axis, command, index), command.floor_ticks)


def _travels(m: Controller, command: Command, index: int) -> int:
    return command.axes & ~m.head_mask & 1 << index


def _has_a_way(m: Controller, command: Command) -> bool:
    return any(
        _travels(m, command, index) and axis.position != target_of(axis, command, index)
        for index, axis in enumerate(m.axes)
    )
