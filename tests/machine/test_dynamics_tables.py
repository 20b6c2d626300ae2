"""Dynamics as tables: what fits which motor, what is refused and on which line; no part of the digest."""

import shutil
from collections.abc import Callable
from dataclasses import astuple
from pathlib import Path

import pytest

from drillctl.machine import Library, Machine, TableError, shipped_tables

Change = Callable[[str, str, str], Machine]
CARRIAGE = "dynamics/tuned-carriage"
DRILL = "machines/pcb-drill"


@pytest.fixture
def changed(tmp_path: Path) -> Change:
    """The shipped drill with one thing changed in one of its tables."""
    shutil.copytree(shipped_tables(), tmp_path, dirs_exist_ok=True)

    def change(table: str, old: str, new: str) -> Machine:
        file = tmp_path / f"{table}.toml"
        text = file.read_text()
        assert old in text
        file.write_text(text.replace(old, new, 1))
        return Library((tmp_path,)).machine("pcb-drill")

    return change


def test_x_and_y_share_a_table_and_z_has_its_own() -> None:
    machine = Library((shipped_tables(),)).machine("pcb-drill")
    x, y, z = (axis.dynamics for axis in machine.axes)
    assert x is not None and z is not None and x == y != z
    assert (x.name, x.cycles_per_turn, x.inertia_kgm2) == ("tuned-carriage", 48, 4.28e-5)
    assert x.forcing == (("24a", ("1a", "1b")), ("24b", ("2a", "2b")))
    assert any(file.endswith("tuned-carriage.toml") for file in machine.files)


@pytest.mark.parametrize("name", ["tuned", "tuned-lab"])
def test_the_head_is_the_carriage_by_similarity(name: str) -> None:
    x, _, z = Library((shipped_tables(),)).machine("pcb-drill-ramp-lab" if "lab" in name else "pcb-drill").axes
    assert x.dynamics is not None and z.dynamics is not None
    scales = {"cycles_per_turn": 4, "torque_nm_per_a": 4, "coulomb_nm": 4, "detent_nm": 4,
              "inertia_kgm2": 16, "viscous_nms": 16, "resistance_ohm": 1, "inductance_h": 1}  # fmt: skip
    for key, scale in scales.items():
        assert getattr(x.dynamics, key) == pytest.approx(scale * getattr(z.dynamics, key))


def test_a_machine_need_not_have_them() -> None:
    assert all(axis.dynamics is None for axis in Library((shipped_tables(),)).machine("cnc-shield").axes)


@pytest.mark.parametrize("table", [CARRIAGE, DRILL])
def test_they_leave_the_digest(table: str, changed: Change) -> None:
    """A run is decided by images and sensors; replay needs no plant."""
    before = Library((shipped_tables(),)).machine("pcb-drill")
    old, new = ("0.061", "0.062") if table == CARRIAGE else ("thrust_n = 3", "thrust_n = 5")
    after = changed(table, old, new)
    told = [(m.axes[0].dynamics, m.surroundings) for m in (before, after)]
    assert told[0] != told[1] and before.digest == after.digest


def test_what_surrounds_the_motors_is_read(changed: Change) -> None:
    found = changed(DRILL, "scatter_mm = 0.01", "scatter_mm = 0.02\nbears_n = 9").surroundings
    assert astuple(found) == (0.02, 3, 1.5, 9, 20_000)


@pytest.mark.parametrize(
    ("table", "old", "new", "reason"),
    [
        (CARRIAGE, "inertia_kgm2 = 4.28e-5", "inertia_kgm2 = 0", "inertia_kgm2: expected float > 0.0"),
        (CARRIAGE, "coulomb_nm = 0.0417", "coulomb_nm = -1", "coulomb_nm: expected float >= 0.0"),
        (CARRIAGE, "resistance_ohm = 22", "", "resistance_ohm is missing"),
        (CARRIAGE, "detent_nm", "detent", "unknown key detent"),
        (CARRIAGE, "forcing_volts = 24", "forcing_volts = 4", "forcing_volts is below normal_volts"),
        (CARRIAGE, "24a = ", "24c = ", "forcing wire 24a of table two-phase-forced is not under"),
        (CARRIAGE, '["1a", "1b"]', '["1a", "1c"]', "motor two-phase has no winding 1c"),
        (DRILL, 'dynamics = "tuned-carriage"', 'dynamics = "none"', "no dynamics table is named 'none'"),
        (CARRIAGE, "detent_nm = 0.0112", "", "detent_nm is missing"),
        (CARRIAGE, "detent_nm = 0.0112", "detent_nm = 0.0112\nphases = 3", "phases belongs to a reluctance motor"),
        (CARRIAGE, "detent_nm = 0.0112", 'kind = "servo"', "kind: "),
        ("motor/two-phase", "2b = 90", "2b = 80", "motor two-phase has not the four half windings"),
        (DRILL, "scatter_mm = 0.01", "scatter_mm = -1", "plant.scatter_mm: expected float >= 0.0"),
    ],
)
def test_what_is_refused(table: str, old: str, new: str, reason: str, changed: Change) -> None:
    with pytest.raises(TableError) as caught:
        changed(table, old, new)
    assert reason in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("phases = 5", "phases = 3", "has not the 3 windings at 0, 120, 240 degrees"),
        ("phases = 5", "phases = 4", "phases: "),
        ("current_a = 13", "", "current_a is missing"),
        ("current_a = 13", "current_a = 13\ndetent_nm = 0.1", "detent_nm belongs to a unipolar motor"),
        ("current_a = 13", 'current_a = 13\nforcing = { a = ["b"] }', "forcing belongs to a unipolar motor"),
    ],
)
def test_what_is_refused_of_a_reluctance_motor(old: str, new: str, reason: str, tmp_path: Path) -> None:
    shutil.copytree(shipped_tables(), tmp_path, dirs_exist_ok=True)
    file = tmp_path / "dynamics/assumed-150bf003.toml"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new, 1))
    with pytest.raises(TableError) as caught:
        Library((tmp_path,)).machine("boiler-drum")
    assert reason in str(caught.value)


@pytest.mark.parametrize(
    "name",
    ["assumed-150bf003", "assumed-110bf003", "tuned-carriage", "tuned-head", "tuned-lab-carriage", "tuned-lab-head"],
)
def test_the_shipped_ones_are_tables_that_can_be_checked(name: str) -> None:
    library = Library((shipped_tables(),))
    assert name in library.names("dynamics")
    assert library.check(shipped_tables() / "dynamics" / f"{name}.toml") == []
