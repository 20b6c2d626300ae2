"""Ramps of an axis tried on the dynamic plant: which lose steps, and what was tried with one to be sure.

Rule: *loses nothing* holds for the load as it is and for heavier ones, up to ``margin`` times: inertia, viscous and
Coulomb friction together, which is the same motion as a motor with so much less torque.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from drillctl.lab.errors import LabError
from drillctl.lab.moves import move, starts
from drillctl.lab.question import FASTEST_HZ, SLOWEST_HZ
from drillctl.lab.trials import Trial, errors_full_steps, lost
from drillctl.language import Message
from drillctl.machine import AxisTable, Dynamics
from drillctl.machine.ramp import RampTable
from drillctl.machine.travel import travel_ticks

MOVES = (1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144)  # distances in steps whose times count
SHORT = (1, 3, 6, 10, 15)
LOAD = ("inertia_kgm2", "viscous_nms", "coulomb_nm")
LOADS = 2  # in a search: the load as it is, and the heaviest
PROOF_LOADS = 3
CRUISE_COLUMNS = 48  # at full speed in the longest moves of a search: four cycles
PROOF_STEPS = 40  # every distance up to there, also where the ramp is shorter
PROOF_COLUMNS = 480  # at full speed in the longest moves of a proof


@dataclass(frozen=True, slots=True)
class Proof:
    """What was tried with a ramp: how many moves, the greatest error at rest, the shortest distance that lost steps."""

    trials: int
    worst_full_steps: float
    lost_at_steps: int | None


@dataclass(frozen=True, slots=True)
class Bench:
    """An axis at a tick rate, whose load may be up to ``margin`` times as heavy as it is. Raises LabError."""

    axis: AxisTable
    tick_hz: int
    margin: float

    def __post_init__(self) -> None:
        if self.axis.dynamics is None:
            raise LabError(
                Message("axis {name} has no dynamics; docs/PLANT.md says how to name some", name=self.axis.name)
            )
        if not SLOWEST_HZ <= self.tick_hz <= FASTEST_HZ:
            raise LabError(
                Message(
                    "{tick_hz} Hz is outside {slowest_hz} to {fastest_hz}",
                    tick_hz=self.tick_hz,
                    slowest_hz=SLOWEST_HZ,
                    fastest_hz=FASTEST_HZ,
                )
            )

    def losing(self, ramps: Sequence[RampTable], distances: Sequence[int] = ()) -> list[bool]:
        """Which ramps lose steps, on the moves most likely to and on ``distances``; all in one fleet."""
        begun = starts(self.axis)
        tried = [self._trials(ramp, sorted({*_telling(ramp, self.axis), *distances}), LOADS, begun) for ramp in ramps]
        losing = lost(errors_full_steps(self.axis, [trial for trials in tried for trial in trials]))
        ends = np.cumsum([len(trials) for trials in tried])
        return [bool(part.any()) for part in np.split(losing, ends[:-1])]

    def proof(self, ramp: RampTable) -> Proof:
        """Every distance up to PROOF_STEPS and to where moves only grow by cruising; long ones; every column."""
        distances = _all_telling(ramp, self.axis)
        trials = self._trials(ramp, distances, PROOF_LOADS, range(self.axis.phase.columns))
        errors = np.abs(errors_full_steps(self.axis, trials))
        worst = errors.reshape(-1, len(distances), 2).max(axis=(0, 2))
        failing = np.flatnonzero(lost(worst))
        return Proof(len(trials), float(errors.max()), distances[failing[0]] if len(failing) else None)

    def mean_ticks(self, ramp: RampTable) -> float:
        """The mean time of a move over the distances of MOVES."""
        ticks = [travel_ticks(ramp, steps, 0, self.axis.columns_per_step) for steps in MOVES]
        return sum(ticks) / len(ticks)

    def loads(self, count: int) -> list[float]:
        """``count`` factors of the load, evenly from 1 to the margin."""
        return np.linspace(1, self.margin, count).tolist()

    def _trials(self, ramp: RampTable, distances: Sequence[int], loads: int, begun: Sequence[int]) -> list[Trial]:
        """By load, by the column that a move begins on, by distance, both ways."""
        table = replace(self.axis, ramp=ramp)
        moves = [move(table, way * steps, column) for column, steps, way in product(begun, distances, (1, -1))]
        heavier = [_heavier(self.axis, times) for times in self.loads(loads)]
        return [Trial(each, self.tick_hz, dynamics) for dynamics, each in product(heavier, moves)]


def _heavier(axis: AxisTable, times: float) -> Dynamics:
    own = axis.dynamics
    assert own is not None
    return replace(own, **{name: getattr(own, name) * times for name in LOAD})


def _telling(ramp: RampTable, axis: AxisTable) -> set[int]:
    """Short moves, in which a motor swings, those that just reach the top state, and one at full speed."""
    summit = 2 * ramp.top
    return {*SHORT, summit, summit + 1, summit + _steps(CRUISE_COLUMNS, axis)}


def _all_telling(ramp: RampTable, axis: AxisTable) -> list[int]:
    last = max(ramp.straight_from(), PROOF_STEPS)
    return [*range(1, last + 1), *(last + part * _steps(PROOF_COLUMNS, axis) // 2 for part in (1, 2))]


def _steps(columns: int, axis: AxisTable) -> int:
    return max(4, columns // axis.columns_per_step)
