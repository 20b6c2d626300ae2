"""Chucks, the bits in them and the magazine: what the tool and contact sensors say after each step of a change."""

from dataclasses import replace

import pytest

from drillctl.kmd import Fault
from drillctl.machine import Machine
from drillctl.machine.head_lines import CONTACT, TOOL, head_input
from drillctl.plant.chucks import chucks_of
from drillctl.plant.effects import Board
from drillctl.plant.faults import Faults, PlantRefused
from tests.support.bench import Bench, shipped

OVER = "KMD_RUCH x={x} y=49000; KMD_RUCH z2=3000"
PLACE_1, PLACE_2 = OVER.format(x=10000), OVER.format(x=11200)
AWAY, OPEN, CLOSE = "KMD_RUCH z2=0", "KMD_WYJSCIE chuck_2 1", "KMD_WYJSCIE chuck_2 0"


def eight() -> Machine:
    """The eight-axis drill, found near its magazine."""
    machine = shipped("eight-axis")
    x, y, *heads = machine.axes
    return replace(machine, axes=(replace(x, start_steps=10000), replace(y, start_steps=49000), *heads), homing=())


def bench(*steps: str) -> Bench:
    b = Bench(eight()).queue("KMD_INICJALIZACJA")
    b.finish()
    for index, axis in enumerate(b.m.axes):
        axis.position = axis.target = b.machine.axes[index].start_steps
    b.queue("; ".join(steps)).finish()
    assert b.m.fault == Fault.NONE
    return b


def tools(b: Bench) -> list[bool]:
    """What the tool sensors say, by head."""
    lines = (head_input(b.machine, TOOL, head) for head in b.machine.drill_axes)
    return [bool(line and b.card.plant.inputs >> line.bit & 1) for line in lines]


@pytest.mark.parametrize(
    ("steps", "held"),
    [
        ((AWAY,), True),
        ((PLACE_1, OPEN, AWAY), False),
        ((PLACE_1, OPEN, CLOSE, AWAY), True),
        ((PLACE_1, OPEN, AWAY, PLACE_2, CLOSE, AWAY), True),
        ((PLACE_1, OPEN, AWAY, PLACE_2, CLOSE, AWAY, PLACE_2, OPEN, AWAY), False),
        ((OPEN, CLOSE), False),  # over nothing: the bit is lost, and none is taken
        ((PLACE_1, OPEN, "KMD_RUCH z2=2900", CLOSE), False),  # 1 mm too high
        ((OPEN, PLACE_2, CLOSE, AWAY, PLACE_1, OPEN, CLOSE, AWAY), True),
        ((OPEN, PLACE_2, CLOSE, OPEN, CLOSE, AWAY), True),
    ],
)
def test_a_bit_is_left_and_taken_over_its_place_at_the_change_height(steps: tuple[str, ...], held: bool) -> None:
    assert tools(bench(*steps)) == [True, held, True, True, True, True]


def test_a_place_that_has_given_its_bit_has_no_other_and_a_full_one_takes_none() -> None:
    b = bench(OPEN, PLACE_1, CLOSE, AWAY, PLACE_2, OPEN, AWAY, PLACE_1, CLOSE, AWAY)
    assert not tools(b)[1]
    b = bench(PLACE_1, OPEN, AWAY, PLACE_2, CLOSE, AWAY, PLACE_1, OPEN, AWAY)
    assert tools(b)[1]


def test_a_bit_touches_and_makes_holes_while_it_is_in_its_chuck() -> None:
    drill, out = "KMD_RUCH z1=3700 z2=3700", "KMD_RUCH z1=3000 z2=3000"
    b = bench(drill)
    contact = b.card.plant.inputs >> 24 & 0b111111
    assert (contact, b.card.plant.met[2:4]) == (0b000011, [1, 1])
    b.queue("; ".join([out, AWAY, OPEN, drill])).finish()
    assert (b.card.plant.inputs >> 24 & 0b111111, b.card.plant.met[2:4]) == (0b000001, [2, 1])


@pytest.mark.parametrize(("fault", "held"), [("missing.z2=2", False), ("missing.z2=1", True), ("missing.z1=2", True)])
def test_a_bit_that_is_missing_is_not_taken(fault: str, held: bool) -> None:
    at_mm = {0: 112.0, 1: 490.0, 3: 30.0}
    chucks = chucks_of(eight(), Faults([fault], eight()))
    chuck = chucks.of(3)
    assert chuck is not None
    chuck.held = False
    chucks.switch(chuck.output, 0, at_mm.__getitem__)
    assert chuck.held == held


def test_a_bit_that_is_dropped_falls_out_as_the_head_rises() -> None:
    chucks = chucks_of(eight(), Faults(["dropped.z2=1"], eight()))
    chuck = chucks.of(3)
    assert chuck is not None
    chuck.held = False
    chucks.switch(chuck.output, 0, {0: 112.0, 1: 490.0, 3: 30.0}.__getitem__)
    assert (chuck.held, chucks.slipping, chucks.lifted(3, 29.9), chucks.lifted(3, 20.0)) == (True, True, False, True)
    assert not chuck.held


def test_a_bit_breaks_in_its_hole_and_touches_deeper_from_then_on() -> None:
    chucks = chucks_of(eight(), Faults(["breaks.z2=2"], eight()))
    line = head_input(eight(), CONTACT, 3)
    assert line is not None
    board = Board(3, 3700, chucks.of(3))
    begun = [board.moved_to(steps) for steps in (3700, 3600, 3700, 3600, 3700, 3999, 4000, 3000)]
    assert begun == [True, False, True, False, False, False, False, False]
    assert [board.moved_to(3999), board.state, board.moved_to(4000), board.state] == [False, False, False, True]


def test_faults_of_bits_belong_to_heads_with_chucks() -> None:
    with pytest.raises(PlantRefused, match="pcb-drill has no head 'z'"):
        Faults(["breaks.z=1"], shipped("pcb-drill"))
