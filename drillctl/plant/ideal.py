"""The ideal plant: motors without inertia, friction or lag; carriages, end sensors, the drill bit and the board.

Rule: it moves at once when its image changes. Speed, ramp and forcing make no difference to it.
"""

from drillctl.machine import Machine
from drillctl.plant.base import Plant
from drillctl.plant.carriage import Carriage, Pulses, Switch
from drillctl.plant.chucks import chucks_of
from drillctl.plant.effects import effects_of
from drillctl.plant.rotor import rotor_of


class IdealPlant(Plant):
    """A machine whose rotors are at once where their windings pull them."""

    described = "ideal"

    def __init__(self, machine: Machine):
        rotors = [rotor_of(table) for table in machine.axes]
        carriages = [_carriage(machine, number) for number in range(len(machine.axes))]
        chucks = chucks_of(machine)
        super().__init__(machine, rotors, carriages, chucks, effects_of(machine, chucks))

    def drive(self, image: int) -> None:
        """Takes a new output image: each rotor whose bits changed moves, and its carriage with it."""
        if image == self.image:
            return
        before, self.image = self.image, image
        if self.spindle is not None:
            self.inputs = self.spindle.at_once(image, self.inputs)
        for index, rotor in enumerate(self.rotors):
            pattern = image & rotor.mask
            if pattern != rotor.seen:
                rotor.seen = pattern
                if rotor.pull(pattern):
                    self._carry(index)
        self._switch_chucks(before, image)

    def memory(self, axis: int) -> tuple[bool, ...]:
        """Returns the state of what an axis acts on, then of its sensors, and whether its chuck holds a bit."""
        states = [effect.state for effect in self._effects_on[axis]]
        reached = [sensor.reached for sensor in self.carriages[axis].sensors]
        chuck = self.chucks.of(axis)
        return *states, *reached, chuck is not None and chuck.held

    def recall(self, axis: int, memory: tuple[bool, ...]) -> None:
        """Restores the state that ``memory`` returned; no stroke has opened a chuck since."""
        effects = self._effects_on[axis]
        for effect, state in zip(effects, memory, strict=False):
            effect.state = state
            self.inputs = effect.line.put(self.inputs, state)
        for sensor, reached in zip(self.carriages[axis].sensors, memory[len(effects) : -1], strict=True):
            if sensor.recall(reached):
                self._answer(sensor)
        self.turn_index(axis)


def _carriage(machine: Machine, axis: int) -> Carriage:
    switches = [Switch(sensor) for sensor in machine.sensors if sensor.axis == axis]
    index = machine.index_of(axis)
    return Carriage(machine.axes[axis], switches, None if index is None else Pulses(index))
