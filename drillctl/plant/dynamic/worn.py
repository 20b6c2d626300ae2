"""Sensors and belts as they are: edges that scatter, dirt, flutter, play. Parts of the dynamic plant.

Rule: scatter comes from a seed and a sensor's name alone, one draw for each time a sensor is approached.
"""

from collections.abc import Sequence
from random import Random

from drillctl.machine import AxisTable, Sensor
from drillctl.plant.carriage import Carriage, Switch
from drillctl.plant.faults import Faults


class WornSwitch(Switch):
    """A sensor whose edge scatters, and with which something may be wrong; ``flutters`` while its wire does."""

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
        """Its wire may change although nothing moves."""
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
        """Where it will answer the next time. Rounded, so that the last bits of a logarithm don't show."""
        self._edge = self._middle + round(self._random.gauss(0.0, 1.0), 6) * self._scatter


class LooseCarriage(Carriage):
    """A carriage on a belt with play: it follows once the play is used up, and stays where it was left."""

    def __init__(self, table: AxisTable, sensors: Sequence[WornSwitch], play_mm: float):
        super().__init__(table, sensors)
        self.switches = sensors
        self._half_play = play_mm * table.steps_per_mm / 2
        self._at = float(self.start)

    @property
    def flutters(self) -> bool:
        """A wire of its sensors may change although nothing moves."""
        return any(switch.flutters for switch in self.switches)

    def place(self, columns: float) -> float:
        """Asked twice at the same place it is the same."""
        rotor = super().place(columns)
        self._at = min(max(self._at, rotor - self._half_play), rotor + self._half_play)
        return self._at
