"""How much torque is left at which step rate: the pull-out curve of an axis, from trials.

Rule: a load resists from rest to rest, ramps and all; the curve is the greatest that loses nothing, and of those
tried none below it does. A textbook's curve loads the motor at full speed only, and lies higher at low rates.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.moves import move
from drillctl.lab.trials import Trial, errors_full_steps, lost
from drillctl.machine import AxisTable, Dynamics

Floats = NDArray[np.float64]
COLUMNS = 300  # of a trial's move
LEVELS = 12  # loads tried at once; then as many between the last that was carried and the first that was not
ROUNDS = 3


@dataclass(frozen=True, eq=False, slots=True)
class PullOut:
    """``torque_nm`` (rates,) by step rate; not a number where the move fails without any load."""

    rates_hz: NDArray[np.int64]
    torque_nm: Floats


def greatest_torque_nm(dynamics: Dynamics) -> float:
    """Two half windings on, at rest, both forced: no load above it is carried."""
    amperes = (dynamics.forcing_volts - dynamics.switch_volts) / dynamics.resistance_ohm
    return sqrt(2) * dynamics.torque_nm_per_a * amperes


def pull_out(table: AxisTable, rates_hz: Sequence[int], direction: int) -> PullOut:
    """The worst of the rests that a move can begin in, in one direction (+1, -1). The axis must have dynamics."""
    assert table.dynamics is not None
    carried = np.zeros(len(rates_hz))
    width_nm = greatest_torque_nm(table.dynamics)
    for _ in range(ROUNDS):
        width_nm /= LEVELS
        loads = carried[:, None] + width_nm * np.arange(LEVELS)
        held = np.cumprod(~_losing(table, rates_hz, loads, direction), axis=1).sum(axis=1)
        carried += np.where(held, (held - 1) * width_nm, np.nan)
    return PullOut(np.array(rates_hz), carried)


def _losing(table: AxisTable, rates_hz: Sequence[int], loads_nm: Floats, direction: int) -> NDArray[np.bool_]:
    """(rates, loads): whether a move loses steps, from any rest. A load that is no number is one that fails."""
    starts = range(table.phase.columns // table.motor.rests_per_cycle)
    moves = [move(table, direction * COLUMNS // table.columns_per_step, column) for column in starts]
    dynamics = table.dynamics
    assert dynamics is not None
    rows = zip(rates_hz, np.nan_to_num(loads_nm).tolist(), strict=True)
    trials = [Trial(each, hz, dynamics, load) for hz, loads in rows for load in loads for each in moves]
    errors = errors_full_steps(table, trials).reshape(*loads_nm.shape, len(moves))
    return lost(errors).any(axis=2) | np.isnan(loads_nm)
