"""The holes of a part program, found by following its sentences: where the tool goes into the wall and comes out.

Rule: a hole is drilled at the sentence that ends where the tool is deepest, before it leaves the wall again.
"""

from collections.abc import Iterator
from typing import NamedTuple

from drillctl.generation.boiler_drum.program import moves
from drillctl.generation.boiler_drum.text import Part
from drillctl.machine import Machine

TOOL = "y"


class Hole(NamedTuple):
    """A hole: place along the drum (mm), depth in the wall (mm), number from 1 of the sentence that finishes it."""

    x_mm: float
    depth_mm: float
    sentence: int


def wall_mm(machine: Machine) -> float | None:
    """Returns how far the tool goes until it meets the wall; None where the machine's file does not say."""
    tool = machine.axis_names.index(TOOL)
    surface = machine.board_surface[tool]
    return None if surface is None else surface / machine.axes[tool].steps_per_mm


def holes(part: Part, machine: Machine) -> Iterator[Hole]:
    """Yields the holes in the order of drilling. Raises JobError for a machine that is not for sentences."""
    tool, wall = machine.axis_names.index(TOOL), wall_mm(machine) or 0.0
    places = [0.0] * len(machine.axes)
    deepest: Hole | None = None
    for number, move in enumerate(moves(part, machine), start=1):
        places[move.axis] = move.place / machine.axes[move.axis].steps_per_mm
        depth = places[tool] - wall
        if depth > (deepest.depth_mm if deepest else 0.0):
            deepest = Hole(places[1 - tool], depth, number)
        if deepest and depth <= 0:
            yield deepest
            deepest = None
    if deepest:
        yield deepest
