"""The only reader and writer of tables/. It checks them and hands out immutable machines: tuples of integers.

model.py     a machine as everyone else sees it
phase.py     phase tables         ramp.py   the automaton and its one rule       motor.py   where windings pull a rotor
dynamics.py  what the dynamic plant must know of a motor and its load
config.py    machine files        shape.py   which keys may stand in one         parts.py   the tables that one names
inputs.py    sensors and other inputs                                reactions.py what a file may say of a fault
library.py   where all these are found                                  hazards.py   tables that are valid but dangerous
travel.py    times and distances that follow from a ramp alone          settings.py  what the configuration screen shows
parameters.py what parameters are set on a machine that has any     parameter_table.py every one that there is
parameter_file.py parameters read from a machine's file             parameter_entry.py one value, checked or typed
edit.py      values, patterns and states changed in a table's text, comments kept
bundle.py    a machine with its tables as one text
source.py    a TOML file that knows on which line a key stands (positions.py)     errors.py   TableError
"""

from drillctl.machine.dynamics import Dynamics
from drillctl.machine.errors import TableError
from drillctl.machine.homing import Way, ways
from drillctl.machine.library import Library, machine_hazards, shipped_tables
from drillctl.machine.model import AxisTable, EncoderIndex, HomingStep, Machine, Sensor
from drillctl.machine.motor import Motor
from drillctl.machine.parameters import ParameterRow, Parameters
from drillctl.machine.phase import PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.machine.travel import intervals, travel_table, travel_ticks

__all__ = [
    "AxisTable", "Dynamics", "EncoderIndex", "HomingStep", "Library", "Machine", "Motor", "ParameterRow", "Parameters",
    "PhaseTable", "RampTable", "Sensor", "TableError", "Way", "intervals", "machine_hazards", "shipped_tables",
    "travel_table", "travel_ticks", "ways",
]  # fmt: skip
