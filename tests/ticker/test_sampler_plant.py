"""What a recording tells of the plant: where it is, and how far behind the controller."""

import numpy as np
import pytest

from drillctl.generation.job import names_of
from drillctl.kmd import parse_program
from drillctl.machine import Library
from drillctl.plant import PlantChoice
from drillctl.plant.base import CURRENT_LANES
from drillctl.ticker.ticker import Ticker
from drillctl.trace.shape import dense

CYCLE = 12  # columns: steps are lost by whole cycles
TICKS = 600


def seen(lane: str, hz: int, kind: str) -> np.ndarray:
    """Of X by tick, over a move of 400 columns and the rest after it."""
    machine = Library.standard().machine("pcb-drill").at_rate(hz)
    ticker = Ticker.simulated(machine, traced=True, derived=True, plant_choice=PlantChoice(kind))
    ticker.queue.put(parse_program("KMD_RUCHd x=400", names_of(machine)))
    ticker.run(TICKS)
    trace = ticker.finished_trace(())
    assert trace is not None
    return dense(trace, f"plant.x{lane}")


def behind_columns(hz: int, kind: str) -> np.ndarray:
    return seen("_behind", hz, kind)


def test_the_current_of_a_phase_turns_about_as_the_column_cycle_goes_round() -> None:
    """Twice in each of 33 cycles. At rest the holding current stands, which forcing has left far behind."""
    for lane in CURRENT_LANES[:2]:
        current_ma = seen(lane, 500, "dynamic")
        turns = np.count_nonzero(np.diff(np.sign(current_ma[current_ma != 0])))
        assert turns == pytest.approx(2 * (400 // CYCLE), abs=1)
        assert abs(current_ma).max() > 2 * abs(current_ma[-1]) and np.ptp(current_ma[-20:]) == 0


def test_a_motor_with_inertia_lags_and_comes_to_its_place() -> None:
    behind = behind_columns(500, "dynamic")
    assert 1 <= behind.max() < CYCLE / 2, "it lags, and keeps step"
    assert abs(behind[-1]) <= 1


def test_what_was_lost_stays_behind() -> None:
    behind = behind_columns(700, "dynamic")
    assert abs(behind[-1]) >= CYCLE - 2
    assert round(behind[-1] / CYCLE) * CYCLE == pytest.approx(behind[-1], abs=2)


def test_the_ideal_plant_is_never_behind() -> None:
    assert not behind_columns(700, "ideal").any()
