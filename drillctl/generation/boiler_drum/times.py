"""How long a part program takes, from the ramps alone: exact, as every sentence is one move from rest to rest.

Rule: the ticks of a move are those of machine/travel.py; any other command of a part program takes one tick. What
``drillctl estimate`` finds by running the program is the same (tests/generation/boiler_drum).
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import Op
from drillctl.machine import Machine
from drillctl.machine.travel import travel_ticks


def command_ticks(program: NDArray[np.void], machine: Machine) -> NDArray[np.int64]:
    """Returns the ticks (n,) of each command of a part program (dtype kmd.RECORD, from program.py) on a machine."""

    @cache
    def move(axis: int, steps: int, floor_ticks: int) -> int:
        made = machine.axes[axis]
        return travel_ticks(made.ramp, steps, floor_ticks, made.columns_per_step)

    found = np.ones(len(program), np.int64)
    for row in np.flatnonzero(program["opcode"] == Op.RUCH_D).tolist():
        record = program[row]
        axis = int(record["axes"]).bit_length() - 1
        found[row] = move(axis, int(record["args"][axis]), int(record["floor_ticks"]))
    return found
