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
from drillctl.execution.fastforward.world import PlantFacts, turned
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
    columns = {index: _free_columns(world, index, m.axes[index]) for index in moving}
    if not moving or min(columns.values()) <= 0:
        return None
    ticks, courses = foresee_courses(m, world.inputs, min(most, LONGEST))
    for index in moving if ticks else ():
        begins = _course(courses, index).begins()
        ticks = min(ticks, _first_beyond(begins, min(columns[index], len(begins)), ticks))
    lifting = [index for index in moving if index in m.machine.drill_axes] if m.command.opcode == Op.GORA_X_Y else []
    if ticks and lifting:  # a stroke of the heads ends in a tick of its own, though X and Y go on (strokes.py)
        ticks = min(ticks, max(_course(courses, index).ticks for index in lifting) - 1)
    if ticks < SHORTEST or not all(world.stands(index, *turned(m.axes[index])) for index in moving):
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
            world.follow(index, *turned(m.axes[index]))
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
    (low, high), (travel, turn) = world.free(index), turned(axis)
    room = high - travel if turn > 0 else travel - low
    return room if room == inf else ceil(room) - 1


def _first_beyond(begins: Count, columns: float, ticks: int) -> int:
    """Returns the tick of the first of the columns ``begins`` (k,) that is not among so many, at most ``ticks``."""
    passed = int(min(columns, int(np.searchsorted(begins, ticks))))
    return int(begins[passed]) if passed < len(begins) else ticks


def _course(courses: Sequence[Course | None], index: int) -> Course:
    course = courses[index]
    assert course is not None  # all that counts has one
    return course
