"""A board that was reset makes no hole that is told as done: a piece of benchmarks/board_resets.py, which tries all."""

from pathlib import Path

import pytest

from drillctl.generation.job import Job
from tests.campaign.board_resets import Reset, play, short_job
from tests.campaign.resetting_board import play_round

pytestmark = pytest.mark.paced

EVERY = 17  # wakes of some 420
QUIET_WAKES, SILENT_WAKES = 25, 500  # within which a loss is told: a question's beat and its answer; its patience


@pytest.fixture(scope="module")
def job(tmp_path_factory: pytest.TempPathFactory) -> Job:
    return short_job(tmp_path_factory.mktemp("short"))


def test_without_a_reset_all_holes_are_made_and_told(job: Job) -> None:
    played = play(job, Reset())
    assert (played.outcome.holes_done, played.made, played.outcome.fault) == (3, 3, None)
    assert played.outcome.position_known


@pytest.mark.parametrize(
    ("greets", "silent", "longest", "every"),
    [(True, False, 3, EVERY), (False, False, QUIET_WAKES, EVERY), (False, True, SILENT_WAKES, 3 * EVERY)],
    ids=["greets", "quiet", "silent"],
)
def test_a_reset_at_any_tick(job: Job, greets: bool, silent: bool, longest: int, every: int) -> None:
    wakes = play(job, Reset()).wakes
    lost = 0
    for wake in range(0, wakes, every):
        reset = Reset(wake, greets, silent)
        played = play(job, reset)
        assert not played.violations(reset)
        assert played.told_after <= longest
        lost += played.outcome.fault is not None
    assert lost >= wakes // every


@pytest.mark.long
@pytest.mark.timeout(300)
def test_the_program_on_a_board_that_resets_quietly_and_its_resume(tmp_path: Path) -> None:
    played = play_round(short_job(tmp_path), tmp_path, message=100, greets=False)
    assert (played.was_reset or played.busy) and not played.violations
