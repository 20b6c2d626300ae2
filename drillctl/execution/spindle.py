"""A spindle whose speed is measured: KMD_WRZECIONO ends once it has its speed, or stands; a speed that is lost later is
a fault.

Rule: what is wanted is read from the outputs as they stand, so that every stop that takes them off is a stop of the
spindle. On a machine that measures nothing the command ends at once and nothing is watched.
"""

from drillctl.execution.controller import Controller, Stage
from drillctl.execution.homing import GOES_ON
from drillctl.kmd import Command, Fault
from drillctl.ports import with_bits


def start_spindle(m: Controller, command: Command) -> int:
    """Starts KMD_WRZECIONO. On a machine without a spindle output the drill's motor has a switch of its own; one that
    puts the speed out has a word for it. Returns a fault code.
    """
    rev_min = command.args[0]
    if m.speed_word is not None:
        if rev_min > m.speed_word.greatest:
            return Fault.BAD_COMMAND
        m.switched = m.speed_word.put(m.switched, rev_min)
    m.switched = with_bits(m.switched, m.spindle_mask, rev_min > 0)
    m.speed_reached = m.dip_ticks = 0
    return Fault.NONE


def spindle_reached(m: Controller, command: Command) -> int:
    """Ends KMD_WRZECIONO. Returns a fault code, or GOES_ON."""
    if m.spindle is None or at_speed(m, m.sensors):
        m.speed_reached = command.args[0]
        return Fault.NONE
    return Fault.SPINDLE_SPEED if m.elapsed >= m.reach_ticks else GOES_ON


def at_speed(m: Controller, sensors: int) -> bool:
    """Whether the spindle has the speed that is wanted, by these inputs."""
    assert m.spindle is not None and m.speed_word is not None and m.actual_word is not None
    on = not m.spindle_mask or m.switched & m.spindle_mask
    return m.spindle.near(m.speed_word.value(m.switched) if on else 0, m.actual_word.value(sensors))


def speed_is_lost(m: Controller) -> bool:
    """Whether a speed that was reached has been missed for too long. To be asked in every tick; while a job is held it
    is not looked at: the converter may be silent.
    """
    if m.stage != Stage.RUNNING or at_speed(m, m.sensors):
        m.dip_ticks = 0
    else:
        m.dip_ticks += 1
    return m.dip_ticks > m.most_dip_ticks
