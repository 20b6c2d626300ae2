"""A whole board on the dynamic plant: what its builder reports of the drill, 580 Hz at best, with Z drilling."""

from pathlib import Path

import pytest

from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.jobs.runner import JobRunner
from drillctl.machine import Library, shipped_tables
from drillctl.plant import PlantChoice
from drillctl.ticker.link import LocalLink
from drillctl.ticker.ticker import Ticker
from drillctl.viewmodel.records import Outcome

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# Two holes: a way of some 500 steps in X and 300 in Y between them.
SHORT = "M48\nMETRIC\nT1C0.8\n%\nG90\nT1\nX2.0Y2.0\nX12.0Y9.0\nM30\n"
AT_BEST_HZ, TOO_FAST_HZ = 580, 600


def drilled(file: Path, tick_hz: int) -> Outcome:
    """On pcb-drill with its nominal figures."""
    machine = Library((shipped_tables(),)).machine("pcb-drill").at_rate(tick_hz)
    link = LocalLink(Ticker.simulated(machine, plant_choice=PlantChoice("dynamic")))
    return JobRunner(load_job(file, machine, JobSetup("pcb-drill")), link, lambda progress: None).run().outcome


def loses(outcome: Outcome) -> bool:
    assert outcome.lost_steps is not None
    return any(outcome.lost_steps.values())


def test_a_board_is_drilled_without_loss_at_580_hz_and_not_at_600(tmp_path: Path) -> None:
    (tmp_path / "short.drl").write_text(SHORT)
    sound, fast = (drilled(tmp_path / "short.drl", hz) for hz in (AT_BEST_HZ, TOO_FAST_HZ))
    assert (sound.holes_done, sound.fault, loses(sound)) == (2, None, False)
    assert loses(fast)


@pytest.mark.long
@pytest.mark.timeout(300)
@pytest.mark.parametrize("hz", [500, 560, 575, 580])
def test_the_example_board_loses_nothing_up_to_580_hz(hz: int) -> None:
    outcome = drilled(EXAMPLES / "blinker.drl", hz)
    assert (outcome.holes_done, outcome.fault, loses(outcome)) == (26, None, False)


@pytest.mark.long
@pytest.mark.timeout(300)
@pytest.mark.parametrize("hz", [590, 600, 640])
def test_the_example_board_loses_steps_above(hz: int) -> None:
    assert loses(drilled(EXAMPLES / "blinker.drl", hz))
