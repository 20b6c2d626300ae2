"""LAYER 3: turns commands into one port image a tick. Integers only; no clock, file, float or word in here.

    tick.py        one INT8: read this first
    controller.py  all that a tick works on, allocated once
    axis.py        one motor: the automaton over its ramp, the columns of its phase table
    line.py        axes linked in a straight line
    conditions.py  what the machine does on each request and fault, and at rest: one table
    stops.py       the actions of that table: hold, stop, drop, freeze, outputs by hand and how long they may be hot
    commands.py    how each KMD command starts and ends
    heads.py       the same for those of the drilling heads
    homing.py      initialisation, by the machine's table of steps
    return_to_zero.py  KMD_POWROT, by the count of steps
    limit_checks.py  sensors, ranges, times
    clock.py       the paced clock, and what a gap in time does
    between_ticks.py  writes the status record; edited tables for a machine that rests

May import kmd, ports and machine.
"""

from drillctl.execution.between_ticks import loaded, report
from drillctl.execution.controller import Controller
from drillctl.execution.tick import drop_forcing, look, tick

__all__ = ["Controller", "drop_forcing", "loaded", "look", "report", "tick"]
