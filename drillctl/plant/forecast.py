"""Where the rotors of the ideal plant will be after many columns, without driving it through each of them.

Rule: a rotor that follows its phase table rests where the column's equilibrium is nearest to what was commanded; of a
table that a rotor could not follow nothing is forecast. execution/fastforward knows it as its PlantFacts.
"""

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.machine import AxisTable, Machine
from drillctl.plant.ideal import IdealPlant
from drillctl.plant.rotor import FULL_TURN, HALF_TURN, PulseRotor, Rotor, WindingRotor

Memory = tuple[Any, ...]
Degrees = NDArray[np.float64]
Counts = NDArray[np.int64]


class PlantForecast:
    """An ideal plant with a machine's tables beside it. Travel is in columns since power-up, as the wires have it."""

    def __init__(self, machine: Machine, plant: IdealPlant):
        self._plant = plant
        pairs = zip(plant.rotors, machine.axes, strict=True)
        self._follows = [_rotor_forecast(rotor, table) for rotor, table in pairs]

    @property
    def inputs(self) -> int:
        """The input image, as the driver latches it."""
        return self._plant.inputs

    def stands(self, axis: int, travel: int, turn: int) -> bool:
        """Returns whether the rotor is where so many columns have put it, and will follow any further ones. ``turn`` is
        the way it goes, 1 or -1: it tells where a drive is in the middle of a pulse.
        """
        return self._follows[axis].stands(travel, turn)

    def free(self, axis: int) -> tuple[float, float]:
        """Returns the travels between which (neither included) no sensor changes and no bit meets the board."""
        return self._travels(axis, self._plant.quiet_steps(axis))

    def free_of_switches(self, axis: int) -> tuple[float, float]:
        """Returns the same, but that the index of the axis's encoder may change (``index_levels``)."""
        return self._travels(axis, self._plant.quiet_steps(axis, whatever_index=True))

    def _travels(self, axis: int, places: tuple[float, float]) -> tuple[float, float]:
        low, high = places
        carriage, slack = self._plant.carriages[axis], self._follows[axis].slack_columns
        ends = sorted((steps - carriage.start) / carriage.steps_per_column for steps in (low, high))
        return ends[0] + slack, ends[1] - slack

    def follow(self, axis: int, travel: int, turn: int) -> None:
        """Moves the rotor to where so many columns put it; ``turn`` as for ``stands``."""
        self._plant.rotors[axis].degrees = self._follows[axis].degrees_at(travel, turn)
        self._plant.turn_index(axis)

    def memory(self, axis: int) -> Memory:
        """Returns all state of an axis's rotor and sensors."""
        return self._plant.rotors[axis].degrees, *self._plant.memory(axis)

    def recall(self, axis: int, memory: Memory) -> None:
        """Restores the state that ``memory`` returned."""
        self._plant.rotors[axis].degrees = memory[0]
        self._plant.recall(axis, memory[1:])

    def index_mask(self, axis: int) -> int:
        """Returns the input bit of the index of an axis's encoder, 0 where it has none."""
        pulses = self._plant.carriages[axis].pulses
        return 0 if pulses is None else pulses.bit

    def index_levels(self, axis: int, travel: int, turns: Counts, column: Counts) -> Counts:
        """Returns the input bit of an axis's index after each of n turns, (n,); otherwise as ``lanes``."""
        rotor, carriage = self._plant.rotors[axis], self._plant.carriages[axis]
        degrees = self._follows[axis].degrees_through(travel + np.cumsum(turns), turns, column)
        columns = (degrees - rotor.zero) * rotor.columns_per_cycle / FULL_TURN
        assert carriage.pulses is not None
        return carriage.pulses.levels(carriage.start + columns * carriage.steps_per_column)

    def lanes(self, axis: int, travel: int, turns: Counts, column: Counts) -> list[Counts]:
        """Returns the plant's lanes (``IdealPlant.lanes``) of an axis after each of n turns, (n,) each.

        travel  columns before the first turn; the rotor is where they put it
        turns   columns put out in each row, (n,): 1, 0 or -1, as the wires have it
        column  the column that stands then, from 0, (n,)
        """
        rotor, carriage = self._plant.rotors[axis], self._plant.carriages[axis]
        travels = travel + np.cumsum(turns)
        degrees = self._follows[axis].degrees_through(travels, turns, column)
        columns = (degrees - rotor.zero) * rotor.columns_per_cycle / FULL_TURN
        behind = travels * FULL_TURN / rotor.columns_per_cycle + rotor.zero - degrees
        lost = np.where(abs(behind) > rotor.half_rest, behind * rotor.columns_per_cycle / FULL_TURN, 0.0)
        scale = carriage.steps_per_column
        lanes = carriage.start + columns * scale, lost * scale / abs(scale)
        return [np.rint(lane).astype(np.int64) for lane in lanes]

    def settle(self, image: int, met: Sequence[int]) -> None:
        """Sets the output image at the end; meanwhile the bits of these axes have met their boards."""
        self._plant.image = image
        self._plant.touches += len(met)
        for axis in met:
            self._plant.met[axis] += 1
        for rotor in self._plant.rotors:
            rotor.see(image & rotor.mask)


