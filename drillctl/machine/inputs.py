"""The input side of a machine's file: end sensors, encoder indexes, inputs that belong to no axis, and the line that
sensors may share.

Rule: a bit has one owner, a sensor or an ``[[input]]``; sensors that are wired together name the input as their line.
"""

from collections.abc import Sequence

from drillctl.language import Counted, Message, known_words
from drillctl.machine.homing import axes_named
from drillctl.machine.levels import Word
from drillctl.machine.model import AxisTable, EncoderIndex, Input, Sensor
from drillctl.machine.outputs import word_of
from drillctl.machine.shape import InputRow, MachineFile, WordBits
from drillctl.machine.source import Source


def sensors_and_inputs(
    source: Source, raw: MachineFile, axes: Sequence[AxisTable]
) -> tuple[tuple[Sensor, ...], tuple[Input, ...], tuple[Word, ...]]:
    """Returns the sensors, the inputs of one bit, and the words of a machine's file. Raises TableError."""
    words = _words(source, raw)
    _check_bits(source, raw)
    sensors = tuple(_sensor(source, raw, index, axes) for index in range(len(raw.sensor)))
    single = ((row, row.bit) for row in raw.input)
    inputs = (Input(row.name, bit, row.active, row.action) for row, bit in single if bit is not None)
    pulses = (Input(row.name, row.bit, row.active, "none") for row in raw.index)
    return sensors, (*inputs, *pulses), words


def _words(source: Source, raw: MachineFile) -> tuple[Word, ...]:
    words = []
    for index, row in enumerate(raw.input):
        if (row.bit is None) == (row.word is None):
            reason = Message("input {name}: it has either a bit, or a word of several", name=row.name)
            raise source.error(reason, "input", index)
        if row.word is not None:
            words.append(word_of(source, row.name, row.word, ("input", index, "word")))
            if row.action != "none" or row.active != 1:
                reason = Message("input {name}: a word has no active level and asks for nothing", name=row.name)
                raise source.error(reason, "input", index)
    return tuple(words)


def encoder_indexes(source: Source, raw: MachineFile, names: list[str]) -> tuple[EncoderIndex, ...]:
    """Returns the encoder indexes of a machine's file; each is an input too. Raises TableError."""
    found: list[EncoderIndex] = []
    for number, row in enumerate(raw.index):
        (axis,) = axes_named(source, [row.axis], names, "index", number, "axis")
        if axis in [index.axis for index in found]:
            reason = Message("index {name}: {axis} has an index already", name=row.name, axis=row.axis)
            raise source.error(reason, "index", number, "axis")
        if row.width >= row.turn:
            fields = {"name": row.name, "width": row.width, "turn": row.turn}
            reason = Message("index {name}: width {width} leaves no gap in a turn of {turn} steps", **fields)
            raise source.error(reason, "index", number, "width")
        found.append(EncoderIndex(row.name, row.bit, row.active, axis, row.turn, row.width, row.at))
    return tuple(found)


def _check_bits(source: Source, raw: MachineFile) -> None:
    taken: dict[int, str] = {}
    sensors = [("sensor", index, row.name, _bits(row.bit)) for index, row in enumerate(raw.sensor)]
    inputs = [("input", index, row.name, _bits(row.bit, row.word)) for index, row in enumerate(raw.input)]
    indexes = [("index", index, row.name, _bits(row.bit)) for index, row in enumerate(raw.index)]
    for kind, index, name, bits in (*sensors, *inputs, *indexes):
        for bit in bits:
            if bit in taken:
                fields = {"kind": kind, "name": name, "bit": bit, "other": taken[bit]}
                reason = Message("{kind} {name}: input bit {bit} is {other}'s already", **fields)
                raise source.error(reason, kind, index, "bit")
            taken[bit] = name


def _bits(bit: int | None, word: WordBits | None = None) -> range:
    """Returns the bits of a row: one, those of a word, or none."""
    if word is not None:
        return range(word[0], sum(word))
    return range(0) if bit is None else range(bit, bit + 1)


def _sensor(source: Source, raw: MachineFile, index: int, axes: Sequence[AxisTable]) -> Sensor:
    row = raw.sensor[index]
    names = [table.name for table in axes]
    if row.axis not in names:
        reason = Message("no axis is named {name!r}; {words}", name=row.axis, words=known_words(row.axis, names))
        raise source.error(reason.at("sensor"), "sensor", index, "axis")
    axis = names.index(row.axis)
    line = _line(source, raw, index)
    _check_other_end(source, raw, index)
    _check_room(source, raw, index, axes[axis])
    bit, active = (row.bit, 1 if row.active is None else row.active) if line is None else (line.bit, line.active)
    assert bit is not None
    return Sensor(row.name, bit, active, axis, row.end, row.edge, row.hysteresis, row.line or "")


def _line(source: Source, raw: MachineFile, index: int) -> InputRow | None:
    """Returns the input whose bit a sensor shares; None for a sensor with a bit of its own."""
    row, names = raw.sensor[index], [line.name for line in raw.input]
    if (row.bit is None) == (row.line is None):
        reason = Message("sensor {name}: it has either a bit, or a line that it shares", name=row.name)
        raise source.error(reason, "sensor", index)
    if row.line is None:
        return None
    if row.line not in names:
        words = known_words(row.line, names)
        fields = {"name": row.name, "line": row.line, "words": words}
        reason = Message("sensor {name}: no input is named {line!r}; {words}", **fields)
        raise source.error(reason, "sensor", index, "line")
    line = raw.input[names.index(row.line)]
    if line.bit is None:
        reason = Message("sensor {name}: input {line} is a word, not a line", name=row.name, line=line.name)
        raise source.error(reason, "sensor", index, "line")
    if row.active is not None:
        reason = Message("sensor {name}: its active level is that of input {line}", name=row.name, line=line.name)
        raise source.error(reason, "sensor", index, "active")
    if line.action != "none":
        reason = Message("sensor {name}: input {line} has an action of its own", name=row.name, line=line.name)
        raise source.error(reason, "sensor", index, "line")
    return line


def _check_room(source: Source, raw: MachineFile, index: int, table: AxisTable) -> None:
    row, brake = raw.sensor[index], table.ramp.top
    room = row.edge - brake >= table.low_steps if row.end == "min" else row.edge + brake <= table.high_steps
    if not room:
        reason = Message(
            "sensor {name}: edge {edge} leaves no room to brake ({brake}) inside the range {low}..{high}",
            name=row.name,
            edge=row.edge,
            brake=Counted("{count} step", "{count} steps", brake),
            low=table.low_steps,
            high=table.high_steps,
        )
        raise source.error(reason, "sensor", index, "edge")


def _check_other_end(source: Source, raw: MachineFile, index: int) -> None:
    row = raw.sensor[index]
    for other in raw.sensor[:index]:
        if other.axis != row.axis:
            continue
        if other.end == row.end:
            raise source.error(
                Message("sensor {name}: {axis} has a {end} sensor already", name=row.name, axis=row.axis, end=row.end),
                "sensor",
                index,
                "end",
            )
        low, high = (other, row) if row.end == "max" else (row, other)
        if low.edge >= high.edge:
            reason = Message(
                "sensor {name}: edge {edge} of {low} must lie below edge {other} of {high}",
                name=row.name,
                edge=low.edge,
                low=low.name,
                other=high.edge,
                high=high.name,
            )
            raise source.error(reason, "sensor", index, "edge")
