"""The fixture as another repository's tests use it."""

from pathlib import Path

from drillctl.api.fixture import Drill, explain


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


def test_a_difference_is_told_by_its_tick(drill: Drill) -> None:
    lines = explain(drill.run("KMD_GOTOdXdY 30 0"), drill.run("KMD_GOTOdXdY 0 30"))
    assert "tick 6" in "\n".join(lines) and "out.0" in "\n".join(lines)
