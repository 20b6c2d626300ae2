"""A motor of variable reluctance: torque by the square of the current, a chopper, no magnet; what loses its steps."""

import math
from dataclasses import replace

import pytest

from drillctl.lab.moves import move
from drillctl.lab.tables import direct_start
from drillctl.machine import AxisTable, Dynamics, Library, shipped_tables
from drillctl.plant.dynamic.axis import DynamicAxis
from drillctl.plant.dynamic.coefficients import coefficients
from drillctl.plant.dynamic.fleet import Fleet, Lane
from drillctl.plant.dynamic.rotor import DynamicRotor, wires_of

DRUM = Library((shipped_tables(),)).machine("boiler-drum")
X, Y = DRUM.axes
BOTH = pytest.mark.parametrize("table", [X, Y], ids=["five-phase", "three-phase"])
REST_TICKS = 20_000
FREE = {"coulomb_nm": 0.0, "viscous_nms": 0.0}


def dynamics_of(table: AxisTable) -> Dynamics:
    assert table.dynamics is not None
    return table.dynamics


def first_speed(d: Dynamics, table: AxisTable, winding: int, cycles: float, current_a: float) -> float:
    """The speed after one tick, of a rotor at rest with this current held in one winding, without friction."""
    d = replace(d, current_a=current_a, **FREE)
    axis = DynamicAxis(replace(coefficients(d, DRUM.tick_hz), decay=0.0), cycles)  # the current is there at once
    wires = wires_of(table)
    axis.tick(wires.supply(wires.on[winding], d))
    assert axis.currents[winding] == current_a
    return axis.speed


def steps_off(table: AxisTable, steps: int, cut_at: float = 1.0) -> float:
    """The columns by which a rotor is behind after a move, of which only this part is put out: then all stops dead."""
    made = move(table, steps, rest_ticks=1)
    last = int(cut_at * (len(made.images) - 1))
    rotor = DynamicRotor(table, DRUM.tick_hz)
    for image in [made.images[0].item()] * REST_TICKS + made.images[:last].tolist():
        rotor.pull(image)
    for _ in range(REST_TICKS * 2):
        if not rotor.pull(made.images[last - 1].item()):
            break
    return rotor.columns_lost(int(made.columns[last - 1]))


@BOTH
def test_the_torque_goes_with_the_square_of_the_current(table: AxisTable) -> None:
    d = dynamics_of(table)
    one, two = (first_speed(d, table, 0, -0.2, amperes) for amperes in (d.current_a / 2, d.current_a))
    assert two == pytest.approx(4 * one, rel=1e-2)
    tick_s = 1 / DRUM.tick_hz
    best = first_speed(d, table, 0, -0.25, d.current_a) * d.inertia_kgm2 / tick_s
    assert best == pytest.approx(d.torque_nm_per_a2 / 2 * d.current_a**2, rel=1e-2)


@BOTH
def test_each_winding_pulls_to_its_own_place(table: AxisTable) -> None:
    d = dynamics_of(table)
    for winding, degrees in enumerate(d.degrees):
        for off, way in ((-30, 1), (30, -1)):
            assert math.copysign(1, first_speed(d, table, winding, (degrees + off) / 360, d.current_a)) == way


@BOTH
def test_without_current_nothing_holds_it(table: AxisTable) -> None:
    """No magnet, so no detent: it stands wherever it is."""
    for cycles in (0.03, 0.2, 0.4):
        axis = DynamicAxis(coefficients(replace(dynamics_of(table), **FREE), DRUM.tick_hz), cycles)
        axis.tick(wires_of(table).supply(0, dynamics_of(table)))
        assert (axis.cycles, axis.speed) == (cycles, 0)


@BOTH
def test_the_chopper_holds_the_set_current_and_a_winding_that_is_off_loses_it(table: AxisTable) -> None:
    d, wires = dynamics_of(table), wires_of(table)
    axis = DynamicAxis(coefficients(d, DRUM.tick_hz), 0.0)
    seen = []
    for _ in range(300):
        axis.tick(wires.supply(wires.on[0], d))
        seen.append(axis.currents[0])
    assert max(seen) == seen[-1] == d.current_a and seen[0] < d.current_a / 10
    for _ in range(300):
        axis.tick(wires.supply(0, d))
    assert axis.currents == (0,) * d.windings


@BOTH
def test_a_ramp_keeps_the_steps_and_without_it_or_stopped_dead_from_gear_f_they_are_lost(table: AxisTable) -> None:
    direct = replace(table, ramp=direct_start(table.ramp))
    for way in (1, -1):
        assert steps_off(table, way * 700) == 0
        assert abs(steps_off(direct, way * 100)) >= table.motor.columns_per_cycle
        assert abs(steps_off(table, way * 700, 0.5)) >= table.motor.columns_per_cycle


def test_a_fleet_refuses_it() -> None:
    with pytest.raises(ValueError, match="assumed-150bf003"):
        Fleet([Lane(dynamics_of(X), DRUM.tick_hz)], wires_of(X))
