"""Stretches of ticks in the middle of a command, whose outputs are known unless an input changes.

As long as the inputs stay as they are, nothing but the axes' own tables says what comes: up the ramp, at one pace, down
the ramp, and rest. So a stretch goes on up to the last column of the axis that is the last to rest.

Rule: tick is the law. ``foresee`` returns nothing wherever anything but counting may happen; whoever runs a stretch
finds out how many of its ticks passed before an input changed, and lets ``leave`` make the controller what tick would
have made of it. Both count by the axis's own methods, ``foresee`` on a copy of it.
"""

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis
from drillctl.execution.controller import Controller, Stage
from drillctl.execution.lifted_travel import heads_clear
from drillctl.execution.motion import BRAKING, MOVING, REST, SETTLING, STOPPING
from drillctl.kmd import Op

LONGEST = 1 << 16  # ticks: more take too much memory at once

Images = NDArray[np.uint64]
Count = NDArray[np.int64]
NONE: Images = np.zeros(0, np.uint64)


@dataclass(slots=True)
class Course:
    """What an axis puts out in the next ``ticks``: runs of columns, with so many ticks before each column of a run.

    states  after each column of a run
    rests   it comes to rest in the last of these ticks
    """

    waits: list[int]
    columns: list[int]
    states: list[int]
    ticks: int
    rests: bool

    def begins(self) -> Count:
        """Returns the ticks in which the columns come, (columns,)."""
        return np.cumsum(np.repeat(np.array(self.waits, np.int64), self.columns)) - 1


def foresee(m: Controller, inputs: int, most: int) -> Images:
    """Returns the output image of each tick of a stretch (ticks,) of at most ``most`` ticks, none where nothing is
    known. ``inputs`` is the input image that the next tick latches.
    """
    ticks, courses = foresee_courses(m, inputs, min(most, LONGEST))
    if not ticks:
        return NONE
    shown = np.full(ticks, still_image(m, courses), np.uint64)
    for axis, course in zip(m.axes, courses, strict=True):
        if course is not None:
            shown |= np.repeat(*put_out(axis, course, ticks))
    return shown


def foresee_courses(m: Controller, inputs: int, most: int) -> tuple[int, list[Course | None]]:
    """Returns the ticks of a stretch and the course of each axis that moves; otherwise as ``foresee``."""
    ticks = min(most, _undisturbed(m, inputs))
    if ticks <= 0 or not all(_is_quiet(axis, m.sensors, m.position_known) for axis in m.axes):
        return 0, []
    courses = [_course(axis, ticks) if axis.counting else None for axis in m.axes]
    moving = [course for course in courses if course is not None]
    if len(moving) != m.moving:
        return 0, []
    if m.lifting:
        ticks = min(ticks, _until_clear(m, courses))
    if moving:
        on = [course.ticks for course in moving if not course.rests]
        ticks = min(ticks, min(on) if on else max(course.ticks for course in moving) - 1)  # then the command may end
    return ticks, courses


def still_image(m: Controller, courses: Sequence[Course | None]) -> int:
    """Returns what the axes that stand, and the outputs, show while those with a course move."""
    image = m.switched
    for axis, course in zip(m.axes, courses, strict=True):
        if course is None:
            image |= axis.bits if axis.motion == REST else axis.hold_bits
    return image


def leave(m: Controller, ticks: int) -> None:
    """Makes the controller what it is after so many ticks of a stretch."""
    m.elapsed += ticks
    m.tick += ticks
    m.moving = 0
    for axis in m.axes:
        if axis.motion != REST:
            for _ in _counted(axis, ticks):
                pass
            m.moving += axis.counting
    m.image = m.switched
    for axis in m.axes:
        m.image |= axis.bits


def goes_on(m: Controller, inputs: int) -> bool:
    """Returns whether a stretch that was left goes on as it was foreseen, as end sensors alone have changed and none
    stops an axis; then the controller has seen ``inputs``, as the next tick would have latched them.
    """
    changed, sensors = inputs ^ m.inputs, (inputs ^ m.polarity) & m.sensor_mask
    ends = 0
    for axis in m.axes:
        ends |= axis.limits[1] | axis.limits[-1]
    if not m.moving or changed & ~(ends & ~m.shared) or any(sensors & pair == pair for pair in m.pairs):
        return False
    if not all(_is_quiet(axis, sensors, m.position_known) for axis in m.axes):
        return False
    m.inputs, m.sensors = inputs, sensors
    return True


def counting_ticks(m: Controller, inputs: int, most: int) -> int:
    """Returns for how many of the next ticks, at most ``most``, the axes count and no column is put out; 0 where
    anything else may happen. ``inputs`` as for ``foresee``.
    """
    ticks = min([most, *(axis.wait - axis.count - 1 for axis in m.axes if axis.motion >= MOVING)])
    if ticks <= 0:
        return 0
    settled = all(axis.motion != SETTLING and _is_quiet(axis, m.sensors, m.position_known) for axis in m.axes)
    return max(0, min(ticks, _undisturbed(m, inputs))) if settled else 0


