"""KMD_DOTYK: where a bit touches, one that is not there, and one that touches too deep (docs/SPEC.md, 1.11)."""

from dataclasses import replace
from functools import cache

import pytest

from drillctl.kmd import Fault, Request
from drillctl.machine import Machine, ParameterRow, Parameters
from tests.support.bench import Bench, shipped

Z1, Z2 = 2, 3
UP = "KMD_RUCH z1=3500 z2=3500"


@cache
def machine(descent_mm: float = 45.0, range_mm: float = 0.2, depth_mm: float = 3.0) -> Machine:
    """The eight-axis drill near zero, with two boards that lie unlike; its homing is to stay where it is."""
    eight = shipped("eight-axis")
    axes = tuple(replace(axis, start_steps=0) for axis in eight.axes)
    rows = tuple((name, ParameterRow((("depth_detection_descent_mm", descent_mm),))) for name in ("z1", "z2"))
    machining = ParameterRow((("breakage_range_mm", range_mm),))
    parameters = Parameters(
        axes=rows, machining=machining, system=ParameterRow((("depth_detection_depth_mm", depth_mm),))
    )
    surfaces = (None, None, 3700, 3650, *eight.board_surface[4:])
    return replace(eight, axes=axes, board_surface=surfaces, parameters=parameters, homing=())


def bench(text: str, of: Machine) -> Bench:
    b = Bench(of).queue(f"KMD_INICJALIZACJA; {text}")
    b.finish()
    return b


def test_each_head_stops_on_its_own_board() -> None:
    b = bench("KMD_DOTYK z1 z2", machine())
    assert (b.m.fault, b.positions()[Z1:4], b.m.surfaces) == (Fault.NONE, [3700, 3650], {Z1: 3700, Z2: 3650})
    assert [b.card.plant.position_steps(axis) for axis in (Z1, Z2)] == [3700, 3650]


def test_a_bit_that_touches_nothing_within_the_descent_is_missed() -> None:
    b = bench("KMD_DOTYK z1 z2", machine(36.8))
    assert (b.m.fault, b.m.position_known, b.positions()[Z1:4]) == (Fault.NO_CONTACT, True, [3680, 3650])
    assert b.m.fault_axes == 1 << Z1


@pytest.mark.parametrize(("deeper", "fault"), [(20, Fault.NONE), (21, Fault.BIT_BROKEN)])
def test_a_bit_that_touches_deeper_than_its_range_is_broken(deeper: int, fault: Fault) -> None:
    b = Bench(machine()).queue(f"KMD_INICJALIZACJA; KMD_DOTYK z1 z2; {UP}; KMD_DOTYK z1 z2")
    b.until(lambda: b.m.done == 3)
    chuck = b.card.plant.chucks.of(Z2)
    assert chuck is not None
    chuck.short_steps = deeper
    b.finish()
    assert (b.m.fault, b.positions()[Z2]) == (fault, 3650 + deeper)


@pytest.mark.parametrize(("deeper", "depth_mm", "fault"), [
    (0, 1.0, Fault.NONE), (20, 1.0, Fault.NONE), (21, 1.0, Fault.BIT_BROKEN), (120, 1.0, Fault.BIT_BROKEN),
    (1, 0.0, Fault.NONE),
])  # fmt: skip
def test_a_stroke_down_finds_a_broken_bit_by_its_touch(deeper: int, depth_mm: float, fault: Fault) -> None:
    b = Bench(machine(depth_mm=depth_mm)).queue(f"KMD_INICJALIZACJA; KMD_DOTYK z1 z2; {UP}; KMD_WIERTLO_DOL z1 z2")
    b.until(lambda: b.m.done == 3)
    chuck = b.card.plant.chucks.of(Z2)
    assert chuck is not None
    chuck.short_steps = deeper
    b.finish()
    assert (b.m.fault, b.m.position_known) == (fault, True)
    assert b.m.fault_axes == (1 << Z2 if fault else 0)
    b.ask(Request.ACK).tick()
    assert b.m.fault_axes == 0


@pytest.mark.parametrize("before", ["", f"KMD_DOTYK z1 z2; {UP}; "])
def test_a_contact_that_is_on_above_the_board_is_believed_neither_in_detection_nor_in_a_stroke(before: str) -> None:
    last = "KMD_WIERTLO_DOL z1 z2" if before else "KMD_DOTYK z1 z2"
    b = Bench(machine(depth_mm=1.0)).queue(f"KMD_INICJALIZACJA; {before}{last}")
    b.until(lambda: b.m.done == (3 if before else 1))
    b.card.stuck_high = b.input_bit("contact_2")
    b.finish()
    assert (b.m.fault, b.m.fault_axes, b.m.position_known) == (Fault.NO_CONTACT, 1 << Z2, True)


def test_a_bit_that_leaves_the_board_within_its_stroke_is_broken() -> None:
    b = Bench(machine(depth_mm=1.0)).queue(f"KMD_INICJALIZACJA; KMD_DOTYK z1 z2; {UP}; KMD_WIERTLO_DOL z1 z2")
    b.until(lambda: b.m.done == 3)
    chuck = b.card.plant.chucks.of(Z1)
    assert chuck is not None
    chuck.breaks_at = 2  # it touches in its place, and is 3 mm shorter from then on
    b.finish()
    assert b.m.fault == Fault.BIT_BROKEN


def test_a_head_goes_so_deep_below_its_own_board_and_without_a_surface_where_the_file_says() -> None:
    b = bench("KMD_DOTYK z1 z2; KMD_WIERTLO_DOL z1 z2 z3", machine(depth_mm=1.0))
    assert (b.m.fault, b.positions()[Z1:5]) == (Fault.NONE, [3800, 3750, b.machine.drill_down_steps])


def test_homing_forgets_where_the_boards_were() -> None:
    b = bench(f"KMD_DOTYK; {UP}; KMD_INICJALIZACJA", machine())
    assert (b.m.fault, b.m.surfaces) == (Fault.NONE, {})


def test_a_machine_without_contacts_takes_no_such_command() -> None:
    b = Bench(shipped("pcb-drill")).ready().queue("KMD_DOTYK")
    b.finish()
    assert b.m.fault == Fault.BAD_COMMAND
