"""Many rotors at once do what one rotor does, to the bit; trials judge them as a person would."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.lab.moves import move, side_by_side
from drillctl.lab.trials import Trial, errors_full_steps, lost
from drillctl.machine import AxisTable, Library, shipped_tables
from drillctl.plant.dynamic.axis import DynamicAxis
from drillctl.plant.dynamic.coefficients import coefficients
from drillctl.plant.dynamic.fleet import Fleet, Lane
from drillctl.plant.dynamic.rotor import rest_cycles, wires_of

LIBRARY = Library((shipped_tables(),))
TABLES = [LIBRARY.machine(name).axes[0] for name in ("pcb-drill", "pcb-drill-ramp-lab")]
lanes = st.builds(
    Lane,
    dynamics=st.sampled_from([table.dynamics for table in TABLES]).flatmap(
        lambda d: st.builds(
            lambda inductance, inertia, friction: replace(
                d,
                inductance_h=d.inductance_h * inductance,
                inertia_kgm2=d.inertia_kgm2 * inertia,
                coulomb_nm=d.coulomb_nm * friction,
            ),
            *[st.floats(0.5, 2.0)] * 3,
        )
    ),
    tick_hz=st.integers(50, 2000),
    cycles=st.floats(-40, 40),
    forward_nm=st.floats(0, 0.05),
    backward_nm=st.floats(0, 0.05),
)


def alone(lane: Lane, images: list[int]) -> tuple[list[float], DynamicAxis]:
    """The same by the law in plain floats."""
    axis = DynamicAxis(coefficients(lane.dynamics, lane.tick_hz), lane.cycles)
    axis.load(lane.forward_nm, lane.backward_nm)
    wires, places = wires_of(TABLES[0]), []
    for image in images:
        axis.tick(wires.supply(image, lane.dynamics))
        places.append(axis.cycles)
    return places, axis


@given(st.lists(lanes, min_size=1, max_size=4), st.data())
@settings(max_examples=15, deadline=None)
def test_each_lane_is_the_law_to_the_bit(found: list[Lane], data: st.DataObject) -> None:
    """Any wires in any order, other ones in each lane; place after every tick, speed and currents at the end."""
    patterns = st.sampled_from(range(128))
    rows = data.draw(st.lists(st.lists(patterns, min_size=len(found), max_size=len(found)), min_size=1, max_size=12))
    images = np.array(rows)
    fleet = Fleet(found, wires_of(TABLES[0]))
    kept = fleet.run(images, keep=True)
    for number, lane in enumerate(found):
        places, axis = alone(lane, images[:, number].tolist())
        assert kept[:, number].tolist() == places
        assert (fleet.speed[number], tuple(fleet.currents[:, number])) == (axis.speed, axis.currents)


def test_one_image_for_all_lanes_is_that_image_in_each() -> None:
    table = TABLES[1]
    images = move(table, 6, rest_ticks=10).images
    found = [Lane(dynamics, hz) for hz in (400, 640) for dynamics in (TABLES[0].dynamics, table.dynamics) if dynamics]
    alike = Fleet(found, wires_of(table)).run(images)
    apart = Fleet(found, wires_of(table)).run(np.repeat(images[:, None], len(found), axis=1))
    assert alike.tolist() == apart.tolist() == [alone(lane, images.tolist())[0][-1] for lane in found]
    assert len(set(alike.tolist())) == len(found)


def test_a_fleet_goes_on_from_where_it_stands() -> None:
    table = TABLES[0]
    assert table.dynamics is not None
    images, whole = move(table, 20).images, Fleet([Lane(table.dynamics, 500)], wires_of(table))
    parts = Fleet([Lane(table.dynamics, 500)], wires_of(table))
    parts.run(images[:90])
    assert parts.run(images[90:]).tolist() == whole.run(images).tolist()


def test_lanes_of_other_substeps_are_refused() -> None:
    dynamics = TABLES[0].dynamics
    assert dynamics is not None
    with pytest.raises(ValueError, match="same number of substeps"):
        Fleet([Lane(dynamics, 500), Lane(dynamics, 20)], wires_of(TABLES[0]))


def test_trials_come_back_in_their_order_whatever_their_length() -> None:
    """Long and short, lost and kept, mixed: each as when tried alone."""
    table = TABLES[0]
    assert table.dynamics is not None
    sizes = ((40, 500), (5, 500), (90, 900), (-9, 60))
    trials = [Trial(move(table, steps, rest_ticks=40), hz, table.dynamics) for steps, hz in sizes]
    together = errors_full_steps(table, trials)
    assert together.tolist() == [errors_full_steps(table, [trial])[0] for trial in trials]
    assert lost(together).tolist() == [False, False, True, False]


def test_a_load_is_what_loses_steps() -> None:
    """Held torque is 0.11 N m: a tenth of it is carried at 300 Hz, all of it is not."""
    table = TABLES[0]
    assert table.dynamics is not None
    trials = [Trial(move(table, 100), 300, table.dynamics, load_nm) for load_nm in (0.0, 0.011, 0.11)]
    assert lost(errors_full_steps(table, trials)).tolist() == [False, False, True]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.dynamics.name)
def test_a_move_is_what_the_automaton_puts_out(table: AxisTable) -> None:
    """From rest to rest: columns one by one, forcing off once it rests."""
    for steps in (1, -1, 40, -40):
        for column in range(12):
            made = move(table, steps, column)
            moved = np.diff(made.columns)
            assert made.columns[0] == column - 11
            assert made.columns[-1] - made.columns[0] == steps * table.columns_per_step
            assert set(moved.tolist()) <= {0, int(np.sign(steps))}
            forcing = sum(1 << b for w, b in zip(table.phase.wires, table.wire_bits, strict=True) if w.forcing)
            assert made.images[0] & forcing == made.images[-1] & forcing == 0
    both = [move(table, 3), move(table, 30)]
    beside = side_by_side(both)
    assert beside.shape == (len(both[1].images), 2) and set(beside[len(both[0].images) :, 0]) == {both[0].images[-1]}


def test_a_rest_is_where_the_column_holds_the_rotor() -> None:
    """Columns 1 to 3 of the paper's table hold it at -45 degrees, the next three a quarter cycle on."""
    table = TABLES[0]
    rests = [rest_cycles(table, columns) for columns in range(1, 13)]
    assert rests == pytest.approx([-1 / 8] * 3 + [1 / 8] * 3 + [3 / 8] * 3 + [5 / 8] * 3)
    assert rest_cycles(table, 0) == pytest.approx(-3 / 8) and rest_cycles(table, -24) == pytest.approx(-3 / 8 - 2)
