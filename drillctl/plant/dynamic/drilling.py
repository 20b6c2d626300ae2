"""The drill in the board: how it resists the head and wears. And sensors and belts with faults.

Rule: thrust = F0 (1 + k wear), whatever the feed, while the bit is at the bottom of its hole; none in a hole that was
drilled already, and none on the way up.
"""

import math
from collections.abc import Sequence
from random import Random
from typing import Any

from drillctl.machine import AxisTable, Sensor
from drillctl.machine.model import MM_PER_INCH, Surroundings
from drillctl.plant.carriage import Carriage, Pulses, Switch
from drillctl.plant.dynamic import law
from drillctl.plant.dynamic.kernel import Kernel
from drillctl.plant.faults import Faults

SAME_HOLE_MM = 0.1  # within this distance the bit is in the same hole again


class Bit:
    """The bit of one head, as law.py computes with it.

    columns  what law.py reads and changes, and a place for each of the ``axes``
    """

    def __init__(self, head: AxisTable, axes: int, surface_steps: int | None, surroundings: Surroundings,
                 wear_m: float, kernel: Kernel):  # fmt: skip
        assert head.dynamics is not None
        columns_per_turn = head.motor.columns_per_cycle * head.dynamics.cycles_per_turn
        lead_m = 0.001 * MM_PER_INCH * columns_per_turn / head.columns_per_inch
        self.columns = kernel.numbers([0.0] * (law.HOLE + axes))
        self.columns[law.MOUNTED] = float(surface_steps is not None)
        self.columns[law.INVERTED] = float(head.invert)
        self.columns[law.SURFACE] = self.columns[law.BOTTOM] = float(surface_steps or 0)
        self.columns[law.WEAR] = wear_m
        self.columns[law.METRES] = 0.001 / head.steps_per_mm
        self.columns[law.THRUST], self.columns[law.GROWTH] = surroundings.thrust_n, surroundings.thrust_growth
        self.columns[law.LEVER] = lead_m / (2 * math.pi)
        self.columns[law.SAME] = SAME_HOLE_MM

    @property
    def mounted(self) -> bool:
        """Whether a drill is in the spindle."""
        return self.columns[law.MOUNTED] != 0.0

    @property
    def wear_m(self) -> float:
        """Metres of board that it has cut."""
        return self.columns[law.WEAR]


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

    def changes_at(self) -> tuple[float, float]:
        """Like the method of Switch; a sensor that is stuck never changes."""
        return super().changes_at() if self._stuck is None else (-math.inf, math.inf)

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
    """A carriage on a belt with play: law.py moves it once the play is used up, else it stays where it was left."""

    def __init__(self, table: AxisTable, sensors: Sequence[FaultySwitch], play_mm: float, pulses: Pulses | None = None):
        super().__init__(table, sensors, pulses)
        self.switches = sensors
        self.half_play = play_mm * table.steps_per_mm / 2

    @property
    def flutters(self) -> bool:
        """Whether a wire of its sensors may change although nothing moves."""
        return any(switch.flutters for switch in self.switches)

    def lie_in(self, rows: Any, at: int, steps_per_mm: float) -> None:
        """Writes itself into a row of law.py."""
        rows[at + law.START] = rows[at + law.PLACE] = float(self.start)
        rows[at + law.PITCH], rows[at + law.PLAY] = self.steps_per_column, self.half_play
        rows[at + law.SCALE] = float(steps_per_mm)
