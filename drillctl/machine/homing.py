"""The homing table of a machine's file: its rows, and what each of them needs of its axes.

Rule: a row whose sensor or index an axis lacks is refused here, so that execution finds what it looks for.
"""

from collections.abc import Iterable, Sequence

from drillctl.language import Message, known_words
from drillctl.machine.model import EncoderIndex, HomingStep, Sensor
from drillctl.machine.shape import HomingRow, MachineFile
from drillctl.machine.source import Source

WITHOUT_SENSOR = ("zero", "index", "offset")  # rows that look at no end sensor


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
