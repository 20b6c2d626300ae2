"""The production drill with everything near, so that a change takes few ticks; its jobs run a command at a time."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from drillctl.generation.eight_axis.magazine import EMPTY, Magazine, full_magazine
from drillctl.generation.eight_axis.program import board_program
from drillctl.generation.job import Job
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.jobs.magazine import MagazineFile
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.tool_keeping import ToolKeeping
from drillctl.machine import Machine
from drillctl.machine.parameters import ParameterRow
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.link import LocalLink
from tests.generation.eight_axis.test_board_program import AUTO
from tests.generation.test_worklist import drill_file

SPINDLES = (1, 3)
MOST_TICKS = 200_000
NEAR_MM = {1: (9.0, 4.0), 2: (11.0, 4.0), 3: (13.0, 4.0)}  # places of the magazine


def near(machine: Machine) -> Machine:
    """The machine with everything near, and the first tool in the spindles when the simulation begins."""
    assert machine.parameters is not None and machine.tool_changer is not None
    near_by = {"parking_x_mm": 7.0, "parking_y_mm": 3.0, "change_height_mm": 2.0, "depth_detection_depth_mm": 0.2}
    system = {**dict(machine.parameters.system.values), **near_by}
    places = tuple(ParameterRow((("place", n), ("x_mm", x), ("y_mm", y))) for n, (x, y) in NEAR_MM.items())
    parameters = replace(machine.parameters, system=ParameterRow(tuple(system.items())), places=places)
    steps = tuple(replace(step, delay_s=min(step.delay_s, 0.01)) for step in machine.tool_changer.steps)
    x, y, *heads = machine.axes
    return replace(
        machine,
        axes=(replace(x, start_steps=300), replace(y, start_steps=300), *heads),
        drill_down_steps=300, drill_clear_steps=250, board_surface=(None, None, *[280] * len(heads)),
        parameters=parameters, tool_changer=replace(machine.tool_changer, steps=steps),
    )  # fmt: skip


MACHINE = near(AUTO)
WORK = build(drill_file("T1\nX4Y4\nT2\nX5Y4\nX5Y5"), WorkSettings(), MACHINE)
HELD = full_magazine(MACHINE).with_chucks(SPINDLES, 1).with_bits(1, SPINDLES, False)


def job(machine: Machine, magazine: Magazine, done: set[int] | None = None) -> Job:
    settings = WorkSettings(spindles=SPINDLES)
    work = WORK.without(done or set())
    return Job("b", board_program(work, machine, settings, magazine), machine, work)


@pytest.fixture
def kept(tmp_path: Path) -> MagazineFile:
    record = MagazineFile(tmp_path / "record.magazine", MACHINE)
    record.keep(HELD)
    return record


def runner(machine: Machine, kept: MagazineFile, done: set[int] | None = None) -> JobRunner:
    made = job(machine, kept.magazine, done)
    link = start(machine, RunSettings(), Path())
    return JobRunner(made, link, lambda progress: None, tools=ToolKeeping(made, kept))


def check_true(magazine: Magazine, link: LocalLink) -> None:
    """Whatever the record claims to know is so on the machine."""
    plant = link.ticker.plant
    assert plant is not None
    for spindle in SPINDLES:
        chuck = plant.chucks.of(MACHINE.drill_axes[spindle - 1])
        assert chuck is not None
        if magazine.chucks[spindle] is not None:
            assert chuck.held == (magazine.chucks[spindle] != EMPTY), f"spindle {spindle}"


def stepped(run: JobRunner) -> Iterator[int]:
    """Runs a job to its end; yields the step of the tool change after each command."""
    assert isinstance(run.link, LocalLink)
    ticker = run.link.ticker

    def one_command() -> None:
        before = ticker.controller.done
        ticker.run(MOST_TICKS, lambda: ticker.controller.done != before or ticker.over())

    run.link.turn = one_command  # type: ignore[method-assign]
    run.begin()
    over = False
    while not over:
        over = run.advance()
        yield int(run.status["step"])
