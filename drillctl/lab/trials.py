"""Moves of one axis tried on the dynamic plant, thousands at once: how far each ended from where it was sent.

Rule: a trial begins in the middle of a rest, its currents settled, and is judged at rest. For the figures of
docs/PLANT.md, for sweeps and for tuning.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.errors import LabError
from drillctl.lab.moves import Move, side_by_side
from drillctl.language import Message, message_of
from drillctl.machine import AxisTable, Dynamics
from drillctl.plant.dynamic.fleet import Fleet, Lane
from drillctl.plant.dynamic.rotor import rest_cycles, wires_of
from drillctl.plant.rotor import FULL_TURN

LANES = 1024  # in one fleet: large enough for numpy, small enough for a cache
FULL_STEPS_PER_CYCLE = 4
LOST_FULL_STEPS = 1.0  # friction and the width of a rest leave less than this; what is lost are whole cycles


@dataclass(frozen=True, eq=False, slots=True)
class Trial:
    """A move at a tick rate by a motor with its load; ``load_nm`` resists it in both directions besides."""

    move: Move
    tick_hz: int
    dynamics: Dynamics
    load_nm: float = 0.0


def errors_full_steps(table: AxisTable, trials: Sequence[Trial]) -> NDArray[np.float64]:
    """(n,): commanded minus reached, in full steps, forward counted. All tick rates from 50 Hz on. Raises LabError for
    a motor that makes no moves alone, and a phase table that holds no rotor.
    """
    for trial in trials:
        check_moves(trial.dynamics)
    errors = np.empty(len(trials))
    by_length = sorted(range(len(trials)), key=lambda index: len(trials[index].move.images))
    for first in range(0, len(trials), LANES):
        chosen = by_length[first : first + LANES]
        try:
            errors[chosen] = _fleet_errors(table, [trials[index] for index in chosen])
        except ValueError as error:  # of a column
            raise LabError(message_of(error)) from error
    return errors


def check_moves(dynamics: Dynamics) -> None:
    """Raises LabError for a motor that can't make single moves alone: fleets have unipolar ones only."""
    if dynamics.kind != "unipolar":
        raise LabError(
            Message(
                "sweeps of single moves take unipolar motors; {name} is a {kind} motor's: sweep --board takes it",
                name=dynamics.name,
                kind=dynamics.kind,
            )
        )


def lost(errors: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(n,): whether a trial has lost steps."""
    return np.abs(errors) >= LOST_FULL_STEPS


def _fleet_errors(table: AxisTable, trials: Sequence[Trial]) -> NDArray[np.float64]:
    lanes = [
        Lane(t.dynamics, t.tick_hz, rest_cycles(table, int(t.move.columns[0])), t.load_nm, t.load_nm) for t in trials
    ]
    reached = Fleet(lanes, wires_of(table)).run(side_by_side([t.move for t in trials]))
    columns = np.array([t.move.columns[-1] for t in trials])
    commanded = table.motor.zero_degrees / FULL_TURN + columns / table.motor.columns_per_cycle
    return (commanded - reached) * FULL_STEPS_PER_CYCLE
