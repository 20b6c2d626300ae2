"""The only reader and writer of tables/: checks them and hands out tuples of integers. Imports nothing of ours.

model.py    a machine as everyone else sees it
phase.py    phase tables         ramp.py   the automaton and its one rule       motor.py   what pulls a rotor
dynamics.py what the dynamic plant must know of a motor and its load
config.py   machine files        shape.py   what may stand in one       parts.py   the tables that one names
library.py  where all these are found                                   hazards.py valid but dangerous
travel.py   what follows from a ramp alone             settings.py   what the configuration screen shows
edit.py     values changed in a table's text, comments kept     edit_ramp.py   a ramp's states added, taken away
bundle.py   a machine with its tables as one text
source.py   a TOML file that can say on which line a fault stands               errors.py  TableError
"""

from drillctl.machine.dynamics import Dynamics
from drillctl.machine.errors import TableError
from drillctl.machine.library import Library, machine_hazards, shipped_tables
from drillctl.machine.model import AxisTable, HomingStep, Machine, Sensor
from drillctl.machine.motor import Motor
from drillctl.machine.phase import PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.machine.travel import intervals, travel_table, travel_ticks

__all__ = [
    "AxisTable", "Dynamics", "HomingStep", "Library", "Machine", "Motor", "PhaseTable", "RampTable", "Sensor",
    "TableError", "intervals", "machine_hazards", "shipped_tables", "travel_table", "travel_ticks",
]  # fmt: skip
