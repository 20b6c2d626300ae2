"""The dynamic plant as a machine: sensors that scatter and fail, belts with play, a drill that grows blunt."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from drillctl.lab.moves import move
from drillctl.machine import Library, Machine, shipped_tables
from drillctl.plant import IdealPlant, PlantChoice, PlantRefused
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.plant.dynamic.recorder import MotionRecorder, motion_of
from drillctl.plant.faults import FAULT_KINDS, fault_lines, parse_fault

LIBRARY = Library((shipped_tables(),))


class Shaft:
    """Turns one axis by whole moves of the real automaton, and tells what the sensors say after each tick."""

    def __init__(self, machine: Machine, axis: str, *faults: str, seed: int = 0):
        self.machine, self.plant = machine, DynamicPlant(machine, faults, seed)
        self.index = machine.axis_names.index(axis)
        self.columns = 0

    def by(self, steps: int, rest_ticks: int = 60) -> Iterator[float]:
        """The carriage's place after each tick of a move, and of a rest."""
        table = self.machine.axes[self.index]
        made = move(table, steps, self.columns - 1, rest_ticks)
        self.columns += int(made.columns[-1] - made.columns[0])
        for image in made.images.tolist():
            self.plant.drive(image)
            yield self.place

    @property
    def place(self) -> float:
        return self.plant.position_steps(self.index)

    def says(self, sensor: str) -> bool:
        found = next(s for s in self.machine.sensors if s.name == sensor)
        return bool(self.plant.inputs >> found.bit & 1) == bool(found.active_level)


def changes(shaft: Shaft, sensor: str, *moves: int) -> list[tuple[bool, float]]:
    """Where a sensor changes during some moves, and to what."""
    before, found = shaft.says(sensor), []
    for steps in moves:
        for place in shaft.by(steps):
            if shaft.says(sensor) != before:
                before = not before
                found.append((before, place))
    return found


@pytest.fixture
def exact(drill: Machine) -> Machine:
    """Without scatter, with room on both sides of x_min."""
    sensors = tuple(replace(s, edge_steps=1150, hysteresis_steps=9) if s.name == "x_min" else s for s in drill.sensors)
    return replace(drill, sensors=sensors, surroundings=replace(drill.surroundings, scatter_mm=0.0))


def test_at_power_up_it_stands_where_the_ideal_one_does(drill: Machine) -> None:
    ideal, dynamic = IdealPlant(drill), DynamicPlant(drill)
    assert dynamic.inputs == ideal.inputs
    assert [dynamic.position_steps(axis) for axis in range(3)] == [axis.start_steps for axis in drill.axes]


def test_a_sound_machine_loses_nothing_and_lags(drill: Machine) -> None:
    """At rest within friction of where the ideal plant is; on the way up to a full step behind."""
    shaft = Shaft(drill, "x")
    places = [*shaft.by(300)]
    assert shaft.plant.lost_steps(0, 300) == 0 and abs(shaft.plant.behind_steps(0, 300)) < 2
    assert abs(places[-1] - (1200 + 300)) < 2
    sent = move(drill.axes[0], 300, -1, 60).columns + 1200
    assert 1 < max(sent - places) < 6


def test_lost_steps_are_whole_cycles() -> None:
    """At 800 Hz the rotor stalls: the plant is where it was left, and says by how much."""
    machine = LIBRARY.machine("pcb-drill").at_rate(800)
    shaft = Shaft(machine, "x")
    *_, place = shaft.by(300)
    lost = shaft.plant.lost_steps(0, 300)
    assert lost > 100 and lost % 12 == 0
    assert shaft.plant.behind_steps(0, 300) == pytest.approx(1500 - place)
    assert abs(shaft.plant.behind_steps(0, 300) - lost) < 3


def test_an_inverted_axis_goes_the_other_way(exact: Machine) -> None:
    inverted = replace(exact, axes=(replace(exact.axes[0], invert=True), *exact.axes[1:]))
    shaft = Shaft(inverted, "x")
    *_, place = shaft.by(60)
    assert place == pytest.approx(1260, abs=2)
    assert shaft.plant.lost_steps(0, 60) == 0 and abs(shaft.plant.behind_steps(0, 60)) < 2


