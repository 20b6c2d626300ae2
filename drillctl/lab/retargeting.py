"""Whether a ramp lands exactly on every new target, given in the midst of a move: the real automaton, tried.

Rule: machine/ramp.py proves moves from rest; here the axis is under way, in every state that a long move goes through,
both ways, and is sent anywhere around.
"""

from copy import copy
from dataclasses import replace
from itertools import product

from drillctl.execution.axis import Axis
from drillctl.machine import AxisTable
from drillctl.machine.ramp import RampTable

ENOUGH_STEPS = 8  # of its reach that a move back and forth can take


def first_missed(ramp: RampTable, axis: AxisTable) -> tuple[int, int] | None:
    """(steps made, new target) of the first move that doesn't come to rest there, or None."""
    reach = ramp.straight_from()
    # Columns only stretch a step: the automaton is asked after whole ones.
    table = replace(axis, ramp=ramp, columns_per_step=1)
    for direction, made in product((1, -1), range(reach)):
        under_way = _under_way(table, direction * reach, made)
        for target in range(under_way.position - reach, under_way.position + reach + 1):
            if not _lands(copy(under_way), target, ENOUGH_STEPS * reach * max(ramp.interval)):
                return direction * made, target
    return None


def targets_tried(ramp: RampTable) -> int:
    """How many new targets ``first_missed`` tries."""
    reach = ramp.straight_from()
    return 2 * reach * (2 * reach + 1)


def _under_way(table: AxisTable, steps: int, made: int) -> Axis:
    """An axis on its way to ``steps`` that has made so many."""
    axis = Axis(table, (0, 0, 0))
    axis.set_target(steps, 0)
    while axis.made < made:
        axis.interrupt()
    return axis


def _lands(axis: Axis, target: int, most_ticks: int) -> bool:
    axis.set_target(target, 0)
    for _ in range(most_ticks):
        if not axis.counting:
            break
        axis.interrupt()
    return not axis.counting and axis.state == 0 and axis.position == target
