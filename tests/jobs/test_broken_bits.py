"""A bit that breaks in a board: found, noted, the hole before it named; on resume a sister tool goes on, or an operator
is asked, and exactly what is left is drilled.
"""

import json
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.generation.eight_axis.magazine import Magazine, full_magazine
from drillctl.generation.eight_axis.program import board_program
from drillctl.generation.job import Job
from drillctl.generation.sequences import Change
from drillctl.generation.work_settings import WorkSettings
from drillctl.generation.worklist import build
from drillctl.jobs.magazine import MagazineFile
from drillctl.jobs.outcome import JobResult
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.tool_keeping import ToolKeeping
from drillctl.kmd import Fault, Op
from drillctl.machine import Machine
from drillctl.plant import PlantChoice
from drillctl.ticker.launch import RunSettings, start
from drillctl.ticker.link import LocalLink
from tests.generation.eight_axis.test_board_program import tool, with_tools
from tests.generation.test_worklist import drill_file
from tests.jobs.near_machine import near
from tests.support import journalled

BODY = "T1\nX4Y4\nX5Y4\nX5Y5\nX4Y5\nT2\nX5Y5"  # holes 1 to 5, of 0.8 and 1.0 mm
SISTERS = near(with_tools(tool(1, 0.8), tool(2, 1.0), tool(7, 0.8, magazine_place=3)))
ALONE = near(with_tools(tool(1, 0.8), tool(2, 1.0)))


def job(machine: Machine, spindles: tuple[int, ...], magazine: Magazine, done: set[int]) -> Job:
    settings = WorkSettings(spindles=spindles)
    work = build(drill_file(BODY), settings, machine).without(done)
    return Job("b", board_program(work, machine, settings, magazine), machine, work)


def run(made: Job, kept: MagazineFile, plant: PlantChoice, breaks: dict[int, int]) -> JobResult:
    """Runs a job; on the ideal plant bits are made to break by head: at which of their touches."""
    link = start(made.machine, RunSettings(plant=plant, engine="tick"), Path())
    with closing(link):
        assert isinstance(link, LocalLink) and link.ticker.plant is not None
        for spindle, touch in breaks.items():
            chuck = link.ticker.plant.chucks.of(made.machine.drill_axes[spindle - 1])
            assert chuck is not None
            chuck.breaks_at = touch
        return JobRunner(made, link, lambda progress: None, tools=ToolKeeping(made, kept)).run()


def held(machine: Machine, spindles: tuple[int, ...], tmp_path: Path) -> MagazineFile:
    """The record with the first tool in these spindles."""
    kept = MagazineFile(tmp_path / "record.magazine", machine)
    kept.keep(full_magazine(machine).with_chucks(spindles, 1).with_bits(1, spindles, False))
    return kept


@pytest.mark.parametrize(("spindles", "broken"), [((1, 3), 3), ((4,), 4), ((1, 2, 3, 4, 5, 6), 6)])
@pytest.mark.parametrize("dynamic", [False, True], ids=["ideal", "dynamic"])
@pytest.mark.parametrize("machine", [SISTERS, ALONE], ids=["sister", "alone"])
def test_a_bit_that_breaks_is_found_and_noted_and_the_rest_is_drilled_with_another(
    machine: Machine, spindles: tuple[int, ...], broken: int, dynamic: bool, tmp_path: Path
) -> None:
    kept = held(machine, spindles, tmp_path)
    third = 3  # the touch of depth detection, then hole 1, then hole 2
    plant = PlantChoice("dynamic", (f"breaks.z{broken}={third}",)) if dynamic else PlantChoice()
    first = run(job(machine, spindles, kept.magazine, set()), kept, plant, {} if dynamic else {broken: third})
    assert first.outcome.fault is not None and first.outcome.fault.code == Fault.BIT_BROKEN
    assert first.outcome.fault.axes == (f"z{broken}",)
    assert first.outcome.position_known and not any(first.outcome.position.values())  # the bits are out of the boards
    found_at_once = first.outcome.holes_done == 1  # by the touch that ended within its own stroke
    assert first.outcome.suspect == ((1,) if found_at_once else (2,))
    magazine = MagazineFile(kept.file, machine).magazine
    assert magazine.hits_left(machine, 1) == 0 and magazine.unknown() == ([], [])

    done = set(range(1, first.outcome.holes_done + 1))
    rest = job(machine, spindles, magazine, done)
    tools = rest.program["args"][rest.program["opcode"] == Op.NARZEDZIE, :3].tolist()
    automatic, asked = int(Change.AUTOMATIC), int(Change.WITHIN | Change.RENEWED)
    with_sister, renewed = [[1, automatic, 7]], [[1, automatic, 1], [1, asked, 1]]
    assert tools == [*(with_sister if machine is SISTERS else renewed), [2, automatic, 2]]

    second = run(rest, kept, PlantChoice("dynamic") if dynamic else PlantChoice(), {})
    assert second.outcome.fault is None and second.outcome.suspect == ()
    drilled = sorted((hole.number, hole.spindle) for hole in second.holes)
    assert drilled == [(number, spindle) for number in range(1, 6) if number not in done for spindle in spindles]