def test_a_sensor_answers_at_its_edge_and_lets_go_a_hysteresis_back(exact: Machine) -> None:
    (on, reached), (off, left) = changes(Shaft(exact, "x"), "x_min", -70, 70)
    assert on and reached == pytest.approx(1150, abs=1.5)
    assert not off and left == pytest.approx(1159, abs=1.5)


def test_scatter_is_drawn_for_each_approach_from_the_seed_alone(exact: Machine) -> None:
    rough = replace(exact, surroundings=replace(exact.surroundings, scatter_mm=0.2))
    there_and_back = [-70, 70] * 6
    edges = {seed: changes(Shaft(rough, "x", seed=seed), "x_min", *there_and_back) for seed in (1, 2)}
    reached = [place for on, place in edges[1] if on]
    assert edges[1] == changes(Shaft(rough, "x", seed=1), "x_min", *there_and_back) != edges[2]
    assert max(reached) - min(reached) > 5 and abs(sum(reached) / len(reached) - 1150) < 15


@pytest.mark.parametrize(("level", "start"), [(1, True), (0, False)])
def test_a_stuck_sensor_says_the_same_always(level: int, start: bool, exact: Machine) -> None:
    shaft = Shaft(exact, "x", f"stuck.x_min={level}")
    assert shaft.says("x_min") is start and not changes(shaft, "x_min", -70, 70)


def test_a_dirty_sensor_answers_too_late(exact: Machine) -> None:
    (_, reached), _ = changes(Shaft(exact, "x", "dirty.x_min=0.5"), "x_min", -100, 100)
    assert reached == pytest.approx(1150 - 0.5 * exact.axes[0].steps_per_mm, abs=1.5)


def test_a_bouncing_sensor_flutters_and_comes_to_rest(exact: Machine) -> None:
    """Eight ticks: eight levels more after the change, though the carriage may have stopped by then."""
    found = changes(Shaft(exact, "x", "bouncing.x_min=8"), "x_min", -70)
    assert [on for on, _ in found] == [False, True] * 4 or [on for on, _ in found] == [True, False] * 4 + [True]
    resting = Shaft(exact, "x", "bouncing.x_min=500")
    assert len(changes(resting, "x_min", -70)) > 50


def test_play_leaves_the_carriage_behind_on_the_way_back(exact: Machine) -> None:
    """Half of it to either side of where the rotor is; an overshoot of the rotor takes it a little further."""
    shaft, play = Shaft(exact, "x", "loose.x=1.0"), exact.axes[0].steps_per_mm
    *_, out = shaft.by(200)
    *_, back = shaft.by(-100)
    assert out == pytest.approx(1400 - play / 2, abs=4) and back == pytest.approx(1300 + play / 2, abs=4)
    assert shaft.plant.lost_steps(0, 100) == 0
    assert shaft.plant.behind_steps(0, 100) == pytest.approx(-play / 2, abs=4)


def test_a_jammed_guide_stalls_the_motor(exact: Machine) -> None:
    lost = {}
    for times in (1.1, 3):
        shaft = Shaft(exact, "x", f"jammed.x={times}")
        for _ in shaft.by(200):
            pass
        lost[times] = shaft.plant.lost_steps(0, 200)
    assert lost[1.1] == 0 and lost[3] > 100


def down(machine: Machine, *faults: str) -> tuple[DynamicPlant, float]:
    shaft = Shaft(machine, "z", *faults)
    *_, place = shaft.by(780)
    return shaft.plant, place


def test_a_sharp_drill_goes_through_and_wears_by_what_it_cuts(exact: Machine) -> None:
    plant, place = down(exact)
    assert place == pytest.approx(780, abs=2) and plant.touches == 1
    assert plant.bits[0].wear_m == pytest.approx((place - 600) / exact.axes[2].steps_per_mm / 1000, rel=0.05)


def test_a_blunt_drill_stalls_z_in_the_board(exact: Machine) -> None:
    plant, place = down(exact, "blunt=3")
    assert 600 <= place < 700 and plant.lost_steps(2, 780) > 50 and plant.touches == 1


def test_a_head_that_turns_the_other_way_round_is_stalled_as_well(exact: Machine) -> None:
    inverted = replace(exact, axes=(*exact.axes[:2], replace(exact.axes[2], invert=True)))
    sharp, blunt = down(inverted), down(inverted, "blunt=3")
    assert sharp[1] == pytest.approx(780, abs=2) and 600 <= blunt[1] < 700 and blunt[0].lost_steps(2, 780) > 50


