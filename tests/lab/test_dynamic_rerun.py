"""A recorded run once more on the dynamic plant: what was run comes again; and what pictures show of it."""

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from drillctl.cli import main
from drillctl.lab.dynamic_rerun import rerun_axis
from drillctl.lab.errors import LabError
from drillctl.lab.moves import move
from drillctl.lab.pictures import PICTURES, Window, greatest_torque_nm, pull_out
from drillctl.lab.trials import Trial, errors_full_steps, lost
from drillctl.machine import Library, shipped_tables

LIBRARY = Library((shipped_tables(),))
QUEUE = "KMD_INICJALIZACJA\nKMD_GOTO_X_Y 60 40\nKMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\nKMD_GOTO_X_Y 7 95\n" + (
    "KMD_WIERTLO_DOL\nKMD_WIERTLO_GORA\n"
)
SENT = ((60, 40), (7, 95))
Recording = Callable[..., Path]


@pytest.fixture
def recorded(tmp_path: Path) -> Recording:
    """Runs the queue; the trace, with the holes CSV beside it."""

    def run(*options: str, queue: str = QUEUE) -> Path:
        job = tmp_path / "job.kmd"
        job.write_text(queue)
        outputs = ("--trace", str(job.with_suffix(".trace")), "--holes", str(job.with_suffix(".csv")))
        assert main(["run", str(job), *outputs, *options]) == 0
        return job.with_suffix(".trace")

    return run


def test_holes_are_as_far_off_as_they_were_in_the_run(recorded: Recording) -> None:
    """Faults and seed are the run's: play in the belt shows, and is told by nobody but the plant."""
    trace = recorded("--plant", "dynamic", "--fault", "loose.x=0.3", "--seed", "5")
    run = rerun_axis(trace, LIBRARY)
    with trace.with_suffix(".csv").open(newline="") as stream:
        in_run = [(float(row["x_mm"]), float(row["y_mm"])) for row in csv.DictReader(stream)]
    wanted = np.array(SENT) / [axis.steps_per_mm for axis in run.machine.axes[:2]]
    assert run.as_run
    assert run.holes.made_mm - run.holes.sent_mm == pytest.approx(np.array(in_run) - wanted, abs=1e-4)
    assert np.abs(run.holes.made_mm - run.holes.sent_mm)[:, 0].max() > 0.1


@pytest.mark.parametrize("machine", ["pcb-drill", "pcb-drill-ramp-lab"])
def test_the_rotor_follows_the_columns(machine: str, recorded: Recording) -> None:
    """Of a run on the ideal plant: what motors with inertia make of it. Nothing is lost at 500 Hz."""
    run = rerun_axis(recorded("--machine", machine), LIBRARY, "y")
    behind = (run.commanded - run.rotor.columns) * 4 / 12
    assert not run.as_run and len(behind) == len(run.rotor.currents)
    assert np.abs(behind).max() < 2.5 and abs(behind[-1]) < 1
    assert np.ptp(run.commanded) >= 95 * run.table.columns_per_step


def test_an_axis_the_other_way_about(recorded: Recording, tmp_path: Path) -> None:
    """An inverted X goes where X goes, its rotor the other way."""
    text = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
    (tmp_path / "machines").mkdir()
    text = text.replace('name = "x"\n', 'name = "x"\ninvert = true\n', 1)
    (tmp_path / "machines" / "pcb-drill.toml").write_text(text)
    plain = rerun_axis(recorded("--plant", "dynamic"), LIBRARY, "x")
    inverted = ("--tables", str(tmp_path), "--machine", "pcb-drill", "--plant", "dynamic")
    turned = rerun_axis(recorded(*inverted), Library((tmp_path, shipped_tables())), "x")
    assert turned.table.invert
    assert turned.holes.sent_mm == pytest.approx(plain.holes.sent_mm, abs=0.1)
    assert turned.columns_per_mm == -plain.columns_per_mm
    assert turned.rotor.columns[-1] / turned.columns_per_mm == pytest.approx(
        plain.rotor.columns[-1] / plain.columns_per_mm, abs=0.1
    )


def test_pictures_say_what_the_run_did(recorded: Recording) -> None:
    run = rerun_axis(recorded("--plant", "dynamic"), LIBRARY, "x")
    seen = {what: draw(run, Window()) for what, draw in PICTURES.items() if what != "pull-out"}
    cruise = 500 / abs(run.columns_per_mm)
    commanded = seen["speed"].charts[0].curves[1]
    assert np.abs(commanded.y).max() == pytest.approx(cruise)
    assert np.unique(np.abs(commanded.y))[[0, -2, -1]] == pytest.approx([0, cruise / 2, cruise])
    assert seen["lag"].charts[1].curves[0].y == pytest.approx((run.commanded - run.rotor.columns) / 3)
    windings = [curve.label for chart in seen["currents"].charts for curve in chart.curves]
    assert windings == ["1a", "1b", "2b", "2a"] or windings == ["1a", "1b", "2a", "2b"]
    assert seen["board"].charts[0] is run.holes and "2 holes" in seen["board"].notes[0]
    assert f"{run.holes.times} times as long" in seen["board"].notes[1] and run.holes.tool.tolist() == [0, 0]
    assert [chart.y_label for chart in seen["motion"].charts] == ["speed, mm/s", "lag, full steps"]


def test_a_window_cuts_out_its_ticks(recorded: Recording) -> None:
    run = rerun_axis(recorded(), LIBRARY, "x")
    found = PICTURES["lag"](run, Window(100, 150)).charts[1].curves[0]
    assert found.x.tolist() == [(tick + 1) / 500 for tick in range(100, 150)]
    with pytest.raises(LabError, match="no ticks from 900000"):
        PICTURES["lag"](run, Window(900_000))


def test_what_can_not_be_watched_is_refused(recorded: Recording, tmp_path: Path) -> None:
    trace = recorded()
    with pytest.raises(LabError, match="no axis 'q'; there are x, y, z"):
        rerun_axis(trace, LIBRARY, "q")
    text = trace.read_text()
    digest = next(line for line in text.splitlines() if line.startswith("digest"))
    trace.write_text(text.replace(digest, "digest 0123456789abcdef"))
    with pytest.raises(LabError, match="other tables"):
        rerun_axis(trace, LIBRARY)
    with pytest.raises(LabError, match="no dynamics for"):
        rerun_axis(recorded("--machine", "mega-28byj48", queue="KMD_RUCHd x=20\n"), LIBRARY)


def test_a_board_without_holes_is_no_picture(recorded: Recording) -> None:
    run = rerun_axis(recorded(queue="KMD_RUCHd x=20\n"), LIBRARY)
    assert run.table.name == "x"
    with pytest.raises(LabError, match="no hole"):
        PICTURES["board"](run, Window())


def test_the_pull_out_curve_is_where_steps_begin_to_be_lost() -> None:
    """What it says is carried is carried; a little more is not; above the limit nothing is."""
    table = LIBRARY.machine("pcb-drill").axes[0]
    assert table.dynamics is not None
    found = pull_out(table, [400, 700], 1)
    torque_nm = float(found.torque_nm[0])
    assert 0 < torque_nm < greatest_torque_nm(table.dynamics) and np.isnan(found.torque_nm[1])
    loads = (torque_nm, torque_nm + greatest_torque_nm(table.dynamics) / 12**3)
    moves = [move(table, 300, column) for column in range(3)]
    errors = errors_full_steps(table, [Trial(each, 400, table.dynamics, load) for load in loads for each in moves])
    assert lost(errors).reshape(2, 3).any(axis=1).tolist() == [False, True]
