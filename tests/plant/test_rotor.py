"""One rotor against a sum of vectors worked out anew, for every pattern of every motor; and pulse drives by edges."""

import cmath
import math
from dataclasses import replace
from itertools import pairwise, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.machine import AxisTable, Library, shipped_tables
from drillctl.plant.rotor import rotor_of

LIBRARY = Library((shipped_tables(),))


def pull_degrees(table: AxisTable, on: set[str]) -> float | None:
    """Where the windings pull, by complex numbers; None where they cancel."""
    total = sum(cmath.rect(1, math.radians(angle)) for name, angle in table.motor.windings if name in on)
    return None if abs(total) < 1e-9 else math.degrees(cmath.phase(total))


def bits_of(table: AxisTable) -> dict[str, int]:
    return {name: 1 << bit for name, bit in zip(table.phase.wire_names(), table.wire_bits, strict=True)}


def all_patterns(table: AxisTable) -> list[set[str]]:
    names = [name for name, _ in table.motor.windings]
    return [{n for n, on in zip(names, choice, strict=True) if on} for choice in product((0, 1), repeat=len(names))]


def column(table: AxisTable, index: int, forcing: bool = True) -> int:
    wires = zip(table.phase.wires, table.wire_bits, strict=True)
    on = index % table.phase.columns
    return sum(1 << bit for wire, bit in wires if wire.forward[on] and (forcing or not wire.forcing))


def test_every_pattern_from_every_place_goes_to_the_nearest_equilibrium(stepper: AxisTable) -> None:
    """From each place where the rotor can stand; half a cycle away it slips and stays; cancelled, it stays."""
    bits = bits_of(stepper)
    places = {round(angle) for on in all_patterns(stepper) if (angle := pull_degrees(stepper, on)) is not None}
    assert len(places) >= 6
    for place, on in product(places, all_patterns(stepper)):
        rotor = rotor_of(stepper)
        rotor.degrees = place
        moved = rotor.pull(sum(bits[name] for name in on))
        wanted = pull_degrees(stepper, on)
        if wanted is None:
            assert (moved, rotor.degrees, rotor.slips) == (False, place, 0)
            continue
        away = (wanted - place + 180) % 360 - 180
        if math.isclose(abs(away), 180, abs_tol=1e-6):
            assert (moved, rotor.degrees, rotor.slips) == (False, place, 1)
        else:
            assert math.isclose(rotor.degrees, place + away, abs_tol=1e-6) and rotor.slips == 0
            assert moved == (abs(away) > 1e-6)


def test_equilibria_are_whole_degrees(stepper: AxisTable) -> None:
    for on in all_patterns(stepper):
        wanted, found = pull_degrees(stepper, on), stepper.motor.equilibrium_degrees(frozenset(on))
        if wanted is None or found is None:
            assert wanted is found is None
        else:
            assert -180 < found <= 180
            assert math.isclose((found - wanted + 180) % 360, 180, abs_tol=1e-6)


@pytest.mark.parametrize("direction", [1, -1])
def test_the_table_turns_the_rotor_a_cycle_for_a_cycle(stepper: AxisTable, direction: int) -> None:
    """Column by column, forcing or not; the reading lies within a rest of the controller's count."""
    cycle = stepper.motor.columns_per_cycle
    rotor = rotor_of(stepper)
    for travelled in range(1, 5 * cycle + 1):
        at = travelled - 1 if direction > 0 else -travelled - 1
        rotor.pull(column(stepper, at, forcing=travelled % 2 == 0))
        assert rotor.columns_lost(direction * travelled) == 0
    assert abs(rotor.columns - direction * 5 * cycle) * rotor.columns_per_cycle <= rotor.half_rest * cycle
    assert rotor.slips == 0


def test_released_coils_leave_the_rotor_where_it_stands(stepper: AxisTable) -> None:
    rotor = rotor_of(stepper)
    for index in range(7):
        rotor.pull(column(stepper, index))
    stood = rotor.degrees
    assert not rotor.pull(0) and rotor.degrees == stood
    rotor.pull(column(stepper, 6))
    assert rotor.degrees == stood and rotor.slips == 0


