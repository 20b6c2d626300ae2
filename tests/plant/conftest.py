"""The shipped machines, whose motors and sensors the plant is proved with."""

import pytest

from drillctl.machine import AxisTable, Library, Machine, shipped_tables

LIBRARY = Library((shipped_tables(),))
# One axis for each kind of motor: machine and index.
MOTORS = {
    "two-phase": ("pcb-drill", 0),
    "five-phase": ("boiler-drum", 0),
    "three-phase": ("boiler-drum", 1),
    "pulse-drive": ("eight-axis", 0),
}


@pytest.fixture(params=[name for name in MOTORS if name != "pulse-drive"])
def stepper(request: pytest.FixtureRequest) -> AxisTable:
    machine, index = MOTORS[request.param]
    return LIBRARY.machine(machine).axes[index]


@pytest.fixture
def drive() -> AxisTable:
    machine, index = MOTORS["pulse-drive"]
    return LIBRARY.machine(machine).axes[index]


@pytest.fixture
def drill() -> Machine:
    return LIBRARY.machine("pcb-drill")
