"""The drill in the board: what it takes to go on down, and how it grows blunt.

Rule: thrust = F0 (1 + k wear), whatever the feed, while the bit is at the bottom of its hole; none in a hole that is
made already, and none on the way up. Called by plant.py once a tick.
"""

import math
from collections.abc import Sequence

from drillctl.machine import AxisTable
from drillctl.machine.model import MM_PER_INCH, Surroundings

SAME_HOLE_MM = 0.1  # the bit finds back into a hole that it left no farther than this


class Bit:
    """The bit of one head.

    wear_m  metres of board that it has cut
    """

    def __init__(self, head: AxisTable, surface_steps: int, surroundings: Surroundings, wear_m: float):
        assert head.dynamics is not None
        self.wear_m = wear_m
        self._surface = self._bottom = float(surface_steps)
        self._hole: tuple[float, ...] | None = None
        self._metres_per_step = 0.001 / head.steps_per_mm
        columns_per_turn = head.motor.columns_per_cycle * head.dynamics.cycles_per_turn
        lead_m = 0.001 * MM_PER_INCH * columns_per_turn / head.columns_per_inch
        self._nm_per_n = lead_m / (2 * math.pi)
        self._thrust_n, self._growth = surroundings.thrust_n, surroundings.thrust_growth

    def torque_nm(self, depth_steps: float, over_mm: Sequence[float]) -> float:
        """The bit is in the board, so deep, at this place: what resists its motor on the way further down."""
        if self._hole is None or math.dist(self._hole, over_mm) > SAME_HOLE_MM:
            self._hole, self._bottom = tuple(over_mm), self._surface
        if depth_steps < self._bottom:
            return 0.0
        self.wear_m += (depth_steps - self._bottom) * self._metres_per_step
        self._bottom = depth_steps
        return self._thrust_n * (1 + self._growth * self.wear_m) * self._nm_per_n
