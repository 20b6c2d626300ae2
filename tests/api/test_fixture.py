"""The fixture as another repository's tests use it."""

import shutil
from pathlib import Path

from drillctl.api.fixture import Drill, explain

TABLES = Path(__file__).resolve().parent.parent.parent / "tables"


def test_a_run_is_driven_and_compared(drill: Drill) -> None:
    run = drill.run("KMD_GOTOdXdY 30 0")
    assert run.positions("x")[-1] == 30
    assert run == drill.run("KMD_GOTOdXdY 30 0") and run != drill.run("KMD_GOTOdXdY 31 0")
    assert len(drill.runs) == 3
    assert drill.machine("pcb-drill", tick_hz=250).tick_hz == 250


def test_files_are_found_beside_the_test(tmp_path: Path) -> None:
    (tmp_path / "job.kmd").write_text("KMD_GOTOdXdY 5 0\n")
    assert Drill(tmp_path).run("job.kmd").positions("x")[-1] == 5
    assert Drill(tmp_path).estimate("job.kmd").ticks > 0


def test_machines_and_folders_are_found_beside_the_test_too(tmp_path: Path) -> None:
    shutil.copytree(TABLES, tmp_path / "mine")
    drill, file = Drill(tmp_path), Path("mine") / "machines" / "pcb-drill.toml"
    for machine in (str(file), file):
        assert drill.machine(machine).file == drill.run("KMD_KONIEC", machine).machine.file == str(tmp_path / file)
    assert drill.machine("pcb-drill", tables="mine").file == str(tmp_path / file)


def test_a_long_queue_is_no_name_of_a_file(tmp_path: Path) -> None:
    assert Drill(tmp_path).run("KMD_GOTOdXdY 1 0\n" * 400).positions("x")[-1] == 400


def test_a_difference_is_told_by_its_tick(drill: Drill) -> None:
    lines = explain(drill.run("KMD_GOTOdXdY 30 0"), drill.run("KMD_GOTOdXdY 0 30"))
    assert "tick 6" in "\n".join(lines) and "out.0" in "\n".join(lines)
