"""The magazine record: kept across a cut at every step of a change and never untrue, and what a job makes of it."""

from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from drillctl.generation.eight_axis.magazine import EMPTY, Magazine, full_magazine
from drillctl.generation.eight_axis.program import board_program
from drillctl.generation.job import Job
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.jobs.magazine import MagazineError, MagazineFile
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.tool_keeping import ToolKeeping
from drillctl.kmd import Fault
from drillctl.machine import Machine
from drillctl.machine.parameters import ParameterRow
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.link import LocalLink
from tests.generation.eight_axis.test_board_program import AUTO
from tests.generation.test_worklist import drill_file

SPINDLES = (1, 3)
MOST_TICKS = 200_000
NEAR_MM = {1: (9.0, 4.0), 2: (11.0, 4.0), 3: (13.0, 4.0)}  # places of the magazine, so that a change takes few ticks


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


def test_a_cut_at_any_step_leaves_a_record_that_is_true_and_a_whole_one_ends_with_the_new_tool(
    kept: MagazineFile,
) -> None:
    run = runner(MACHINE, kept)
    assert isinstance(run.link, LocalLink)
    unknown_at, seen = set(), set()
    with closing(run.link):
        for step in stepped(run):
            on_disk = MagazineFile(kept.file, MACHINE).magazine
            check_true(on_disk, run.link)
            seen.add(step)
            if any(on_disk.unknown()):
                unknown_at.add(step)
        assert not run.status["fault"] and len(run.holes) == 6
    assert set(range(1, 24)) <= seen
    assert unknown_at <= {*range(5, 11), *range(15, 21)} and {6, 7, 8, 16, 17, 18} <= unknown_at
    magazine = MagazineFile(kept.file, MACHINE).magazine
    assert [magazine.chucks[n] for n in SPINDLES] == [2, 2] and magazine.hits == {1: 1, 2: 2}
    assert magazine.bits[1, 1] is True and magazine.bits[2, 1] is False and magazine.unknown() == ([], [])


TIMES = {
    3: Fault.CHANGE_NOT_THERE, 4: Fault.CHANGE_NOT_THERE, 5: Fault.CHANGE_HEIGHT, 7: Fault.CHANGE_CHUCK,
    8: Fault.CHANGE_Z_NOT_HOME, 9: Fault.CHANGE_NOT_THERE, 13: Fault.CHANGE_NOT_THERE, 14: Fault.CHANGE_NOT_THERE,
    15: Fault.CHANGE_HEIGHT, 17: Fault.CHANGE_CHUCK, 18: Fault.CHANGE_Z_NOT_HOME, 19: Fault.CHANGE_NOT_THERE,
}  # fmt: skip
FAILURES = [*((number, "time", fault) for number, fault in TIMES.items()),
            (10, "stuck", Fault.TOOL_NOT_LEFT), (20, "missing", Fault.TOOL_NOT_TAKEN),
            (20, "dropped", Fault.TOOL_NOT_TAKEN),
            *((number, "sensor", Fault.CHANGE_Z_NOT_HOME) for number in (1, 8, 11, 18, 21))]  # fmt: skip


@pytest.mark.parametrize(("number", "how", "fault"), FAILURES)
def test_a_step_that_fails_is_named_and_what_it_made_doubtful_is_unknown(
    number: int, how: str, fault: Fault, kept: MagazineFile
) -> None:
    run = runner(with_limit(number, 0.001) if how == "time" else MACHINE, kept, done={1})
    assert isinstance(run.link, LocalLink)
    with closing(run.link):
        spoil(run.link, how)
        for step in stepped(run):
            if how == "sensor" and run.status["position_known"] and step == number - 1:
                silence(run.link, "z1_home")
            check_true(MagazineFile(kept.file, MACHINE).magazine, run.link)
        assert (int(run.status["step"]), Fault(run.status["fault"])) == (number, fault)
        assert run.holes == []
    chucks, bits = MagazineFile(kept.file, MACHINE).magazine.unknown()
    leaving, taking = 5 <= number < 11, 15 <= number < 21
    assert chucks == ([1, 3] if leaving or taking else [])
    assert {place for place, _ in bits} == ({1} if leaving else {2} if taking else set())


def with_limit(number: int, limit_s: float) -> Machine:
    """The machine with another time limit of a step."""
    assert MACHINE.tool_changer is not None
    steps = list(MACHINE.tool_changer.steps)
    steps[number - 1] = replace(steps[number - 1], limit_s=limit_s)
    return replace(MACHINE, tool_changer=replace(MACHINE.tool_changer, steps=tuple(steps)))


def silence(link: LocalLink, sensor: str) -> None:
    """The sensor does not answer from now on."""
    port, bit = link.ticker.port, next(1 << each.bit for each in MACHINE.sensors if each.name == sensor)
    latch = port.latch
    port.latch = lambda: latch() & ~bit  # type: ignore[method-assign]


def spoil(link: LocalLink, how: str) -> None:
    """Makes a tool stay in the chuck of spindle 1, be missing in its place, or fall out on the way up."""
    plant = link.ticker.plant
    assert plant is not None
    chuck = plant.chucks.of(MACHINE.drill_axes[0])
    assert chuck is not None
    if how == "stuck":
        chuck.output = 0  # it does not open
    elif how == "missing":
        magazine = plant.chucks._magazine  # the plant has no other door to it
        assert magazine is not None
        magazine.take((2, 1))
    elif how == "dropped":
        chuck.drops_at = 1


def test_a_record_that_another_run_has_changed_stops_the_job(kept: MagazineFile) -> None:
    run = runner(MACHINE, kept)
    with closing(run.link):
        run.begin()
        MagazineFile(kept.file, MACHINE).keep(full_magazine(MACHINE))
        while not run.advance():
            pass
    assert "another run has changed it" in str(run.trouble)
    assert MagazineFile(kept.file, MACHINE).magazine == full_magazine(MACHINE)


@pytest.mark.parametrize("text", ["", "{}", '{"drillctl-magazine": 2}', "[" * 5000, '{"drillctl-magazine": "x"}'])
def test_what_is_no_record_is_refused_by_the_name_of_the_file(text: str, tmp_path: Path) -> None:
    file = tmp_path / "m.magazine"
    file.write_text(text)
    with pytest.raises(MagazineError, match=r"m\.magazine: is no magazine record"):
        MagazineFile(file, MACHINE)
    assert file.read_text() == text
