"""The drill in the board: how it resists the head and wears. And sensors and belts with faults.

Rule: thrust = F0 (1 + k wear), whatever the feed, while the bit is at the bottom of its hole; none in a hole that was
drilled already, and none on the way up.
"""

import math
from collections.abc import Sequence
from random import Random

from drillctl.machine import AxisTable, Sensor
from drillctl.machine.model import MM_PER_INCH, Surroundings
from drillctl.plant.carriage import Carriage, Switch
from drillctl.plant.faults import Faults

SAME_HOLE_MM = 0.1  # within this distance the bit is in the same hole again


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
        """Returns the torque that resists the head's motor on the way down. ``over_mm`` is the
        place of the other axes.
        """
        if self._hole is None or math.dist(self._hole, over_mm) > SAME_HOLE_MM:
            self._hole, self._bottom = tuple(over_mm), self._surface
        if depth_steps < self._bottom:
            return 0.0
        self.wear_m += (depth_steps - self._bottom) * self._metres_per_step
        self._bottom = depth_steps
        return self._thrust_n * (1 + self._growth * self.wear_m) * self._nm_per_n


class FaultySwitch(Switch):
    """A sensor whose edge scatters, and which may be stuck, dirty or bouncing."""

    def __init__(self, sensor: Sensor, steps_per_mm: float, scatter_mm: float, faults: Faults, seed: int):
        super().__init__(sensor)
        self._stuck = faults.of("stuck", sensor.name)
        self._flutter_ticks = int(faults.of("bouncing", sensor.name) or 0)
        self._fluttering = 0
        self._middle = self._edge + (faults.of("dirty", sensor.name) or 0.0) * steps_per_mm
        self._scatter = scatter_mm * steps_per_mm
        self._random = Random(f"{seed} {sensor.name}")
        self._draw_edge()

    @property
    def flutters(self) -> bool:
        """Whether its wire may change although nothing moves."""
        return self._fluttering > 0

    def _answers(self, outward: float) -> bool:
        if self._stuck is not None:
            return bool(self._stuck)
        if self._fluttering:
            self._fluttering -= 1
        before = self.reached
        after = super()._answers(outward)
        if after != before:
            self._fluttering = self._flutter_ticks
            if not after:
                self._draw_edge()
        return after ^ bool(self._fluttering % 2)

    def _draw_edge(self) -> None:
        """Draws where the sensor will answer next. Rounded, so that all mathematical libraries give the same."""
        self._edge = self._middle + round(self._random.gauss(0.0, 1.0), 6) * self._scatter


class LooseCarriage(Carriage):
    """A carriage on a belt with play: it follows once the play is used up, and stays where it was left."""

    def __init__(self, table: AxisTable, sensors: Sequence[FaultySwitch], play_mm: float):
        super().__init__(table, sensors)
        self.switches = sensors
        self._half_play = play_mm * table.steps_per_mm / 2
        self._at = float(self.start)

    @property
    def flutters(self) -> bool:
        """Whether a wire of its sensors may change although nothing moves."""
        return any(switch.flutters for switch in self.switches)

    def place(self, columns: float) -> float:
        """Returns where the carriage is once the rotor has turned by so many columns. Asked twice, it is the same."""
        rotor = super().place(columns)
        self._at = min(max(self._at, rotor - self._half_play), rotor + self._half_play)
        return self._at
