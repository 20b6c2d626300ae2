"""The ideal plant behind the simulated card: carriages, sensors with hysteresis and polarity, the bit on the board."""

from dataclasses import replace
from typing import Any

import pytest

from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.portio.playback import PlaybackCard
from drillctl.portio.simulated import SimulatedCard
from drillctl.ports import CARD_BITS, CARD_MASK, SAFE_IMAGE, word


class Hand:
    """Turns one axis of a plant column by column, as a controller would, counting steps."""

    def __init__(self, plant: IdealPlant, machine: Machine, axis: int):
        self.plant, self.axis, self.table = plant, axis, machine.axes[axis]
        self.at = -1

    def to(self, steps: int) -> None:
        """To a place in the machine file's steps, in whole columns."""
        sense = -1 if self.table.invert else 1
        wanted = sense * (steps - self.table.start_steps) * self.table.columns_per_step - 1
        while self.at != wanted:
            self.at += 1 if wanted > self.at else -1
            self.plant.drive(self._image())

    def _image(self) -> int:
        others = self.plant.image & ~sum(1 << bit for bit in self.table.wire_bits)
        wires = zip(self.table.phase.wires, self.table.wire_bits, strict=True)
        return others | sum(1 << bit for wire, bit in wires if wire.forward[self.at % self.table.phase.columns])


def levels(machine: Machine, plant: IdealPlant) -> dict[str, int]:
    return {sensor.name: plant.inputs >> sensor.bit & 1 for sensor in machine.sensors}


def with_sensor(machine: Machine, name: str, **changes: Any) -> Machine:
    sensors = tuple(replace(s, **changes) if s.name == name else s for s in machine.sensors)
    return replace(machine, sensors=sensors)


def test_at_power_up_the_sensors_tell_where_the_carriages_stand(drill: Machine) -> None:
    plant = IdealPlant(drill)
    assert levels(drill, plant) == dict.fromkeys(levels(drill, plant), 0) | {"z_top": 1}
    assert [plant.position_steps(axis) for axis in range(3)] == [axis.start_steps for axis in drill.axes]
    assert plant.touches == 0


@pytest.mark.parametrize("active_level", [0, 1])
@pytest.mark.parametrize("hysteresis", [0, 6, 12])
@pytest.mark.parametrize(("name", "edge", "inwards"), [("x_min", 1000, 1), ("x_max", 1400, -1)])
def test_sensor_is_on_from_its_edge_and_off_a_hysteresis_back(
    name: str, edge: int, inwards: int, hysteresis: int, active_level: int, drill: Machine
) -> None:
    """The rotor rests every third column, so the edge is met to within a rest."""
    machine = with_sensor(drill, name, edge_steps=edge, hysteresis_steps=hysteresis, active_level=active_level)
    plant = IdealPlant(machine)
    hand = Hand(plant, machine, 0)

    outermost, innermost = edge - 40 * inwards, edge + 40 * inwards
    hand.to(innermost)
    switched, before = [], False
    for steps in (*range(innermost, outermost, -inwards), *range(outermost, innermost, inwards)):
        hand.to(steps)
        reached = levels(machine, plant)[name] == active_level
        if reached != before:
            switched.append((reached, plant.position_steps(0)))
            before = reached
    assert [on for on, _ in switched] == [True, False]
    assert 0 <= inwards * (edge - switched[0][1]) < 3
    assert 0 <= inwards * (switched[1][1] - edge) - hysteresis <= 3


def test_a_sensor_between_edge_and_hysteresis_keeps_what_it_said(drill: Machine) -> None:
    machine = with_sensor(drill, "x_min", edge_steps=1000, hysteresis_steps=30)
    plant = IdealPlant(machine)
    hand = Hand(plant, machine, 0)
    for outwards, inside, level in ((1010, 1020, 0), (990, 1020, 1), (1040, 1010, 0)):
        hand.to(outwards)
        hand.to(inside)
        assert levels(machine, plant)["x_min"] == level


def test_an_inverted_axis_goes_the_other_way(drill: Machine) -> None:
    axes = (replace(drill.axes[0], invert=True), *drill.axes[1:])
    machine = replace(drill, axes=axes)
    plant = IdealPlant(machine)
    hand = Hand(plant, machine, 0)
    hand.to(1500)
    assert abs(plant.position_steps(0) - 1500) <= 1.5
    assert plant.rotors[0].columns < 0


def test_a_descent_into_the_board_is_one_touch(drill: Machine) -> None:
    """However the bit pecks about inside the board: once a descent, again after coming out."""
    surface = drill.board_surface[2]
    assert surface is not None
    plant = IdealPlant(drill)
    hand = Hand(plant, drill, 2)
    touches = []
    for depth in (surface - 9, surface + 9, surface + 60, surface + 20, surface + 60, surface - 9, 0, surface + 9):
        hand.to(depth)
        touches.append(plant.touches)
    assert touches == [0, 1, 1, 1, 1, 1, 1, 2]


def test_a_machine_without_a_board_has_no_touches(drill: Machine) -> None:
    machine = replace(drill, board_surface=(None, None, None))
    plant = IdealPlant(machine)
    Hand(plant, machine, 2).to(700)
    assert plant.touches == 0 and abs(plant.position_steps(2) - 700) <= 1.5


def test_one_axis_moves_alone(drill: Machine) -> None:
    plant = IdealPlant(drill)
    Hand(plant, drill, 0).to(1300)
    assert abs(plant.position_steps(0) - 1300) <= 1.5
    assert [plant.position_steps(axis) for axis in (1, 2)] == [drill.axes[1].start_steps, drill.axes[2].start_steps]


def test_bits_that_no_motor_has_move_nothing(drill: Machine) -> None:
    plant = IdealPlant(drill)
    wired = sum(1 << bit for axis in drill.axes for bit in axis.wire_bits)
    plant.drive(CARD_MASK & ~wired)
    assert [rotor.columns for rotor in plant.rotors] == [0, 0, 0]


def test_the_simulated_card_flushes_to_the_plant_and_latches_from_it(drill: Machine) -> None:
    plant = IdealPlant(drill)
    card = SimulatedCard(plant)
    assert card.latch() == plant.inputs != 0
    card.flush(0x25)
    assert plant.image == 0x25
    stood = [rotor.degrees for rotor in plant.rotors]
    card.safe()
    assert plant.image == SAFE_IMAGE and [rotor.degrees for rotor in plant.rotors] == stood
    card.flush(0x25)
    card.close()
    assert plant.image == SAFE_IMAGE


def test_playback_gives_each_tick_its_inputs_and_keeps_the_outputs() -> None:
    card = PlaybackCard([0, 2, 5], [1, 3, 0])
    latched = []
    for tick in range(7):
        latched.append(card.latch())
        assert card.latch() == latched[-1]  # asked twice in a tick, the same
        card.flush(tick + 100)
    assert latched == [1, 1, 3, 3, 3, 0, 0] and card.tick == 7 and card.image == 106
    card.close()
    assert card.image == SAFE_IMAGE


@pytest.mark.parametrize("card", [0, 1, 3])
def test_word_is_the_32_bits_of_one_card(card: int) -> None:
    image = 0x89ABCDEF << CARD_BITS * card
    assert [word(image, n) for n in range(4)] == [0x89ABCDEF if n == card else 0 for n in range(4)]
