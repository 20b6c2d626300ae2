"""What a rotor moves, and the sensors that it passes. Without faults here; with wear and play in plant/dynamic.

Places are steps from machine zero as the machine's file means it.
"""

from collections.abc import Sequence
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.machine import AxisTable, EncoderIndex, Sensor
from drillctl.machine.model import Input

Places = NDArray[np.float64]


class Switch:
    """A sensor with hysteresis: whether it is reached, and its wire's level."""

    def __init__(self, sensor: Sensor):
        self.bit = 1 << sensor.bit
        self.level = 0
        self.reached = False
        self.active_level = sensor.active_level
        self._outward = -1 if sensor.end == "min" else 1
        self._edge = float(sensor.edge_steps * self._outward)
        self._hysteresis = sensor.hysteresis_steps

    def moved_to(self, steps: float) -> bool:
        """Takes the carriage's new place; returns whether the wire's level has changed."""
        level = self.active_level if self._answers(steps * self._outward) else 1 - self.active_level
        changed = level != self.level
        self.level = level
        return changed

    def changes_at(self) -> tuple[float, float]:
        """Returns the places between which (neither included) the sensor stays as it is."""
        beyond = (self._edge - self._hysteresis if self.reached else self._edge) * self._outward
        return (beyond, inf) if self.reached == (self._outward > 0) else (-inf, beyond)

    def recall(self, reached: bool) -> bool:
        """Sets the sensor to an earlier state; returns whether that changes the wire's level."""
        before, self.reached = self.level, reached
        self.level = self.active_level if reached else 1 - self.active_level
        return self.level != before

    def _answers(self, outward: float) -> bool:
        """Returns whether the sensor is reached: on from the edge outwards, off again a hysteresis inwards."""
        if outward >= self._edge:
            self.reached = True
        elif outward <= self._edge - self._hysteresis:
            self.reached = False
        return self.reached


class Line:
    """An input that the plant switches: ``bit`` in the input image, 0 where the machine has no such input."""

    def __init__(self, bit: int = 0, active_level: int = 1):
        self.bit = bit
        self._active = active_level

    @classmethod
    def of(cls, line: Input | None) -> "Line":
        """From an input of the machine's file."""
        return cls() if line is None else cls(1 << line.bit, line.active_level)

    def put(self, inputs: int, on: bool) -> int:
        """Returns the input image with the line on or off."""
        return inputs | self.bit if on == bool(self._active) else inputs & ~self.bit


class Pulses:
    """The index of an axis's encoder, which is on once a turn. It follows from the place alone.

    stuck   0 or 1: it is off or on, whatever the place
    """

    def __init__(self, index: EncoderIndex, stuck: float | None = None):
        self.bit = 1 << index.bit
        self._first = index.at_steps - index.width_steps / 2
        self._turn, self._width = index.turn_steps, index.width_steps
        self._active = index.active_level
        self._stuck = None if stuck is None else bool(stuck)

    def levels(self, steps: Places) -> NDArray[np.int64]:
        """Returns the input bit as it stands at each of these places, (n,)."""
        on = self._since_first(steps) < self._width if self._stuck is None else np.full(len(steps), self._stuck)
        levels: NDArray[np.int64] = np.where(on == bool(self._active), self.bit, 0)
        return levels

    def level(self, steps: float) -> int:
        """Returns the input bit as it stands at a place: 0 where its wire is low."""
        on = self._since_first(steps) < self._width if self._stuck is None else self._stuck
        return self.bit if on == bool(self._active) else 0

    def changes_at(self, steps: float) -> tuple[float, float]:
        """Returns the places around this one between which (neither included) it stays as it is."""
        if self._stuck is not None:
            return -inf, inf
        begin = self._first + (steps - self._first) // self._turn * self._turn
        end = begin + self._width
        return (begin, end) if self._since_first(steps) < self._width else (end, begin + self._turn)

    def _since_first(self, steps: Any) -> Any:
        """Returns the steps since the last pulse began; of one place, or of each of an array."""
        off = steps - self._first
        return off - off // self._turn * self._turn


class Carriage:
    """A carriage fixed to its rotor: it moves as far from its start as the rotor has turned."""

    def __init__(self, table: AxisTable, sensors: Sequence[Switch], pulses: Pulses | None = None):
        self.start = table.start_steps
        self.steps_per_column = (-1 if table.invert else 1) / table.columns_per_step
        self.sensors = sensors
        self.pulses = pulses

    def place(self, columns: float) -> float:
        """Returns where it is once the rotor has turned by so many columns."""
        return self.start + columns * self.steps_per_column
