"""The tool change: asked once, never waited for, and nothing is drilled with the wrong tool."""

import io
from contextlib import closing
from pathlib import Path

import pytest

from drillctl.cli import main
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.runner import JobRunner
from drillctl.machine import Library
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker
from drillctl.ui.terminal.progress import ToolPrompt
from drillctl.viewmodel.records import Progress

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"


def test_the_prompt_asks_once_and_answers_when_enter_was_pressed() -> None:
    entered = iter((True, False, True, True))
    screen = io.StringIO()
    prompt = ToolPrompt(lambda: next(entered), screen)
    assert not prompt(2, 1.0), "what was pressed before the question is no answer"
    assert not prompt(2, 1.0)
    assert screen.getvalue() == "\ntool T2 (1.000 mm): insert it, then press Enter\n"
    assert prompt(2, 1.0)
    assert not prompt(2, 1.0), "the same tool again is a new question"


def silent(progress: Progress) -> None:
    """Nobody looks."""


def board() -> Job:
    return load_job(BLINKER, Library.standard().machine("pcb-drill"), JobSetup("pcb-drill"))


def test_each_tool_is_asked_for_before_its_first_hole() -> None:
    job = board()
    asked: list[tuple[int, float | None, int]] = []
    with closing(LocalLink(Ticker.simulated(job.machine))) as link:

        def change(tool: int, diameter_mm: float | None) -> bool:
            asked.append((tool, diameter_mm, int(link.status()["holes_done"])))
            return len(asked) % 3 == 0  # the operator takes his time

        outcome = JobRunner(job, link, silent, tool_change=change).run().outcome
    assert [(tool, done) for tool, _, done in asked[::3]] == [(1, 0), (2, 16), (3, 22)]
    assert asked[3][1] == 1.0
    assert outcome.holes_done == 26 and outcome.fault is None


def test_waiting_for_the_operator_costs_no_tick() -> None:
    job = board()
    ticks = []
    for patience in (1, 40):
        calls = 0

        def change(tool: int, diameter_mm: float | None, patience: int = patience) -> bool:
            nonlocal calls
            calls += 1
            return calls % patience == 0

        with closing(LocalLink(Ticker.simulated(job.machine))) as link:
            ticks.append(JobRunner(job, link, silent, tool_change=change).run().outcome.ticks)
    with closing(LocalLink(Ticker.simulated(job.machine))) as link:
        assert {JobRunner(job, link, silent).run().outcome.ticks} == set(ticks)


def test_without_a_terminal_asking_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(BLINKER), "--tools", "ask"]) == 2
    assert "no terminal" in capsys.readouterr().err
