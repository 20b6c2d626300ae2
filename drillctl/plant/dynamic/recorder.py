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
class Motion:
    """The motion of one motor, after each tick: columns (ticks,) from where the rotor's count is 0, speed (ticks,) in
    rad/s of the shaft, currents (ticks, windings) in A, in the order of Dynamics.degrees.
    """

    columns: NDArray[np.float64]
    speed: NDArray[np.float64]
    currents: NDArray[np.float64]


class MotionRecorder:
    """Samples one motor after each tick."""

    def __init__(self, motor: DynamicRotor):
        self._motor = motor
        self._rows: list[tuple[float, ...]] = []

    def sample(self) -> None:
        """Keeps the motor's present state; to be called after each tick."""
        axis = self._motor.axis
        self._rows.append((self._motor.columns, axis.speed, *axis.currents))

    def finish(self) -> Motion:
        """Returns everything that was sampled."""
        rows = np.array(self._rows, np.float64).reshape(-1, 2 + len(self._motor.axis.currents))
        return Motion(rows[:, 0], rows[:, 1], rows[:, 2:])


def motion_of(table: AxisTable, tick_hz: int, images: Iterable[int]) -> Motion:
    """Runs a motor of this axis alone, from power-up, on these port images, a tick each; returns its motion."""
    motor = DynamicRotor(table, tick_hz)
    recorder = MotionRecorder(motor)
    for image in images:
        motor.pull(image & motor.mask)
        recorder.sample()
    return recorder.finish()
