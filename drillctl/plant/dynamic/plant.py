"""The dynamic plant: motors that lag, swing and lose steps, sensors that scatter, a drill that wears.

Rule: one tick of time for each image, so it must be driven once a tick; what it does follows from the images, the
tables, its faults and the seed, to the bit.
"""

from array import array
from collections.abc import Sequence
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.head_lines import alarm_input
from drillctl.plant.base import CURRENT_LANES, PLACE_LANES, Plant
from drillctl.plant.carriage import Line, Pulses
from drillctl.plant.chucks import chucks_of
from drillctl.plant.dynamic import law, motors
from drillctl.plant.dynamic.drilling import Bit, Bits, FaultySwitch, LooseCarriage
from drillctl.plant.dynamic.kernel import KERNEL, Kernel
from drillctl.plant.dynamic.rotor import DynamicRotor
from drillctl.plant.effects import Board, effects_of
from drillctl.plant.faults import Faults, PlantRefused


class DynamicPlant(Plant):
    """A machine all of whose axes have dynamics. Raises PlantRefused for another, and for faults it can't have.

    motors, belts   its rotors and carriages, with the types that they have here
    """

    def __init__(self, machine: Machine, faults: Sequence[str] = (), seed: int = 0, kernel: Kernel = KERNEL):
        self.described = " ".join(("dynamic", *faults))
        self.seed = seed
        known_faults = Faults(faults, machine)
        _check_dynamics(machine)
        axes = range(len(machine.axes))
        self._kernel = kernel
        self.motors = [
            DynamicRotor(table, machine.tick_hz, known_faults.of("jammed", table.name) or 1.0, kernel)
            for table in machine.axes
        ]
        self.belts = [_belt(machine, index, known_faults, seed) for index in axes]
        self._phases = max(len(motor.pulling()) for motor in self.motors)
        self.lanes = (*PLACE_LANES, *CURRENT_LANES[: self._phases])
        self._rows = kernel.numbers([0.0] * law.ROW * len(axes))
        for index, (motor, belt) in enumerate(zip(self.motors, self.belts, strict=True)):
            motor.lie_in(self._rows, index * law.ROW)
            belt.lie_in(self._rows, index * law.ROW, machine.axes[index].steps_per_mm)
        self._wires = array("Q", [*chain.from_iterable(motor.wires() for motor in self.motors), 0])
        for index in axes:
            kernel.supply(self._rows, index * law.ROW, self._wires, index * motors.WIRES, 0)
        chucks = chucks_of(machine, known_faults)
        effects = effects_of(machine, chucks)
        boards = {each.axis: each for each in effects.values() if isinstance(each, Board)}
        if known_faults.of("broken"):
            effects = {name: each for name, each in effects.items() if not isinstance(each, Board)}
            boards = {}
        super().__init__(machine, self.motors, self.belts, chucks, effects)
        self._bits = Bits(machine, boards, known_faults, kernel)
        for head in machine.drill_axes:
            self._rows[head * law.ROW + law.CARRIES] = 1.0
        self._bound()
        self._alarms = [Line.of(alarm_input(machine, table.name)) for table in machine.axes]
        self._resting = False
        self._tick_hz = machine.tick_hz
        self._one = np.zeros(1, np.uint64)

    @property
    def bits(self) -> tuple[Bit, ...]:
        """The bits of the heads, in the order of the machine's file; those that meet a board."""
        return tuple(bit for bit in self._bits.of if bit.mounted)

    def drive(self, image: int) -> None:
        """Computes one tick with this image at the card. Nothing is computed while a whole tick changed nothing."""
        if not self._resting or image != self.image:
            self._one[0] = image
            self._advance(self._one, 1)

    def run(self, images: NDArray[np.uint64]) -> int:
        """Computes a tick for each image (ticks,), up to the first one that changes the inputs, or in which the bit
        meets the board; returns how many.
        """
        inputs, touches, done = self.inputs, self.touches, 0
        while done < len(images) and (inputs, touches) == (self.inputs, self.touches):
            done += self._advance(images[done:], 1 if self._fluttering else len(images) - done)
        return done

    def set_rate(self, tick_hz: int) -> None:
        """Goes on from the present state, in ticks of another length."""
        for motor in self.motors:
            motor.set_rate(tick_hz)
        self._tick_hz = tick_hz
        self._resting = False

    def position_steps(self, axis: int) -> float:
        """Returns where a carriage is, in steps from machine zero as the machine's file means it."""
        return self._rows[axis * law.ROW + law.PLACE]

    def _advance(self, images: NDArray[np.uint64], ticks: int) -> int:
        """Computes at most so many ticks, up to one in which a sensor may change; returns how many."""
        kernel, bits = self._kernel, self._bits.columns
        if self._spindle_turns(int(images[0])):
            ticks = 1
        done = kernel.run(
            self._rows, len(self.motors), len(self._bits.of), self._wires, bits, kernel.images(images), ticks,
            kernel.sine, kernel.slope,
        )  # fmt: skip
        before, self.image = self.image, int(images[done - 1])
        for motor in self.motors:
            motor.follow()
        if self._fluttering or bits[law.LEFT]:
            self._pass_sensors()
        if self._switch_chucks(before, self.image):
            self._bound()
        if self.spindle is not None:
            self.inputs = self.spindle.turn(self.image, self.inputs, done / self._tick_hz)
        self._resting = bits[law.STILL] != 0.0 and not self._fluttering and not self._spindle_turns(self.image)
        return done

    def _spindle_turns(self, image: int) -> bool:
        """Whether the spindle's speed changes with this image."""
        return self.spindle is not None and self.spindle.turns_on(image)

    def _pass_sensors(self) -> None:
        """Lets the sensors of the axes that moved, or whose wires flutter, answer to where the carriages are."""
        self._bits.break_off(self.chucks)
        for index, belt in enumerate(self.belts):
            if belt.flutters or self._rows[index * law.ROW + law.MOVED]:
                self._carry(index)
        for line, motor in zip(self._alarms, self.motors, strict=True):
            if motor.tripped:
                self.inputs = line.put(self.inputs, True)
        self._bound()

    def _bound(self) -> None:
        """Notes between which places no sensor changes and the bit neither meets nor leaves the board."""
        self._fluttering = any(belt.flutters for belt in self.belts)
        self._bits.follow(self.chucks)
        for index in range(len(self.motors)):
            begin = index * law.ROW
            self._rows[begin + motors.LOW], self._rows[begin + motors.HIGH] = self.quiet_steps(index)

    def behind_steps(self, axis: int, travelled: int) -> float:
        """Returns lag, friction, play and lost steps together."""
        belt = self.belts[axis]
        return belt.start + travelled * abs(belt.steps_per_column) - self.position_steps(axis)

    def lane_values(self, axis: int, travelled: int) -> tuple[int, ...]:
        """Returns place, distance behind, and the current of each phase; 0 for a phase that the motor lacks."""
        pulling = self.motors[axis].pulling()
        missing = (0,) * (self._phases - len(pulling))
        return (*super().lane_values(axis, travelled), *(round(1000 * each) for each in pulling), *missing)


def _check_dynamics(machine: Machine) -> None:
    lacking = [axis.name for axis in machine.axes if axis.dynamics is None]
    if lacking:
        names = ", ".join(lacking)
        raise PlantRefused(
            Message(
                "{name} has no dynamics for {names}; docs/PLANT.md says how to name some",
                name=machine.name,
                names=names,
            )
        )


def _belt(machine: Machine, index: int, known_faults: Faults, seed: int) -> LooseCarriage:
    table = machine.axes[index]
    switches = [
        FaultySwitch(sensor, table.steps_per_mm, machine.surroundings.scatter_mm, known_faults, seed)
        for sensor in machine.sensors
        if sensor.axis == index
    ]
    encoder = machine.index_of(index)
    pulses = None if encoder is None else Pulses(encoder, known_faults.of("stuck", encoder.name))
    return LooseCarriage(table, switches, known_faults.of("loose", table.name) or 0.0, pulses)
