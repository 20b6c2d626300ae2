"""What a job is made by: what a journal holds of it makes the same job again, from any working base."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.measured import AlignmentError
from drillctl.generation.readers import load_job
from drillctl.jobs.estimate import estimate
from drillctl.jobs.session import Session
from drillctl.kmd import Op
from drillctl.machine import Library, Machine
from drillctl.ticker.launch import RunSettings
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf
from tests.support.journalled import BOARD

FULL = JobSetup(
    machine="pcb-drill", tables="/tables", tick_hz=500, base=(120, 240),
    options=JobOptions(
        origin="file", mirror="x", rotate_deg=90.0, offset_mm=(1.0, 2.0), panel=PanelOf(2, 1, 30.0, 0.0),
        align=(MeasuredHole(0.0, 0.0, 1.0, 1.0), MeasuredHole(5.0, 0.0, 6.0, 1.0)), order="nearest", skip_tools=(2,),
        drills="/drills.toml", peck_mm=0.5, spot_mm=0.2, format="mm,decimal", after_end="drill",
    ),
)  # fmt: skip


@pytest.fixture
def machine() -> Machine:
    return Library.standard().machine("pcb-drill")


def job_of(setup: JobSetup, folder: Path, machine: Machine) -> Job:
    (folder / "job.drl").write_text(BOARD)
    return load_job(folder / "job.drl", machine, setup)


def test_a_setup_comes_back_from_json() -> None:
    assert JobSetup.of_journal(json.loads(json.dumps(FULL.as_journalled())), Path("j")) == FULL


def test_a_journal_of_version_1_is_read() -> None:
    """The names and forms are part of the journal's format (docs/SPEC.md, 3)."""
    written = (
        '{"machine":"pcb-drill","tables":"/tables","tick_hz":500,"origin":"file","mirror":"x","rotate":90.0,'
        '"offset":[1.0,2.0],"align":[[0.0,0.0,1.0,1.0],[5.0,0.0,6.0,1.0]],"panel":[2,1,30.0,0.0],"order":"nearest",'
        '"skip_tools":[2],"drills":"/drills.toml","peck":0.5,"spot":0.2,"format":"mm,decimal","after_end":"drill",'
        '"base":[120,240]}'
    )
    assert JobSetup.of_journal(json.loads(written), Path("j")) == FULL
    again = json.loads(json.dumps(FULL.as_journalled()))
    assert {name: again[name] for name in json.loads(written)} == json.loads(written)


@pytest.mark.parametrize(
    "told",
    [
        {},
        {"machine": 3},
        {"machine": "m", "twist": 1},
        {"machine": "m", "panel": [1, 2]},
        {"machine": "m", "after_end": "sell"},
    ],
)
def test_what_are_no_job_options_is_refused(told: dict[str, object]) -> None:
    with pytest.raises(JobError, match=r"j:1: .*another version of this program"):
        JobSetup.of_journal(told, Path("j"))


def test_measured_holes_and_a_file_of_them_are_the_same(tmp_path: Path, machine: Machine) -> None:
    (tmp_path / "holes.txt").write_text("1 1 6 4\n3 1 8 4\n1 3 6 6\n")
    rows = tuple(MeasuredHole(*row) for row in ((1, 1, 6, 4), (3, 1, 8, 4), (1, 3, 6, 6)))
    by_file = job_of(JobSetup("pcb-drill", JobOptions(align=str(tmp_path / "holes.txt"))), tmp_path, machine)
    by_hand = job_of(JobSetup("pcb-drill", JobOptions(align=rows)), tmp_path, machine)
    assert by_file.program.tobytes() == by_hand.program.tobytes()


@pytest.mark.parametrize("base", [(0, 0), (600, 240), (0, 48)])
def test_the_estimate_is_exact_from_any_base(base: tuple[int, int], tmp_path: Path, machine: Machine) -> None:
    job = job_of(JobSetup(machine="pcb-drill", base=base), tmp_path, machine)
    outcome = Session(job, RunSettings()).run(lambda progress: None).outcome
    assert outcome.fault is None and outcome.ticks == estimate(job).ticks
    assert [outcome.position[name] for name in ("x", "y")] == list(base)
    assert (Op.BAZA in job.program["opcode"]) == any(base)


def test_a_base_moves_every_hole_as_far(tmp_path: Path, machine: Machine) -> None:
    base = (600, 240)
    made = {
        where: Session(job_of(JobSetup(machine="pcb-drill", base=where), tmp_path, machine), RunSettings())
        .run(lambda progress: None)
        .holes
        for where in ((0, 0), base)
    }
    places = [np.array([(hole.x_mm, hole.y_mm) for hole in holes]) for holes in made.values()]
    shift_mm = np.array(base) / [machine.axes[axis].steps_per_mm for axis in (0, 1)]
    np.testing.assert_allclose(places[1] - places[0], np.tile(shift_mm, (4, 1)), atol=0.07)


@pytest.mark.parametrize("name", ["board.drl", "queue.kmd"])
@pytest.mark.parametrize(
    "changed", [{"peck_mm": 0.001}, {"drills": "/nowhere/drills.toml"}, {"align": ((0.0,) * 4,) * 2}]
)
def test_options_that_cannot_be_meant_are_refused_for_every_kind_of_job(
    name: str, changed: dict[str, Any], tmp_path: Path, machine: Machine
) -> None:
    (tmp_path / name).write_text("KMD_KONIEC\n" if name.endswith(".kmd") else BOARD)
    load_job(tmp_path / name, machine, JobSetup(machine="pcb-drill"))
    with pytest.raises((JobError, AlignmentError)):
        load_job(tmp_path / name, machine, JobSetup("pcb-drill", JobOptions(**changed)))
