"""One rotor with inertia, against physics worked out by hand: circuits, rests, stiction; and to the last bit."""

import math
from dataclasses import replace

import pytest

from drillctl.lab.moves import move
from drillctl.machine import AxisTable, Dynamics, Library, shipped_tables
from drillctl.plant.dynamic import motors as columns
from drillctl.plant.dynamic.axis import DynamicAxis
from drillctl.plant.dynamic.coefficients import SUBSTEPS, coefficients
from drillctl.plant.dynamic.rotor import DynamicRotor, rest_cycles, wires_of

LIBRARY = Library((shipped_tables(),))
HZ = 500
ALL_OFF = (0.0, 0.0, 0.0, 0.0)


@pytest.fixture(params=["pcb-drill", "pcb-drill-ramp-lab"])
def table(request: pytest.FixtureRequest) -> AxisTable:
    return LIBRARY.machine(request.param).axes[0]


def dynamics_of(table: AxisTable) -> Dynamics:
    assert table.dynamics is not None
    return table.dynamics


def frozen(dynamics: Dynamics) -> Dynamics:
    """A rotor that no torque turns, so that its windings are a plain circuit."""
    return replace(dynamics, coulomb_nm=100.0)


def bits(table: AxisTable, *wires: str) -> int:
    named = dict(zip(table.phase.wire_names(), table.wire_bits, strict=True))
    return sum(1 << named[wire] for wire in wires)


@pytest.mark.parametrize(("wires", "volts"), [(("1a",), 5 - 0.7), (("1a", "24a"), 24 - 0.7)])
def test_a_current_rises_as_in_a_coil(wires: tuple[str, ...], volts: float, table: AxisTable) -> None:
    d = frozen(dynamics_of(table))
    axis = DynamicAxis(coefficients(d, HZ), 0.1)
    supply = wires_of(table).supply(bits(table, *wires), d)
    for ticks in range(1, 8):
        axis.tick(supply)
        charged = 1 - math.exp(-d.resistance_ohm * ticks / HZ / d.inductance_h)
        assert axis.currents[0] == pytest.approx(volts / d.resistance_ohm * charged, rel=1e-9)
    assert axis.currents[1:] == (0, 0, 0) and axis.speed == 0


def test_a_current_dies_in_its_diode_and_never_turns_round(table: AxisTable) -> None:
    """From 5 V over R it must fall to nothing in L/R ln(1 + 4.3 / 0.8)."""
    d = frozen(dynamics_of(table))
    axis = DynamicAxis(coefficients(d, HZ), 0.1)
    wires = wires_of(table)
    for _ in range(100):
        axis.tick(wires.supply(bits(table, "1a"), d))
    dead_s = d.inductance_h / d.resistance_ohm * math.log(1 + 4.3 / 0.8)
    off = wires.supply(0, d)
    for _ in range(math.floor(dead_s * HZ)):
        axis.tick(off)
        assert axis.currents[0] > 0
    axis.tick(off)
    assert axis.currents == ALL_OFF


def test_forcing_without_its_winding_does_nothing(table: AxisTable) -> None:
    wires, d = wires_of(table), dynamics_of(table)
    assert wires.supply(bits(table, "24a"), d) == wires.supply(0, d)
    assert wires.supply(bits(table, "24a", "2a"), d) == wires.supply(bits(table, "2a"), d)


@pytest.mark.parametrize("columns", range(12))
@pytest.mark.parametrize("off", [-0.3, 0.3])
def test_a_held_rotor_goes_to_its_rest_as_near_as_friction_lets_it(columns: int, off: float, table: AxisTable) -> None:
    """Where the held torque falls below friction: Th sin(2 pi du) + detent, both worked out from the table."""
    d = dynamics_of(table)
    rest = rest_cycles(table, columns)
    axis = DynamicAxis(coefficients(d, HZ), rest + off)
    shown = [wire.name for wire in table.phase.wires if wire.forward[columns - 1] and not wire.forcing]
    supply = wires_of(table).supply(bits(table, *shown), d)
    for _ in range(150):
        axis.tick(supply)
    angle = 2 * math.pi * (axis.cycles - rest)
    held_nm = math.sqrt(2) * d.torque_nm_per_a * 4.3 / d.resistance_ohm * math.sin(angle)
    torque_nm = held_nm - d.detent_nm * math.sin(4 * angle)  # two phases on: its rests are the detent's tops
    assert axis.speed == 0 and abs(torque_nm) <= d.coulomb_nm
    assert abs(axis.cycles - rest) < 0.08


