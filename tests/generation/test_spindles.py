"""Which spindles drill: every one that was chosen makes every hole, and the others stay up."""

import pytest

from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.pcb_drill.program import board_program
from drillctl.generation.spindles import heads_of
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.machine import Machine
from drillctl.machine.library import Library
from drillctl.plant import IDEAL_PLANT
from drillctl.ticker.program_run import run_program
from tests.generation.test_worklist import drill_file

EIGHT, PCB = (Library.standard().machine(name) for name in ("eight-axis", "pcb-drill"))


@pytest.mark.parametrize(
    ("machine", "chosen", "axes"), [(EIGHT, (), (2, 3, 4, 5, 6, 7)), (EIGHT, (1, 6), (2, 7)), (PCB, (1,), (2,))]
)
def test_spindles_are_counted_from_1_in_the_order_of_the_file(
    machine: Machine, chosen: tuple[int, ...], axes: tuple[int, ...]
) -> None:
    assert heads_of(machine, chosen) == axes


@pytest.mark.parametrize(("machine", "number", "count"), [(EIGHT, 7, 6), (PCB, 2, 1)])
def test_a_spindle_that_a_machine_lacks_is_refused_by_name(machine: Machine, number: int, count: int) -> None:
    with pytest.raises(JobError, match=f"has no spindle {number}; it has {count}"):
        heads_of(machine, (1, number))


def test_each_chosen_spindle_makes_each_hole() -> None:
    settings = WorkSettings(spindles=(2, 5), spot_mm=0.2)
    work = build(drill_file("T1\nX1Y1\nX2Y0"), settings, EIGHT)
    job = Job("b", board_program(work, EIGHT, settings), EIGHT, work)
    run = run_program(job.program, EIGHT, IDEAL_PLANT)
    made = [job.made_hole(*touch) for touch in run.touches]
    assert run.complete and [(round(hole.x_mm), hole.spindle) for hole in made] == [(1, 2), (1, 5), (2, 2), (2, 5)]
