"""What every plant offers to the card in front of it and to the ticker that reads it.

Rule: everything follows from the output images; the inputs follow from where the carriages are.
"""

from collections.abc import Mapping, Sequence
from math import inf

from drillctl.machine import Machine
from drillctl.plant.carriage import Carriage, Switch
from drillctl.plant.chucks import Chucks
from drillctl.plant.effects import Effect
from drillctl.plant.rotor import Rotor
from drillctl.plant.spindle import spindle_of

# Signals of an axis in a trace, by the suffix of the axis's name: the carriage's place in whole steps; the columns by
# which it is behind the controller (its lag, and at rest its lost steps); the current that pulls in each phase, in
# mA, of as many phases as the motor with most of them has.
PLACE_LANES = ("", "_behind")
CURRENT_LANES = ("_i1_mA", "_i2_mA", "_i3_mA", "_i4_mA", "_i5_mA")


class Plant:
    """A machine beyond the ports.

    lanes      the signals that a trace has of each axis: some of those above
    described  the plant in a word or some, for a trace's header; ``seed`` is that of its random numbers
    inputs     the input image, 1 where a sensor's wire is high
    touches    how often a head's bit has met its board, coming down; ``met``: the same by axis
    chucks     those of the heads, with the bits in them
    effects    what the carriages act on beside their sensors, by name (effects.py)
    spindle    a spindle with its converter, where the machine has one that says its speed
    """

    lanes: tuple[str, ...] = PLACE_LANES
    described = ""
    seed = 0

    def __init__(
        self, machine: Machine, rotors: Sequence[Rotor], carriages: Sequence[Carriage], chucks: Chucks,
        effects: Mapping[str, Effect],
    ):  # fmt: skip
        self.rotors, self.carriages = tuple(rotors), tuple(carriages)
        self.image = 0
        self._together = _lines([sensor for carriage in self.carriages for sensor in carriage.sensors])
        self.inputs = sum(1 << line.bit for line in machine.inputs if line.active_level == 0)  # nothing is pressed
        self.touches, self.met = 0, [0] * len(self.rotors)
        self.spindle = spindle_of(machine)
        self.chucks = chucks
        self.inputs = chucks.shown(self.inputs)
        self._steps_per_mm = [table.steps_per_mm for table in machine.axes]
        self.effects = effects
        self._effects_on = [[each for each in effects.values() if each.axis == n] for n in range(len(self.rotors))]
        for index in range(len(self.rotors)):
            self._carry(index)
        for sensors in self._together.values():
            self._answer(sensors[0])
        self.touches, self.met = 0, [0] * len(self.rotors)  # a bit that starts in the board has not come down to it

    def drive(self, image: int) -> None:
        """Takes the output image of one tick. To be called once a tick, whether it changed or not."""
        raise AssertionError("a plant is ideal or dynamic")

    def set_rate(self, tick_hz: int) -> None:
        """Takes a new tick rate: a tick lasts 1 / tick_hz seconds from now on. Only a plant that has time needs it."""

    def position_steps(self, axis: int) -> float:
        """Returns where a carriage is, in steps from machine zero as the machine's file means it."""
        return self.carriages[axis].place(self.rotors[axis].columns)

    def lost_steps(self, axis: int, travelled: int) -> float:
        """Returns how many steps a rotor is from the place of a controller that put out ``travelled`` columns: 0 within
        the right rest.
        """
        scale = self.carriages[axis].steps_per_column
        turned = -travelled if scale < 0 else travelled
        return self.rotors[axis].columns_lost(turned) * scale

    def behind_steps(self, axis: int, travelled: int) -> float:
        """Returns how many steps a carriage is behind the controller's position, as far as this plant can tell."""
        return self.lost_steps(axis, travelled)

    def lane_values(self, axis: int, travelled: int) -> tuple[int, ...]:
        """Returns the present value of each of ``lanes``."""
        behind_columns = self.behind_steps(axis, travelled) / abs(self.carriages[axis].steps_per_column)
        return round(self.position_steps(axis)), round(behind_columns)

    def quiet_steps(self, axis: int, whatever_index: bool = False) -> tuple[float, float]:
        """Returns the places between which (neither included) no sensor of an axis changes, and nothing that it acts
        on: no bit meets or leaves the board. With ``whatever_index`` the index of its encoder may change.
        """
        bounds = [sensor.changes_at() for sensor in self.carriages[axis].sensors]
        bounds += [effect.changes_at() for effect in self._effects_on[axis]]
        pulses = self.carriages[axis].pulses
        if pulses is not None and not whatever_index:
            bounds.append(pulses.changes_at(self.position_steps(axis)))
        return max((low for low, _ in bounds), default=-inf), min((high for _, high in bounds), default=inf)

    def _answer(self, sensor: Switch) -> None:
        """Takes over the level of a sensor's wire; a line that several share is on where any of them is reached."""
        levels = [each.level for each in self._together[sensor.bit]]
        level = max(levels) if sensor.active_level else min(levels)
        self.inputs = self.inputs | sensor.bit if level else self.inputs & ~sensor.bit

    def turn_index(self, axis: int) -> None:
        """Lets the index of an axis's encoder answer to where the axis is."""
        self._turn_index(axis, self.position_steps(axis))

    def _turn_index(self, axis: int, steps: float) -> None:
        pulses = self.carriages[axis].pulses
        if pulses is not None:
            self.inputs = self.inputs & ~pulses.bit | pulses.level(steps)

    def place_mm(self, axis: int) -> float:
        """Returns where a carriage is, in millimetres from machine zero."""
        return self.position_steps(axis) / self._steps_per_mm[axis]

    def _switch_chucks(self, before: int, image: int) -> bool:
        """Opens and closes the chucks whose outputs differ between two output images; returns whether any did."""
        if not (before ^ image) & self.chucks.outputs:
            return False
        self.chucks.switch(before, image, self.place_mm)
        self.inputs = self.chucks.shown(self.inputs)
        return True

    def _carry(self, index: int) -> None:
        steps = self.position_steps(index)
        self._turn_index(index, steps)
        if self.chucks.slipping and self.chucks.lifted(index, self.place_mm(index)):
            self.inputs = self.chucks.shown(self.inputs)
        for sensor in self.carriages[index].sensors:
            if sensor.moved_to(steps):
                self._answer(sensor)
        for effect in self._effects_on[index]:
            if effect.moved_to(steps):
                self.touches += 1
                self.met[index] += 1
            if effect.line.bit:
                self.inputs = effect.line.put(self.inputs, effect.state)


def _lines(sensors: Sequence[Switch]) -> Mapping[int, Sequence[Switch]]:
    """Returns the sensors on each line, by the line's input bit."""
    lines: dict[int, list[Switch]] = {}
    for sensor in sensors:
        lines.setdefault(sensor.bit, []).append(sensor)
    return lines
