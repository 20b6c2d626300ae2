"""The ideal plant: motors without inertia, friction or lag; carriages, end sensors, the drill bit and the board.

Rule: everything follows from the output image; the inputs follow from where the carriages are. It is blind to
speed, ramp and forcing. Called by portio/simulated; the wiring reads the rotors and ``touches``.
"""

from drillctl.machine import Machine, Sensor
from drillctl.plant.rotor import rotor_of


class IdealPlant:
    """A machine beyond the ports.

    inputs   the input image, 1 where a sensor's wire is high
    touches  how often the first head's bit has met the board, coming down
    """

    def __init__(self, machine: Machine):
        self.rotors = tuple(rotor_of(axis) for axis in machine.axes)
        self.carriages = tuple(_Carriage(machine, index) for index in range(len(machine.axes)))
        self.image = 0
        self.inputs = 0
        self.touches = 0
        self._head = machine.drill_axes[0]
        self._surface = machine.board_surface[self._head]
        self._in_board = False
        for index in range(len(self.rotors)):
            self._carry(index)

    def drive(self, image: int) -> None:
        """A new output image stands at the card."""
        if image == self.image:
            return
        self.image = image
        for index, rotor in enumerate(self.rotors):
            pattern = image & rotor.mask
            if pattern != rotor.seen:
                rotor.seen = pattern
                if rotor.pull(pattern):
                    self._carry(index)

    def position_steps(self, axis: int) -> float:
        """Where a carriage is, in steps from machine zero as the machine's file means it."""
        return self.carriages[axis].place(self.rotors[axis].columns)

    def _carry(self, index: int) -> None:
        steps = self.position_steps(index)
        for sensor in self.carriages[index].sensors:
            if sensor.moved_to(steps):
                self.inputs ^= sensor.bit
        if index == self._head and self._surface is not None:
            in_board = steps >= self._surface
            self.touches += in_board and not self._in_board
            self._in_board = in_board


class _Carriage:
    """What a rotor moves, and the sensors that it passes."""

    def __init__(self, machine: Machine, index: int):
        table = machine.axes[index]
        self.start = table.start_steps
        self.steps_per_column = (-1 if table.invert else 1) / table.columns_per_step
        self.sensors = [_Switch(sensor) for sensor in machine.sensors if sensor.axis == index]

    def place(self, columns: float) -> float:
        return self.start + columns * self.steps_per_column


class _Switch:
    """A sensor with hysteresis: its wire's level now, and whether a move has changed it."""

    def __init__(self, sensor: Sensor):
        self.bit = 1 << sensor.bit
        self.level = 0
        self._reached = False
        self._active_level = sensor.active_level
        self._outward = -1 if sensor.end == "min" else 1
        self._edge = sensor.edge_steps * self._outward
        self._hysteresis = sensor.hysteresis_steps

    def moved_to(self, steps: float) -> bool:
        """True when the wire's level has changed: on from the edge outwards, off again a hysteresis inwards."""
        outward = steps * self._outward
        if outward >= self._edge:
            self._reached = True
        elif outward <= self._edge - self._hysteresis:
            self._reached = False
        level = self._active_level if self._reached else 1 - self._active_level
        changed = level != self.level
        self.level = level
        return changed
