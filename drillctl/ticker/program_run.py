"""A whole program run free on a simulated machine, with no job, journal or trace around it: how it ended, and its
holes.

Rule: what the machine does is what ``drillctl run`` has it do. Called by experiments that try many machines.
"""

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.kmd import is_complete, is_over
from drillctl.machine import Machine
from drillctl.plant import PlantChoice
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.link import Touch

NO_FILE = Path()  # a free run shares no status with another process


@dataclass(frozen=True, slots=True)
class ProgramRun:
    """How a program ended.

    complete  every command is done; fault: the code that ended it (kmd.Fault), or 0
    lost      lost steps by axis, measured at rest
    touches   the holes, as the bit met the board
    """

    ticks: int
    complete: bool
    fault: int
    lost: tuple[int, ...]
    touches: tuple[Touch, ...]


def run_program(
    program: NDArray[np.void],
    machine: Machine,
    plant: PlantChoice,
    goes_on: Callable[[list[Touch]], bool] = lambda touches: True,
) -> ProgramRun:
    """Runs a program, dtype kmd.RECORD, numbered from 1. ``goes_on`` is called with the holes so far, every few
    commands; False ends the run there. Raises PortError for a plant that the machine can't have.
    """
    touches: list[Touch] = []
    put = 0
    with closing(start(machine, RunSettings(plant=plant), NO_FILE)) as link:
        status = link.status()
        epoch = int(status["epoch"])
        while not is_over(status, len(program), epoch) and goes_on(touches):
            put += link.queue.put(program[put : put + link.queue.room])
            link.turn()
            status = link.status()
            touches += link.touches()
    lost = tuple(status["lost"][: len(machine.axes)].tolist())
    complete = is_complete(status, len(program))
    return ProgramRun(int(status["tick"]), complete, int(status["fault"]), lost, tuple(touches))