def test_a_bit_that_is_broken_when_it_is_taken_makes_no_hole_before_it_doubtful(tmp_path: Path) -> None:
    kept = held(ALONE, (1, 3), tmp_path)
    made = job(ALONE, (1, 3), kept.magazine, set())
    link = start(ALONE, RunSettings(engine="tick"), Path())
    with closing(link):
        assert isinstance(link, LocalLink) and link.ticker.plant is not None
        runner = JobRunner(made, link, lambda progress: None, tools=ToolKeeping(made, kept))
        chuck = link.ticker.plant.chucks.of(ALONE.drill_axes[0])
        assert chuck is not None
        runner.begin()
        while not runner.advance():
            if runner.status["tool"] == 2:
                chuck.short_steps = 100  # of the second tool
        result = runner.end()
    assert result.outcome.fault is not None and result.outcome.fault.name == "BIT_BROKEN"
    assert (result.outcome.holes_done, result.outcome.suspect) == (4, ())
    magazine = MagazineFile(kept.file, ALONE).magazine
    assert (magazine.hits_left(ALONE, 1), magazine.hits_left(ALONE, 2)) == (4996, 0)


def test_a_machine_without_breakage_range_or_descent_does_not_look(tmp_path: Path) -> None:
    known = ALONE.parameters
    assert known is not None
    blind = replace(ALONE, parameters=replace(known, axes=tuple(
        (name, replace(row, values=tuple((key, 0.0 if key == "depth_detection_descent_mm" else value)
                                         for key, value in row.values))) for name, row in known.axes)))  # fmt: skip
    kept = held(blind, (1, 3), tmp_path)
    made = job(blind, (1, 3), kept.magazine, set())
    assert Op.DOTYK not in made.program["opcode"]
    assert run(made, kept, PlantChoice(), {3: 2}).outcome.fault is None


def test_a_board_whose_bit_breaks_is_resumed_and_every_hole_is_drilled_once(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = ("--machine", "eight-axis", "--plant", "dynamic", "--fault", "breaks.z2=3", "--spindles", "1,2")
    assert journalled.run(*broken) == 1
    told = json.loads(capsys.readouterr().out)
    assert (told["fault"]["name"], told["holes_done"], told["suspect"]) == ("BIT_BROKEN", 2, [2])
    first = journalled.holes(folder)
    assert journalled.resume("--elsewhere", "--plant", "ideal") == 0
    outcome = capsys.readouterr()
    assert "look at hole 2 (X3.0000 Y1.0000 mm): a bit was found broken after it" in outcome.err
    assert json.loads(outcome.out)["holes_done"] == 4
    assert len(first) == 5 and len(journalled.holes(folder)) == 4  # spindle 1 has met its board at hole 3 as well
    assert "tool.4: 5999 holes left" in shown(capsys)


def shown(capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["magazine", "list", "--machine", "eight-axis"]) == 0
    return capsys.readouterr().out
