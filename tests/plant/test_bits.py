"""The bits of six heads: each wears, resists and breaks for itself; a bit that a chuck takes is a sharp one."""

from dataclasses import replace
from functools import cache

import pytest

from drillctl.kmd import Fault
from drillctl.lab.moves import move
from drillctl.machine import Machine
from drillctl.plant.dynamic.kernel import KERNEL, PLAIN, Kernel
from drillctl.plant.dynamic.plant import DynamicPlant
from tests.support.bench import Bench, shipped

SURFACE, DEEP = 3700, 3860  # steps; DEEP is 1.6 mm below the surface
DOWN = f"KMD_RUCH z2={DEEP} z3={DEEP}; KMD_CZEKAJ 800"
UP = "KMD_RUCH z2=3500 z3=3500; KMD_CZEKAJ 800"
CHANGED = "KMD_WYJSCIE chuck_2 1; KMD_WYJSCIE chuck_2 0"


@cache
def eight() -> Machine:
    """The eight-axis drill without a magazine: a person changes the bits while a chuck is open."""
    return replace(shipped("eight-axis"), tool_changer=None, homing=())


def after(*steps: str, faults: tuple[str, ...] = (), machine: Machine | None = None) -> DynamicPlant:
    """The plant after these commands."""
    machine = machine or eight()
    plant = DynamicPlant(machine, faults)
    b = Bench(machine, plant=plant).queue("KMD_INICJALIZACJA")
    b.finish()
    for axis, table in zip(b.m.axes, machine.axes, strict=True):
        axis.position = axis.target = table.start_steps
    b.queue("; ".join(steps)).finish()
    assert b.m.fault == Fault.NONE
    return plant


def wear_mm(plant: DynamicPlant) -> list[float]:
    return [1000 * bit.wear_m for bit in plant.bits]


def whole(plant: DynamicPlant) -> list[bool]:
    chucks = [plant.chucks.of(bit.axis) for bit in plant.bits]
    return [chuck is not None and chuck.whole for chuck in chucks]


def test_each_bit_wears_by_what_it_cuts_itself() -> None:
    assert wear_mm(after(DOWN)) == pytest.approx([0, 1.6, 1.6, 0, 0, 0], abs=0.05)


def test_a_hole_stays_the_same_while_another_head_goes_up_and_down() -> None:
    once = wear_mm(after(DOWN))
    assert wear_mm(after(DOWN, "KMD_RUCH z3=3000", "KMD_RUCH z2=3500", DOWN)) == pytest.approx(once, abs=0.01)
    assert wear_mm(after(DOWN, UP, "KMD_RUCH x=5200", DOWN))[1] == pytest.approx(2 * once[1], abs=0.05)


def test_worn_is_of_one_head_and_blunt_of_all_others() -> None:
    plant = after("KMD_CZEKAJ 1", faults=("blunt=2", "worn.z5=7", "worn.z6=0"))
    assert wear_mm(plant) == [2000, 2000, 2000, 2000, 7000, 0]


def test_a_worn_bit_needs_more_thrust_so_its_head_lags_more() -> None:
    unbroken = replace(eight(), surroundings=replace(eight().surroundings, bears_n=0.0))
    plant = after(f"KMD_RUCH z2={DEEP} z3={DEEP}", faults=("worn.z3=900",), machine=unbroken)
    sharp, worn = (DEEP - plant.position_steps(axis) for axis in (3, 4))
    assert worn > sharp + 0.5 and whole(plant) == [True] * 6


def test_a_bit_that_needs_more_than_it_bears_breaks_and_makes_no_more_holes() -> None:
    plant = after(DOWN, UP, "KMD_RUCH x=5200", DOWN, faults=("worn.z3=7.999",))
    assert whole(plant) == [True, True, False, True, True, True]
    assert plant.met == [0, 0, 0, 2, 1, 0, 0, 0]
    assert 7999 < wear_mm(plant)[2] < 8001


def test_the_stub_of_a_broken_bit_meets_the_board_deeper_and_cuts_there() -> None:
    plant = after("KMD_RUCH z2=4100; KMD_CZEKAJ 800", faults=("breaks.z2=1",))
    assert wear_mm(plant)[1] == pytest.approx(1.0, abs=0.05) and not whole(plant)[1]


def test_a_bit_that_a_chuck_takes_is_sharp_and_whole() -> None:
    plant = after(DOWN, UP, CHANGED, faults=("worn.z2=7.999", "worn.z3=3"))
    assert whole(plant)[1] and wear_mm(plant)[1:3] == pytest.approx([0, 3001.6], abs=0.1)


def test_without_its_bit_a_head_meets_no_board() -> None:
    plant = after("KMD_WYJSCIE chuck_2 1", DOWN)
    assert plant.met[3:5] == [0, 1] and wear_mm(plant)[1:3] == pytest.approx([0, 1.6], abs=0.05)


def test_broken_takes_the_drills_off_all_heads() -> None:
    plant = after(DOWN, faults=("broken=1",))
    assert plant.bits == () and plant.met == [0] * 8


@pytest.mark.parametrize("kernel", [KERNEL, PLAIN], ids=["chosen", "plain"])
def test_a_stretch_ends_in_the_tick_in_which_a_bit_breaks(kernel: Kernel) -> None:
    """In both forms of the law, and tick by tick, the same."""
    machine = replace(eight(), axes=tuple(replace(axis, start_steps=3600) for axis in eight().axes))
    images = move(machine.axes[4], 260).images.astype("uint64")
    plants = [DynamicPlant(machine, ("worn.z3=7.999",), 0, each) for each in (kernel, PLAIN)]
    done = 0
    while done < len(images):
        done += plants[0].run(images[done:])
    for image in images.tolist():
        plants[1].drive(image)
    assert whole(plants[0]) == whole(plants[1]) == [True, True, False, True, True, True]
    assert list(plants[0]._rows) == list(plants[1]._rows) and wear_mm(plants[0]) == wear_mm(plants[1])
