"""The homing table of a machine's file: its rows, and what each of them needs of its axes.

Rule: a row whose sensor or index an axis lacks is refused here, so that execution finds what it looks for.
"""

from collections.abc import Iterable, Sequence
from math import ceil
from typing import NamedTuple

from drillctl.language import Message, known_words
from drillctl.machine.model import EncoderIndex, HomingStep, Machine, Sensor
from drillctl.machine.parameters import ParameterRow
from drillctl.machine.shape import HomingRow, MachineFile
from drillctl.machine.source import Source

WITHOUT_SENSOR = ("zero", "index", "offset")  # rows that look at no end sensor
# What an axis's parameter decides of a row in place of the row itself: its most steps, and its speed.
LIMITS = {"index": "homing_detection_mm", "offset": "homing_offset_mm"}
SPEEDS = {"fast": "homing_speed_mm_min"}


class Way(NamedTuple):
    """How one axis goes in one row: ``limit_steps`` at most, with ``interval`` ticks at least before each column."""

    limit_steps: int
    interval: int


def ways(machine: Machine, tick_hz: int) -> tuple[tuple[Way, ...], ...]:
    """Returns by row of the homing table, and by axis of that row, how it goes: as the row says, and where the axis has
    a parameter for it, by that.
    """
    return tuple(tuple(_way(machine, step, axis, tick_hz) for axis in step.axes) for step in machine.homing)


def _way(machine: Machine, step: HomingStep, axis: int, tick_hz: int) -> Way:
    table, own = machine.axes[axis], ParameterRow()
    if machine.parameters is not None:
        own = machine.parameters.of_axis(table.name)
    limit_mm, speed_mm_min = own.number(LIMITS.get(step.do, "")), own.number(SPEEDS.get(step.do, ""))
    limit = step.limit_steps if limit_mm is None else round(limit_mm * table.steps_per_mm)
    if not speed_mm_min:
        return Way(limit, step.interval)
    columns_hz = speed_mm_min / 60 * table.steps_per_mm * table.columns_per_step
    return Way(limit, max(step.interval, ceil(round(tick_hz / columns_hz, 9))))


def homing_steps(
    source: Source, raw: MachineFile, names: list[str], sensors: Sequence[Sensor], indexes: Sequence[EncoderIndex]
) -> tuple[HomingStep, ...]:
    """Returns the homing table of a machine's file. Raises TableError."""
    return tuple(_step(source, row, number, names, sensors, indexes) for number, row in enumerate(raw.homing))


def axes_named(source: Source, wanted: Iterable[str], names: list[str], *place: str | int) -> tuple[int, ...]:
    """Returns the axes of these names as indexes. Raises TableError for a name that no axis has."""
    for name in wanted:
        if name not in names:
            reason = Message("no axis is named {name!r}; {words}", name=name, words=known_words(name, names)).at(
                place[0]
            )
            raise source.error(reason, *place)
    return tuple(names.index(name) for name in wanted)


def _step(
    source: Source, row: HomingRow, number: int, names: list[str], sensors: Sequence[Sensor],
    indexes: Sequence[EncoderIndex],
) -> HomingStep:  # fmt: skip
    axes = axes_named(source, row.axes, names, "homing", number, "axes")
    sensed = {sensor.axis: sensor for sensor in sensors if sensor.end == row.end}
    counted = {index.axis for index in indexes}
    for axis in axes:
        if row.do == "index" and axis not in counted:
            reason = Message("homing: index needs an [[index]], and {axis} has none", axis=names[axis])
            raise source.error(reason, "homing", number, "axes")
        if row.do in WITHOUT_SENSOR:
            continue
        if axis in sensed and sensed[axis].line:
            reason = Message(
                "homing: {what} needs a sensor with a bit of its own, and {sensor} shares input {line}",
                what=row.do,
                sensor=sensed[axis].name,
                line=sensed[axis].line,
            )
            raise source.error(reason, "homing", number, "axes")
        if axis not in sensed:
            reason = Message(
                "homing: {what} needs a {end} sensor, and {axis} has none", what=row.do, end=row.end, axis=names[axis]
            )
            raise source.error(reason, "homing", number, "axes")
    return HomingStep(row.do, axes, row.end, row.limit, row.interval)
