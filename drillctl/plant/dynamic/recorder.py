"""What a motor did, tick by tick, as arrays: place, speed, currents. For plots and exercises, not for running a
machine.

Rule: it only reads, after a tick. ``motion_of`` runs a motor alone; a MotionRecorder can also watch a motor of a plant.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.machine import AxisTable
from drillctl.plant.dynamic.rotor import DynamicRotor


@dataclass(frozen=True, eq=False, slots=True)
class Recorded:
    """After each tick: columns (ticks,) from where the rotor's count is 0, speed (ticks,) in rad/s of the shaft,
    currents (ticks, 4) in A, in the order of machine.dynamics.WINDING_DEGREES."""

    columns: NDArray[np.float64]
    speed: NDArray[np.float64]
    currents: NDArray[np.float64]


class Recorder:
    """Watches one motor."""

    def __init__(self, motor: DynamicRotor):
        self._motor = motor
        self._rows: list[tuple[float, ...]] = []

    def sample(self) -> None:
        """To be called after each tick."""
        axis = self._motor.axis
        self._rows.append((self._motor.columns, axis.speed, *axis.currents))

    def finish(self) -> Recorded:
        """All that was sampled."""
        rows = np.array(self._rows, np.float64).reshape(-1, 6)
        return Recorded(rows[:, 0], rows[:, 1], rows[:, 2:])


def record(table: AxisTable, tick_hz: int, images: Iterable[int]) -> Recorded:
    """A lone motor of this axis, from power-up, driven by these port images, a tick each."""
    motor = DynamicRotor(table, tick_hz)
    recorder = Recorder(motor)
    for image in images:
        motor.pull(image & motor.mask)
        recorder.sample()
    return recorder.finish()
