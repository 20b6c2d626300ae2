"""Stretches of ticks on a plant that is known: up to where a sensor may answer or the bit may meet the board.

Rule: tick is the law. What comes in these ticks says stretch.py, and ``world`` how far each axis may go; in the tick
after them everything is as if each had been ticked. Like a batch, a stretch says and changes nothing until ``leave``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf

import numpy as np

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller
from drillctl.execution.fastforward.stretch import Count, Course, Images, foresee_courses, leave, put_out, still_image
from drillctl.execution.fastforward.world import PlantFacts
from drillctl.kmd import Op

LONGEST = 1 << 20  # ticks
SHORTEST = 8  # ticks: a stretch of fewer is quicker ticked


@dataclass(frozen=True, eq=False)
class Quiet:
    """A stretch in the middle of a command, in which no input changes and the bit meets no board.

    still   the part of the output images that stays
    bits    by axis, what it puts out: images, and the ticks of each; None of an axis that stands
    motion  by axis, tick, column, position and state at each column put out, (4, k)
    """

    ticks: int
    still: int
    bits: Sequence[tuple[Images, Count] | None]
    motion: Sequence[Count | None]

    def shown(self) -> Images:
        """Returns the output image of each tick, (ticks,)."""
        shown = np.full(self.ticks, self.still, np.uint64)
        for bits in self.bits:
            if bits is not None:
                shown |= np.repeat(*bits)
        return shown


def foresee_quiet(m: Controller, world: PlantFacts, most: int) -> Quiet | None:
    """Returns the stretch that comes, of at most ``most`` ticks; None where it has too few, or the plant is not where
    the controller has it.
    """
    moving = [index for index, axis in enumerate(m.axes) if axis.counting]
    if len(moving) > 1 and any(m.axes[index].drive for index in moving):
        return None
    columns = {index: _free_columns(world, index, m.axes[index]) for index in moving}
    if m.command.opcode == Op.GORA_X_Y and len({m.axes[index] in m.drill_axes for index in moving}) > 1:
        return None  # the heads' part of it ends in a tick of its own (strokes.py)
    if not moving or min(columns.values()) <= 0:
        return None
    ticks, courses = foresee_courses(m, world.inputs, min(most, LONGEST))
    for index in moving if ticks else ():
        begins = _course(courses, index).begins()
        ticks = min(ticks, _first_beyond(m.axes[index], begins, min(columns[index], len(begins)), ticks))
    if ticks < SHORTEST or not all(world.stands(index, _travel(m.axes[index])) for index in moving):
        return None
    pairs = list(zip(m.axes, courses, strict=True))
    bits = [None if course is None else put_out(axis, course, ticks) for axis, course in pairs]
    motion = [None if course is None else _motion(axis, course, ticks) for axis, course in pairs]
    return Quiet(ticks, still_image(m, courses), bits, motion)


def leave_quiet(m: Controller, world: PlantFacts, quiet: Quiet) -> None:
    """Makes machine and plant what they are after a stretch."""
    leave(m, quiet.ticks)
    for index, motion in enumerate(quiet.motion):
        if motion is not None:
            world.follow(index, _travel(m.axes[index]))
    world.settle(m.image, ())


def _motion(axis: Axis, course: Course, ticks: int) -> Count:
    """Returns tick, column, position and state at each column that comes in so many ticks, (4, k)."""
    begins, turn = course.begins(), axis.direction * axis.direction_sign
    made = np.arange(1, len(begins) + 1)
    steps = (axis.column_in_step + made) // axis.columns_per_step
    states = np.repeat(course.states, course.columns)
    rows = (begins, (axis.column + turn * made) % axis.length, axis.position + axis.direction * steps, states)
    return np.stack(rows)[:, begins < ticks]


def _free_columns(world: PlantFacts, index: int, axis: Axis) -> float:
    """Returns how many columns an axis may put out until a sensor of its may change, or the bit meets the board."""
    (low, high), travel = world.free(index), _travel(axis)
    room = high - travel if axis.direction * axis.direction_sign > 0 else travel - low
    return room if room == inf else ceil(room) - 1


def _first_beyond(axis: Axis, begins: Count, columns: float, ticks: int) -> int:
    """Returns the tick of the first of the columns ``begins`` (k,) that is not among so many, at most ``ticks``. Of a
    drive's, whole steps count: in the middle of a pulse, how far it has turned depends on the way it goes.
    """
    passed = int(min(columns, int(np.searchsorted(begins, ticks))))
    if axis.drive:
        passed = max(0, passed - (axis.column_in_step + passed) % axis.columns_per_step)
    return int(begins[passed]) if passed < len(begins) else ticks


def _course(courses: Sequence[Course | None], index: int) -> Course:
    course = courses[index]
    assert course is not None  # all that counts has one
    return course


def _travel(axis: Axis) -> int:
    """Columns since power-up, as the wires have it."""
    return axis.travelled * axis.direction_sign
