"""What an axis puts out for one move, tick by tick: the real automaton, without a machine around it.

Rule: nothing is foreseen here, ``execution.axis`` is run. For fleets of plants: trials, sweeps, tuning.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.lab.errors import LabError
from drillctl.language import Message
from drillctl.machine import AxisTable

LONGEST_MOVE_TICKS = 1_000_000
REST_TICKS = 80  # for currents to settle before a move, and for the rotor after it


@dataclass(frozen=True, eq=False, slots=True)
class Move:
    """images (ticks,): port images of the axis; columns (ticks,): columns put out since power-up, forward counted."""

    images: NDArray[np.int64]
    columns: NDArray[np.int64]


def move(table: AxisTable, steps: int, column: int = -1, rest_ticks: int = REST_TICKS) -> Move:
    """At rest on a column (from 0; -1 as at power-up), a move of so many steps, and at rest again.

    Raises LabError for a move of more than LONGEST_MOVE_TICKS.
    """
    axis = Axis(table, (0, 0, 0))
    axis.column = column % axis.length
    axis.bits = axis.hold_bits = axis.hold_patterns[axis.direction_sign][axis.column]
    start = axis.column + 1 - axis.length
    images, columns = [axis.bits] * rest_ticks, [start] * rest_ticks
    axis.set_target(steps, 0)
    while axis.counting:
        if len(images) > LONGEST_MOVE_TICKS:
            raise LabError(
                Message(
                    "a move of {steps} steps takes more than {longest_move_ticks} ticks",
                    steps=steps,
                    longest_move_ticks=LONGEST_MOVE_TICKS,
                )
            )
        axis.interrupt()
        images.append(axis.bits)
        columns.append(start + axis.travelled * axis.direction_sign)
    axis.cool()
    images += [axis.bits] * rest_ticks
    columns += columns[-1:] * rest_ticks
    return Move(np.array(images, np.int64), np.array(columns, np.int64))


def side_by_side(moves: Sequence[Move]) -> NDArray[np.int64]:
    """Images (ticks, n) for a fleet; each move rests until the longest has ended."""
    images = np.empty((max(len(each.images) for each in moves), len(moves)), np.int64)
    for lane, each in enumerate(moves):
        images[: len(each.images), lane] = each.images
        images[len(each.images) :, lane] = each.images[-1]
    return images


def starts(table: AxisTable) -> range:
    """The columns to begin a move on that stand for all: a table of two phases is alike in every quarter cycle."""
    return range(table.phase.columns // table.motor.rests_per_cycle)
