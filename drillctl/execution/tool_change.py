"""Steps of a tool change, and the heads' way home and stroke: how KMD_KROK, KMD_WIERTLO_DOM and KMD_SUW work.

Rule: a step is a row of the machine's table ``[[tool_change]]``. Each command of a step must end within the step's time
limit; one that does not, or that ends in a fault of its own, ends in the step's fault. A hold does not count.
"""

from drillctl.execution.controller import Controller
from drillctl.execution.heads import UP, drive_to_sensors, reached_sensors
from drillctl.kmd import Command, Fault

# Faults of a command that become the fault of the step that it belongs to.
OF_STEPS = frozenset((Fault.INPUT_TIMEOUT, Fault.HEAD_NOT_UP, Fault.DRILL_NOT_DOWN, Fault.DRILLING_TIME))


def begin_step(m: Controller, command: Command) -> int:
    """Starts KMD_KROK: the commands that follow belong to this step; 0: to none. Returns a fault code."""
    changer, number = m.machine.tool_changer, command.args[0]
    if number and (changer is None or number > len(changer.steps)):
        return Fault.BAD_COMMAND
    leave_step(m)
    m.step = number
    if changer is not None and number:
        step = changer.steps[number - 1]
        m.step_limit, m.step_fault = max(1, round(step.limit_s * m.tick_hz)), Fault[step.fault]
    return Fault.NONE


def leave_step(m: Controller) -> None:
    """What follows belongs to no step; ``m.step`` still says which one was the last."""
    m.step_limit = m.step_fault = 0


def whole_strokes(m: Controller) -> None:
    """Every head waits where the machine's file has it, not where KMD_SUW has."""
    for axis in m.axes:
        axis.up = axis.top


def fault_of_step(m: Controller, fault: int) -> int:
    """Returns the fault that a command raises: the step's own for those of OF_STEPS."""
    return m.step_fault if m.step_fault and fault in OF_STEPS else fault


def home_heads(m: Controller, command: Command) -> int:
    """Starts KMD_WIERTLO_DOM: the heads up to their sensors, also from known places. Returns a fault code."""
    return drive_to_sensors(m, command, UP)


def heads_home(m: Controller, command: Command) -> int:
    """Ends KMD_WIERTLO_DOM where every head has reached its sensor. Returns a fault code."""
    return Fault.NONE if reached_sensors(m, command, UP) else Fault.HEAD_NOT_UP


def set_stroke(m: Controller, command: Command) -> int:
    """Starts KMD_SUW: where the named heads wait above the board from now on, in steps from machine zero. Returns a
    fault code.
    """
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1 and (axis not in m.drill_axes or not axis.in_reach(command.args[index])):
            return Fault.SOFT_LIMIT
    for index, axis in enumerate(m.axes):
        if command.axes >> index & 1:
            axis.up = command.args[index]
    return Fault.NONE