def test_a_broken_drill_meets_no_board(exact: Machine) -> None:
    plant, place = down(exact, "blunt=3", "broken=1")
    assert place == pytest.approx(780, abs=2) and plant.touches == 0 and not plant.bits


def test_a_hole_that_is_made_resists_no_more_and_another_place_does(exact: Machine) -> None:
    """A bit just sharp enough wears once a hole, however often it goes in."""
    shaft = Shaft(exact, "z")
    (bit,) = shaft.plant.bits
    worn = []
    for axis, steps in (("z", 780), ("z", -700), ("z", 690), ("z", -760), ("x", 60), ("z", 770)):
        shaft.index = exact.axis_names.index(axis)
        shaft.columns = exact.axis_names.index(axis) and round(shaft.place - exact.axes[shaft.index].start_steps)
        for _ in shaft.by(steps):
            pass
        worn.append(bit.wear_m)
    assert worn[0] > 0 and worn[1] == worn[0] and worn[2] <= worn[0] * 1.01
    assert worn[4] == worn[3] == worn[2] and worn[5] > worn[4] + 0.9 * worn[0]


def test_the_recorder_sees_place_speed_and_currents(drill: Machine) -> None:
    table = drill.axes[0]
    images = move(table, 60, rest_ticks=20).images.tolist()
    told = motion_of(table, drill.tick_hz, images)
    assert told.columns.shape == told.speed.shape == (len(images),) and told.currents.shape == (len(images), 4)
    plant = DynamicPlant(drill)
    watching = MotionRecorder(plant.motors[0])
    for image in images:
        plant.drive(image)
        watching.sample()
    assert watching.finish().columns.tolist() == told.columns.tolist()
    # 500 columns a second are 5.45 rad/s on the average; a rotor that steps is faster than that at times.
    assert told.speed.max() > 5.45 and told.speed[-1] == 0 and abs(told.columns[-1] - 60) < 2
    assert told.currents.min() == 0 and 0.3 < told.currents.max() < 1.06  # forced; at rest 5 V over 22 ohm


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("blunt", "not known; there are stuck.WIRE=N"),
        ("sharp=1", "not known"),
        ("blunt=much", "not known"),
        ("blunt.x=1", "written blunt=N"),
        ("loose=1", "written loose.AXIS=N"),
        ("blunt=-1", "from 0 to 1000"),
        ("jammed.x=0.5", "from 1 to 1000"),
        ("jammed.q=2", "pcb-drill has no axis 'q'; it has x, y, z"),
        ("stuck.x=1", "has no wire 'x'; it has x_min"),
    ],
)
def test_a_fault_that_makes_no_sense_is_refused(text: str, reason: str, drill: Machine) -> None:
    with pytest.raises(PlantRefused, match=reason):
        DynamicPlant(drill, [text])


def test_a_fault_is_told_once(drill: Machine) -> None:
    with pytest.raises(PlantRefused, match=r"fault stuck\.x_min: given twice"):
        DynamicPlant(drill, ["stuck.x_min=0", "stuck.x_max=0", "stuck.x_min=1"])


@pytest.mark.parametrize("name", FAULT_KINDS)
def test_each_fault_is_listed_as_it_is_told(name: str) -> None:
    usage = next(line for line in fault_lines() if line.startswith(name)).split()[0]
    assert parse_fault(usage.replace("=N", "=1")).name == name


def refused(build: Callable[[], object]) -> str:
    with pytest.raises(PlantRefused) as caught:
        build()
    return str(caught.value)


def test_what_a_machine_cannot_have_is_refused(drill: Machine) -> None:
    shield = LIBRARY.machine("cnc-shield")
    assert "cnc-shield has no dynamics for x, y, z" in refused(lambda: PlantChoice("dynamic").build(shield))
    assert "say --plant dynamic" in refused(lambda: PlantChoice("ideal", ("blunt=3",)).build(drill))
    assert "can't be built" in refused(lambda: PlantChoice.of_header("magic", "0"))


def test_a_plant_tells_a_trace_what_builds_it_again(drill: Machine) -> None:
    choice = PlantChoice("dynamic", ("blunt=2", "loose.x=0.4"), 7)
    plant = choice.build(drill)
    assert PlantChoice.of_header(plant.described, str(plant.seed)) == choice
    assert PlantChoice.of_header("none", "0") == PlantChoice.of_header("ideal", "0") == PlantChoice()
