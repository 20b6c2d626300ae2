"""The dynamic plant: motors that lag, swing and lose steps, sensors that scatter, a drill that wears.

Rule: one tick of time for each image, so it must be driven once a tick; what it does follows from the images, the
tables, its faults and the seed, to the bit.
"""

from collections.abc import Sequence

from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.plant.base import CURRENT_LANES, PLACE_LANES, Plant
from drillctl.plant.dynamic.drilling import Bit, FaultySwitch, LooseCarriage
from drillctl.plant.dynamic.rotor import DynamicRotor
from drillctl.plant.faults import Faults, PlantRefused


class DynamicPlant(Plant):
    """A machine all of whose axes have dynamics. Raises PlantRefused for another, and for faults it can't have.

    motors, belts   its rotors and carriages, with the types that they have here
    """

    lanes = (*PLACE_LANES, *CURRENT_LANES)

    def __init__(self, machine: Machine, faults: Sequence[str] = (), seed: int = 0):
        self.described = " ".join(("dynamic", *faults))
        self.seed = seed
        known_faults = Faults(faults, machine)
        _check_dynamics(machine)
        self.motors = [DynamicRotor(a, machine.tick_hz, known_faults.of("jammed", a.name) or 1.0) for a in machine.axes]
        self.belts = [_belt(machine, index, known_faults, seed) for index in range(len(machine.axes))]
        super().__init__(machine, self.motors, self.belts)
        self._others = [axis for axis in range(len(machine.axes)) if axis != self._head]
        self._scales = [axis.steps_per_mm for axis in machine.axes]
        self.bit = self._mounted_bit(machine, known_faults)
        self._resting = False

    def drive(self, image: int) -> None:
        """Computes one tick with this image at the card. Nothing is computed while a whole tick changed nothing."""
        if self._resting and image == self.image:
            return
        self.image = image
        self._resist()
        self._resting = True
        for index, motor in enumerate(self.motors):
            moved = motor.pull(image & motor.mask)
            if moved or self.belts[index].flutters:
                self._carry(index)
                self._resting = False

    def set_rate(self, tick_hz: int) -> None:
        """Goes on from the present state, in ticks of another length."""
        for motor in self.motors:
            motor.set_rate(tick_hz)
        self._resting = False

    def behind_steps(self, axis: int, travelled: int) -> float:
        """Returns lag, friction, play and lost steps together."""
        belt = self.belts[axis]
        return belt.start + travelled * abs(belt.steps_per_column) - self.position_steps(axis)

    def lane_values(self, axis: int, travelled: int) -> tuple[int, ...]:
        """Returns place, distance behind, and for each phase the current of one half winding less that of the other,
        which pulls against it.
        """
        first, against_first, against_second, second = self.motors[axis].axis.currents  # as WINDING_DEGREES has them
        pulling = round(1000 * (first - against_first)), round(1000 * (second - against_second))
        return (*super().lane_values(axis, travelled), *pulling)

    def _mounted_bit(self, machine: Machine, known_faults: Faults) -> Bit | None:
        if known_faults.of("broken"):
            self._surface = None
        if self._surface is None:
            return None
        return Bit(machine.axes[self._head], self._surface, machine.surroundings, known_faults.of("blunt") or 0.0)

    def _resist(self) -> None:
        """Sets the board's resistance for the next tick, from where the head is now."""
        if self.bit is None:
            return
        torque_nm = 0.0
        if self._in_board:
            over_mm = [self.position_steps(axis) / self._scales[axis] for axis in self._others]
            torque_nm = self.bit.torque_nm(self.position_steps(self._head), over_mm)
        self.motors[self._head].resist(torque_nm)


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
    return LooseCarriage(table, switches, known_faults.of("loose", table.name) or 0.0)
