"""How one hole is drilled: straight down, in pecks, with a spot first; and how the table gets there.

Rule: all holes of a job are drilled alike, so a stroke is a short array of records that program.py repeats.
Depths count from the board's surface, which the machine's file names.
"""

import math

import numpy as np

from drillctl.generation.errors import JobError
from drillctl.generation.sequences import Records, record
from drillctl.kmd import Op
from drillctl.kmd.commands import Flag
from drillctl.language import Message
from drillctl.machine import Machine

MOST_PECKS = 100
CHIP_CLEARANCE_MM = 0.5  # how far above the board the bit is drawn to throw its chips


def drill_stroke(machine: Machine, peck_mm: float | None, heads: tuple[int, ...]) -> Records:
    """These heads down to the lower sensor and up; in pecks, with the bit drawn out of the board between them."""
    axes = mask_of(machine, heads)
    down, up = record(Op.WIERTLO_DOL, axes=axes), record(Op.WIERTLO_GORA, axes=axes)
    pecked = [
        part
        for depth in pecks_of(machine, peck_mm, heads)
        for part in (head_move(machine, depth, heads), head_move(machine, -CHIP_CLEARANCE_MM, heads))
    ]
    return np.concatenate([*pecked, down, up])


def pecks_of(machine: Machine, peck_mm: float | None, heads: tuple[int, ...]) -> tuple[float, ...]:
    """The depths of all pecks but the last, which goes down to where the heads turn back, in mm below the board's
    surface; none without pecks. Raises JobError for more than MOST_PECKS.
    """
    if peck_mm is None:
        return ()
    deepest_mm = min(depth_mm(machine, axis) for axis in heads)
    pecks = math.ceil(deepest_mm / peck_mm) - 1
    if pecks > MOST_PECKS:
        raise JobError(
            Message(
                "peck depth: {depth} mm needs {pecks} pecks for a hole; at most {most}",
                depth=peck_mm,
                pecks=pecks,
                most=MOST_PECKS,
            )
        )
    return tuple(number * peck_mm for number in range(1, pecks + 1))


def spot_stroke(machine: Machine, spot_mm: float, heads: tuple[int, ...]) -> Records:
    """A mark so deep by each of these heads, and up."""
    return np.concatenate(
        [head_move(machine, spot_mm, heads), record(Op.WIERTLO_GORA, axes=mask_of(machine, heads))]
    )


def mask_of(machine: Machine, heads: tuple[int, ...]) -> int:
    """The axis mask of a command for these heads: 0, its own choice, for all that the machine has."""
    return 0 if heads == machine.drill_axes else sum(1 << axis for axis in heads)


def head_move(machine: Machine, depth_mm: float, heads: tuple[int, ...]) -> Records:
    """These heads to a depth below the board's surface (negative: above it)."""
    args = [0] * len(machine.axes)
    for axis in heads:
        table = machine.axes[axis]
        steps = _surface(machine, axis) + round(depth_mm * table.steps_per_mm)
        lowest, deepest = 0, _bottom(machine, axis)
        if steps > deepest:
            raise JobError(
                Message(
                    "spot depth: {depth} mm is deeper than {axis} goes on {machine}",
                    depth=depth_mm,
                    axis=table.name,
                    machine=machine.name,
                )
            )
        args[axis] = max(steps, lowest)
    return record(Op.RUCH, args, sum(1 << axis for axis in heads), Flag.ABSOLUTE)


def depth_mm(machine: Machine, axis: int) -> float:
    """Returns how deep a hole is, from the board's surface to where the head turns back, in mm. Raises JobError where
    the machine's file says nothing of the surface.
    """
    return (_bottom(machine, axis) - _surface(machine, axis)) / machine.axes[axis].steps_per_mm


def _bottom(machine: Machine, axis: int) -> int:
    sensor = machine.sensor_at(axis, "max")
    reach = machine.drill_down_steps or machine.axes[axis].high_steps
    return sensor.edge_steps - 1 if sensor else reach


def _surface(machine: Machine, axis: int) -> int:
    surface = machine.board_surface[axis]
    if surface is None:
        name = machine.axes[axis].name
        raise JobError(
            Message("plant.board_surface says nothing of {axis}; pecks and spots need it", axis=name).at(machine.file)
        )
    return surface