class _Winding:
    """A stepper that follows: at most ``slack`` degrees off what is commanded, by column of its phase table."""

    def __init__(self, rotor: WindingRotor, table: AxisTable):
        self._rotor, self._length = rotor, table.phase.columns
        self._angles = _equilibria(rotor, table)
        self._degrees = FULL_TURN / rotor.columns_per_cycle
        off = [_nearest(angle, self._commanded(c + 1)) - self._commanded(c + 1) for c, angle in enumerate(self._angles)]
        self._slack = max(map(abs, off), default=float(FULL_TURN))
        whole_cycles = self._length % rotor.columns_per_cycle == 0
        self._followable = bool(off) and whole_cycles and 2 * self._slack + self._degrees < HALF_TURN
        self.slack_columns = self._slack / self._degrees

    def stands(self, travel: int, turn: int) -> bool:
        """Returns whether the rotor is within the slack of what is commanded, so that the next column draws it on."""
        return self._followable and abs(self._commanded(travel) - self._rotor.degrees) <= self._slack

    def degrees_at(self, travel: int, turn: int) -> int:
        """Returns the equilibrium of the column that is reached (the first one forward is column 0)."""
        return _nearest(self._angles[(travel - 1) % self._length], self._commanded(travel))

    def degrees_through(self, travels: Counts, turns: Counts, column: Counts) -> Degrees:
        """Returns where the rotor is after each turn, (n,): where it was until the first one."""
        commanded = travels * self._degrees + self._rotor.zero
        angles = np.array(self._angles)[(travels - 1) % self._length]
        found: Degrees = angles + FULL_TURN * np.rint((commanded - angles) / FULL_TURN)
        return np.where(np.cumsum(turns != 0) == 0, self._rotor.degrees, found)

    def _commanded(self, travel: int) -> float:
        return travel * self._degrees + self._rotor.zero


class _Pulsed:
    """A drive whose table is one pulse long: it counts whole steps."""

    def __init__(self, rotor: PulseRotor, table: AxisTable):
        self._rotor = rotor
        pulse = next(wire for wire in table.phase.wires if wire.name == table.motor.pulse)
        once = all(sum(wire) == 1 and wire[0] for wire in (pulse.forward, pulse.backward))
        self._followable = once and table.phase.columns == rotor.columns_per_cycle == table.columns_per_step
        self.slack_columns = rotor.columns_per_cycle - 1.0  # a pulse rises in the first column of its step

    def stands(self, travel: int, turn: int) -> bool:
        """Returns whether the count is just where it was sent."""
        return self._followable and self._rotor.degrees == self.degrees_at(travel, turn)

    def degrees_at(self, travel: int, turn: int) -> int:
        """Returns the count after so many columns: one turn for each step, from the rise of its pulse on."""
        steps = -(-travel * turn // self._rotor.columns_per_cycle) * turn
        return self._rotor.zero + steps * FULL_TURN

    def degrees_through(self, travels: Counts, turns: Counts, column: Counts) -> Degrees:
        """Returns the count after each turn, (n,): the pulse rises in the table's first column."""
        return self._rotor.degrees + FULL_TURN * np.cumsum(turns * (column == 0)).astype(np.float64)


def _rotor_forecast(rotor: Rotor, table: AxisTable) -> _Winding | _Pulsed:
    if isinstance(rotor, PulseRotor):
        return _Pulsed(rotor, table)
    assert isinstance(rotor, WindingRotor)
    return _Winding(rotor, table)


def _equilibria(rotor: WindingRotor, table: AxisTable) -> list[int]:
    """Returns where each column pulls the rotor; nothing where a column pulls nowhere, or elsewhere when reversing."""
    found = []
    for column in range(table.phase.columns):
        angles = {rotor.equilibrium[on & rotor.winding_mask] for on in _patterns(table, column)}
        angle = angles.pop()
        if angle is None or angles:
            return []
        found.append(angle)
    return found


def _patterns(table: AxisTable, column: int) -> list[int]:
    """Returns the patterns that may be on in a column: forward and backward, with and without forcing."""
    found = []
    for way, holding in product(("forward", "backward"), (False, True)):
        pairs = zip(table.phase.wires, table.wire_bits, strict=True)
        wires = ((wire, bit) for wire, bit in pairs if not (holding and wire.forcing))
        found.append(sum(1 << bit for wire, bit in wires if getattr(wire, way)[column]))
    return found


def _nearest(angle: int, commanded: float) -> int:
    """Returns the angle, whole turns added, that is nearest to what is commanded."""
    return angle + FULL_TURN * round((commanded - angle) / FULL_TURN)
