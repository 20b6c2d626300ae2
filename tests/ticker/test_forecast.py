"""The forecast against the run itself: error 0, for boards with every option, for queues, on every machine."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from drillctl.generation.drillfile import decode
from drillctl.generation.job import Job, names_of
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.pcb_drill.program import board_program
from drillctl.generation.placing import Panel, Placing
from drillctl.generation.readers import load_job
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.jobs.estimate import estimate
from drillctl.jobs.runner import JobRunner
from drillctl.kmd import parse_program
from drillctl.machine import Library
from drillctl.ticker.forecast import forecast
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker

LIBRARY = Library.standard()
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
BOARDS = [("pcb-drill", 8, 8), ("pcb-drill-ramp-lab", 8, 8), ("eight-axis", 2, 1)]  # holes at most, boards; 8000 Hz


def board_job(holes_mm: list[tuple[float, float]], tools: list[int], settings: WorkSettings, machine_name: str) -> Job:
    lines = ["M48", "METRIC", "T1C0.800", "T2C1.200", "%"]
    for (x, y), tool in zip(holes_mm, tools, strict=True):
        lines += [f"T{tool}", f"X{x:.3f}Y{y:.3f}"]
    machine = LIBRARY.machine(machine_name)
    drill_file = decode("\n".join([*lines, "M30", ""]).encode(), name="board.drl")
    work = build(drill_file, settings, machine)
    return Job("board.drl", board_program(work, machine, settings), machine, work)


def silent(progress: object) -> None:
    """Nobody looks."""


holes = st.tuples(st.floats(0, 40).map(lambda v: round(v, 3)), st.floats(0, 30).map(lambda v: round(v, 3)))
work_settings = st.builds(
    WorkSettings,
    placing=st.builds(
        Placing,
        rotate_deg=st.sampled_from([0.0, 90.0, 33.3]),
        mirror=st.sampled_from([None, "x", "y"]),
        panel=st.sampled_from([None, Panel(2, 1, 45.0, 0.0)]),
    ),
    order=st.sampled_from(["file", "nearest", "optimised"]),
    peck_mm=st.sampled_from([None, 1.5]),
    spot_mm=st.sampled_from([None, 0.4]),
)


@pytest.mark.parametrize(("machine", "most", "boards"), BOARDS)
def test_a_boards_forecast_is_its_run(machine: str, most: int, boards: int) -> None:
    @settings(max_examples=boards, deadline=None, phases=[Phase.generate])  # to shrink takes as long as the rest
    @given(holes_mm=st.lists(holes, min_size=1, max_size=most, unique=True), wanted=work_settings, data=st.data())
    def holds(holes_mm: list[tuple[float, float]], wanted: WorkSettings, data: st.DataObject) -> None:
        check_forecast(machine, holes_mm, wanted, data)

    holds()


def check_forecast(
    machine: str, holes_mm: list[tuple[float, float]], wanted: WorkSettings, data: st.DataObject
) -> None:
    """The run is ticked, the forecast is not."""
    tools = data.draw(st.lists(st.sampled_from([1, 2]), min_size=len(holes_mm), max_size=len(holes_mm)))
    job = board_job(holes_mm, tools, wanted, machine)
    outcome = JobRunner(job, LocalLink(Ticker.simulated(job.machine)), silent).run().outcome
    told = estimate(job)
    assert outcome.fault is None and outcome.holes_done == job.holes_total
    assert told.ticks == outcome.ticks
    assert sum(tool.ticks for tool in told.tools) == told.ticks
    assert not any(outcome.lost_steps.values() if outcome.lost_steps else [1])


@pytest.mark.parametrize("machine", ["pcb-drill", "pcb-drill-ramp-lab", "boiler-drum", "eight-axis"])
@pytest.mark.parametrize("name", ["short-moves.kmd"])
def test_a_queues_forecast_is_its_run(machine: str, name: str) -> None:
    job = load_job(EXAMPLES / name, LIBRARY.machine(machine), JobSetup("pcb-drill"))
    assert estimate(job).ticks == JobRunner(job, LocalLink(Ticker.simulated(job.machine)), silent).run().outcome.ticks


def test_each_command_has_its_own_ticks() -> None:
    machine = LIBRARY.machine("pcb-drill")
    program = parse_program("KMD_GOTOdXdY 30 0\nKMD_CZEKAJ 9\nKMD_GOTOdXdY 3 4\n", names_of(machine))
    assert forecast(program, machine).ticks.tolist() == [51, 9, 18, 1]


def test_a_program_that_ends_in_a_fault_says_which() -> None:
    machine = LIBRARY.machine("pcb-drill")
    program = parse_program("KMD_GOTO_X_Y 1 1\n", names_of(machine))
    assert forecast(program, machine).fault != 0


def test_the_quick_way_and_the_long_way_agree() -> None:
    """The same program foreseen and ticked through."""
    rng = np.random.default_rng(720)
    points = [(float(x), float(y)) for x, y in rng.uniform(0, 30, (12, 2)).round(3)]
    job = board_job(points, [1] * 6 + [2] * 6, WorkSettings(order="nearest", peck_mm=2.0), "pcb-drill")
    quick, whole = forecast(job.program, job.machine), forecast(job.program, job.machine, engine="tick")
    assert np.array_equal(quick.ticks, whole.ticks)