def test_half_a_cycle_at_once_is_a_slip_and_shows_as_lost_columns(stepper: AxisTable) -> None:
    """Two-phase: column 1 to 7 is just half a cycle. A motor of an odd number of phases has other columns."""
    jumps = stepper.motor.columns_per_cycle // 2
    rotor = rotor_of(stepper)
    rotor.pull(column(stepper, 0))
    stood = rotor.degrees
    rotor.pull(column(stepper, jumps))
    assert (rotor.slips, rotor.degrees) == (1, stood)
    rotor.pull(column(stepper, jumps))  # standing there pulls no more than arriving did
    assert rotor.degrees == stood
    assert abs(rotor.columns_lost(1 + jumps) - jumps) <= rotor.half_rest * rotor.columns_per_cycle / 360


def test_a_jump_of_a_whole_cycle_is_lost_without_a_slip(stepper: AxisTable) -> None:
    """The coils are as before, so the rotor does not move, and nobody but the plant can know."""
    cycle = stepper.motor.columns_per_cycle
    rotor = rotor_of(stepper)
    rotor.pull(column(stepper, 0))
    assert not rotor.pull(column(stepper, cycle)) and rotor.slips == 0
    rest = rotor.half_rest * cycle / 360  # how far off its column a rotor may stand
    assert abs(rotor.columns_lost(1 + cycle) - cycle) <= rest and abs(rotor.columns_lost(1 - cycle) + cycle) <= rest


@given(name=st.sampled_from(["pcb-drill", "boiler-drum"]), turns=st.lists(st.integers(-30, 30), max_size=8))
@settings(max_examples=60, deadline=None)
def test_reversals_lose_nothing(name: str, turns: list[int]) -> None:
    """However often it turns round, a rotor led column by column is where it was led."""
    for table in LIBRARY.machine(name).axes[:2]:
        rotor, at = rotor_of(table), -1
        for turn in turns:
            for _ in range(abs(turn)):
                at += 1 if turn > 0 else -1
                rotor.pull(column(table, at))
        assert rotor.columns_lost(at + 1) == 0 and rotor.slips == 0


def test_a_reading_grants_the_columns_of_a_rest_and_no_more() -> None:
    """Columns 1 to 3 of the two-phase table hold the rotor in one place, in the middle of them."""
    table = LIBRARY.machine("pcb-drill").axes[0]
    rotor = rotor_of(table)
    rotor.pull(column(table, 0))
    assert rotor.columns == 2
    assert [travelled for travelled in range(-6, 9) if rotor.columns_lost(travelled) == 0] == [1, 2, 3]
    assert (rotor.columns_lost(0), rotor.columns_lost(4)) == (-2, 2)


def test_a_drive_counts_rising_edges_by_the_direction_beside_them(drive: AxisTable) -> None:
    bits = bits_of(drive)
    pulse, forward = bits["pulse"], bits["dir"]
    rotor = rotor_of(drive)
    images = [0, pulse, pulse | forward, forward, pulse | forward, forward, 0, pulse, 0, forward, pulse | forward]
    rising = [after & pulse and not before & pulse for before, after in pairwise(images)]
    edges = [(1 if image & forward else -1) if rise else 0 for rise, image in zip(rising, images[1:], strict=True)]
    assert edges == [-1, 0, 0, 1, 0, 0, -1, 0, 0, 1]
    rotor.pull(images[0])
    counted = 0
    for image, edge in zip(images[1:], edges, strict=True):
        assert rotor.pull(image) == (edge != 0)
        counted += edge
        assert rotor.columns == counted * drive.motor.columns_per_cycle
    assert rotor.slips == 0


def test_a_drive_told_the_other_way_round(drive: AxisTable) -> None:
    """With forward = "." the low level of the direction wire is forward."""
    pulse, direction = drive.phase.wires
    turned = replace(direction, forward=direction.backward, backward=direction.forward)
    rotor = rotor_of(replace(drive, phase=replace(drive.phase, wires=(pulse, turned))))
    rotor.pull(bits_of(drive)["pulse"])
    assert rotor.columns == drive.motor.columns_per_cycle


def test_a_drive_half_a_pulse_behind_is_not_a_step_behind(drive: AxisTable) -> None:
    rotor = rotor_of(drive)
    rotor.pull(bits_of(drive)["pulse"] | bits_of(drive)["dir"])
    assert rotor.columns_lost(1) == rotor.columns_lost(2) == rotor.columns_lost(3) == 0
    assert rotor.columns_lost(4) == 2 and rotor.columns_lost(0) == -2