def leave_counted(m: Controller, ticks: int) -> None:
    """Makes the controller what it is after so many ticks of ``counting_ticks``."""
    m.elapsed += ticks
    m.tick += ticks
    for axis in m.axes:
        if axis.counting:
            axis.count += ticks


def _undisturbed(m: Controller, inputs: int) -> int:
    """Returns for how many ticks the current command goes on, and nothing but its axes may change how."""
    if m.stage != Stage.RUNNING or not m.busy or m.requests.waiting or inputs != m.inputs:
        return 0
    if m.fault or m.gap or m.late or m.served or m.unseen or m.hot_until or m.dip_ticks:
        return 0
    if m.lifting and heads_clear(m):
        return 0
    ticks = m.time_limit - m.elapsed if m.time_limit else LONGEST
    if not m.moving:
        ticks = min(ticks, m.command.args[0] - m.elapsed - 1 if m.command.opcode == Op.CZEKAJ else 0)
    return ticks


def _until_clear(m: Controller, courses: Sequence[Course | None]) -> int:
    """Returns the ticks up to that in which the last of the heads that go up is clear: X and Y start in the next."""
    clear = m.machine.drill_clear_steps
    return max((_clear_after(m.axes[index], courses[index], clear) for index in m.machine.drill_axes), default=0)


def _clear_after(axis: Axis, course: Course | None, clear: int | None) -> int:
    """Returns the ticks until a head is clear: where it comes to rest, or has come up to ``clear``."""
    if course is None or (clear is not None and axis.position <= clear):
        return 0
    if clear is not None:
        steps = (axis.column_in_step + np.arange(1, sum(course.columns) + 1)) // axis.columns_per_step
        there = np.flatnonzero(axis.position + axis.direction * steps <= clear)
        return int(course.begins()[there[0]]) + 1 if len(there) else course.ticks
    return course.ticks


def _is_quiet(axis: Axis, sensors: int, position_known: bool) -> bool:
    """Returns whether nothing stops an axis, going to its target, as long as the sensors stay as they are."""
    if axis.motion <= SETTLING or axis.motion == STOPPING:
        return True
    if axis.motion < MOVING or axis.followers is not None:
        return False
    if axis.clear_mask:
        return sensors & axis.clear_mask != 0 and not axis.seek_mask
    in_range = axis.low <= min(axis.position, axis.target) and max(axis.position, axis.target) <= axis.high
    stopping = axis.seek_mask | axis.halt_mask | axis.limits[axis.direction]
    return (in_range or not position_known) and not sensors & stopping


def _course(axis: Axis, most: int) -> Course:
    """Returns the course of an axis that counts, for ``most`` ticks, or up to where it rests or turns round."""
    there, course = copy(axis), Course([], [], [], 0, False)
    shown = axis.drive_patterns[axis.direction * axis.direction_sign]
    for wait, columns in _counted(there, most):
        if there.direction != axis.direction or there.bits != shown[there.column]:
            course.ticks += wait - 1
            return course
        course.waits.append(wait)
        course.columns.append(columns)
        course.states.append(there.state)
        course.ticks += wait * columns
    course.rests = not there.counting
    if there.counting:
        course.ticks = most
    return course


def _counted(axis: Axis, ticks: int) -> Iterator[tuple[int, int]]:
    """Counts an axis through so many ticks; yields each run of columns once put out: ticks before each, columns."""
    while axis.counting and axis.wait - axis.count <= ticks:
        wait, before = axis.wait - axis.count, (axis.state, axis.direction, axis.motion)
        axis.count = 0
        axis.advance()
        ticks -= wait
        yield wait, 1
        if axis.column_in_step == 0 and before == (axis.state, axis.direction, axis.motion):
            steps = min(_even_steps(axis), ticks // (axis.wait * axis.columns_per_step))
            if steps > 0:
                axis.put_steps(steps)
                columns = steps * axis.columns_per_step
                ticks -= columns * axis.wait
                yield axis.wait, columns
    if axis.counting:
        axis.count += ticks
    elif ticks:
        axis.cool()


def _even_steps(axis: Axis) -> int:
    """Returns the steps of an axis that has just kept its state after a step, and keeps it until it must brake."""
    to_go = (axis.target - axis.position) * axis.direction
    return to_go - max(1, axis.ramp.brake[axis.state]) if axis.motion in (MOVING, BRAKING) else 0


def put_out(axis: Axis, course: Course, ticks: int) -> tuple[Images, Count]:
    """Returns what an axis puts out in so many ticks, from its course: images, and the ticks of each, (k,)."""
    turn = axis.direction * axis.direction_sign
    shown = np.array(axis.drive_patterns[turn], np.uint64)
    begins = course.begins()
    columns = (axis.column + turn * np.arange(1, len(begins) + 1)) % axis.length
    images = np.concatenate(([np.uint64(axis.bits)], shown[columns]))
    begins = np.concatenate(([0], begins))
    if course.rests and begins[-1] + 1 < ticks:
        images = np.append(images, np.uint64(axis.hold_patterns[turn][columns[-1]]))
        begins = np.append(begins, begins[-1] + 1)
    lasts = np.diff(np.append(np.minimum(begins, ticks), ticks))
    return images, lasts
