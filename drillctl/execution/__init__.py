"""LAYER 3: turns commands into one port image a tick. Integers only; no clock, file, float or word in here.

    tick.py        one INT8: read this first
    controller.py  all that a tick works on, allocated once
    axis.py        one motor: the automaton over its ramp, the columns of its phase table
    line.py        axes linked in a straight line
    conditions.py  what the machine does on each request and fault, and at rest: one table
    stops.py       the actions of that table: hold, stop, drop, freeze, outputs by hand
    commands.py    how each KMD command starts and ends
    heads.py       the same for those of the drilling heads
    homing.py      initialisation, by the machine's table of steps
    limit_checks.py  sensors, ranges, times
    hot.py         what was switched on by hand and would burn a winding goes off
    report.py      writes the status record
    clock.py       the paced clock, and what a gap in time does
    table_loading.py  edited tables for a machine that rests

May import kmd, ports and machine.
"""

from drillctl.execution.controller import Controller
from drillctl.execution.report import report
from drillctl.execution.table_loading import loaded
from drillctl.execution.tick import drop_forcing, look, tick

__all__ = ["Controller", "drop_forcing", "loaded", "look", "report", "tick"]