def test_stiction_holds_what_is_below_it_for_ever(table: AxisTable) -> None:
    """No creep: the place is the same float after ten thousand ticks under a torque just below friction."""
    d = replace(dynamics_of(table), coulomb_nm=dynamics_of(table).torque_nm_per_a * 4.3 / 22, detent_nm=0.0)
    place = 0.249  # a hair before the winding's best angle
    axis = DynamicAxis(coefficients(d, HZ), place)
    supply = wires_of(table).supply(bits(table, "1a"), d)
    for _ in range(10_000):
        axis.tick(supply)
    assert (axis.cycles, axis.speed) == (place, 0) and axis.resting
    weaker = replace(d, coulomb_nm=d.coulomb_nm * 0.98)
    axis = DynamicAxis(coefficients(weaker, HZ), place)
    for _ in range(200):
        axis.tick(supply)
    assert axis.cycles < place - 0.01


def test_a_load_resists_one_direction_alone(table: AxisTable) -> None:
    d = dynamics_of(table)
    ends = {}
    for name, load in {"none": (0.0, 0.0), "forward": (1.0, 0.0), "backward": (0.0, 1.0)}.items():
        for start in (-0.3, 0.3):
            axis = DynamicAxis(coefficients(d, HZ), start)
            axis.load(*load)
            for _ in range(100):
                axis.tick(wires_of(table).supply(bits(table, "1a"), d))
            ends[name, start] = axis.cycles
    assert ends["forward", -0.3] == -0.3 and ends["backward", 0.3] == 0.3
    assert abs(ends["none", -0.3]) < 0.1 and abs(ends["none", 0.3]) < 0.1
    assert abs(ends["forward", 0.3]) < 0.1 and abs(ends["backward", -0.3]) < 0.1


def test_finer_substeps_tend_to_the_same_motion(table: AxisTable) -> None:
    """Each image for ten ticks of a tenth: ten times the substeps. Ours stays within a twentieth of a full step."""
    coarse, fine = DynamicRotor(table, HZ), DynamicRotor(table, 10 * HZ)
    assert coarse.axis.law.substeps == fine.axis.law.substeps == SUBSTEPS
    farthest = 0.0
    for image in move(table, 180 // table.columns_per_step).images.tolist():
        coarse.pull(image)
        for _ in range(10):
            fine.pull(image)
        farthest = max(farthest, 4 * abs(coarse.axis.cycles - fine.axis.cycles))
    assert 0 < farthest < 0.05


def test_what_is_left_out_at_rest_would_have_changed_nothing(table: AxisTable) -> None:
    """The same images with and without the short cut: the same floats after every tick."""
    law, wires, d = coefficients(dynamics_of(table), HZ), wires_of(table), dynamics_of(table)
    quick, slow = DynamicAxis(law, 0.0), DynamicAxis(law, 0.0)
    rested = 0
    moves = [move(table, steps, rest_ticks=150) for steps in (7, -7)]
    for image in [image for each in moves for image in each.images.tolist()]:
        supply = wires.supply(image, d)
        rested += not quick.tick(supply)
        slow.rows[columns.RESTING] = 0.0
        slow.tick(supply)
        assert (quick.cycles, quick.speed, quick.currents) == (slow.cycles, slow.speed, slow.currents)
    assert rested > 200


def test_z_turns_as_x_does_cycle_for_cycle() -> None:
    """Its table is the carriage's by similarity: torques a quarter, inertia and damping a sixteenth."""
    for name in ("pcb-drill", "pcb-drill-ramp-lab"):
        x, _, z = LIBRARY.machine(name).axes
        images = move(x, 300 // x.columns_per_step).images.tolist()
        shift = z.wire_bits[0] - x.wire_bits[0]
        carriage, head = DynamicRotor(x, HZ), DynamicRotor(z, HZ)
        for image in images:
            carriage.pull(image)
            head.pull(image << shift)
        assert head.axis.cycles == pytest.approx(carriage.axis.cycles, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "place"), [("pcb-drill", "0x1.8aacff4d3c633p+4"), ("pcb-drill-ramp-lab", "0x1.898833688e400p+4")]
)
def test_a_move_ends_in_the_same_float_on_every_computer(name: str, place: str) -> None:
    table = LIBRARY.machine(name).axes[0]
    rotor = DynamicRotor(table, HZ)
    for image in move(table, 300 // table.columns_per_step).images.tolist():
        rotor.pull(image)
    assert rotor.axis.cycles.hex() == place


def test_very_slow_ticks_have_more_substeps() -> None:
    d = dynamics_of(LIBRARY.machine("pcb-drill").axes[0])
    assert coefficients(d, 50).substeps == SUBSTEPS
    assert coefficients(d, 1).substeps == 2000
