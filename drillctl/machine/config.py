"""Machine files: axes, wiring, sensors, homing, configuration. Checked whole before anything is handed out.

Rule: an unknown key is an error, and so is a wire without a bit, a bit used twice, an edge outside its range.
Called by library.py, which finds the files that a machine names.
"""

from collections.abc import Callable, Iterator
from typing import Annotated, Literal

import msgspec

from drillctl.machine.model import CARD_BITS, AxisTable, Configuration, HomingStep, Machine, Sensor
from drillctl.machine.motor import Motor
from drillctl.machine.phase import Name, PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.machine.source import Source

MOST_CARDS = 4
SLOWEST_TICK_HZ, FASTEST_TICK_HZ = 1, 100_000
Bit = Annotated[int, msgspec.Meta(ge=0, lt=MOST_CARDS * CARD_BITS)]
Steps = Annotated[int, msgspec.Meta(ge=-100_000_000, le=100_000_000)]
Positive = Annotated[int, msgspec.Meta(ge=1, le=1_000_000)]
TickHz = Annotated[int, msgspec.Meta(ge=SLOWEST_TICK_HZ, le=FASTEST_TICK_HZ)]
End = Literal["min", "max"]


class _Strict(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    pass


class _Axis(_Strict, frozen=True):
    name: Name
    phase: str
    ramp: str
    columns_per_step: Positive
    columns_per_inch: Positive
    range: tuple[Steps, Steps]
    start: Steps = 0
    invert: bool = False
    motor: str | None = None


class _Sensor(_Strict, frozen=True):
    name: Name
    bit: Bit
    axis: str
    end: End
    edge: Steps
    hysteresis: Annotated[int, msgspec.Meta(ge=0, le=10_000)] = 0
    active: Literal[0, 1] = 1


class _Homing(_Strict, frozen=True):
    do: Literal["raise", "release", "seek", "creep", "zero"]
    axes: Annotated[list[str], msgspec.Meta(min_length=1)]
    end: End = "min"
    limit: Positive = 60


class _Configuration(_Strict, frozen=True):
    card: str = "simulated"
    card_address: Annotated[int, msgspec.Meta(ge=0, le=0xFFFF)] = 0x2A0
    mode: Literal["SIMULATED", "REAL"] = "SIMULATED"
    longest_drilling_s: Annotated[float, msgspec.Meta(gt=0, le=3600)] = 18
    tool_change: Literal["AUTOMATIC", "MANUAL"] = "MANUAL"


class _Drill(_Strict, frozen=True):
    axes: Annotated[list[str], msgspec.Meta(min_length=1)]
    down: Steps | None = None


class _Plant(_Strict, frozen=True):
    board_surface: dict[str, Steps] = {}


class _File(_Strict, frozen=True):
    name: Name
    tick_hz: TickHz
    axis: Annotated[list[_Axis], msgspec.Meta(min_length=1, max_length=8)]
    wiring: dict[str, Bit]
    description: str = ""
    emergency_stop: Literal["drop", "hold"] = "drop"
    configuration: _Configuration = _Configuration()
    sensor: list[_Sensor] = []
    outputs: dict[str, Bit] = {}
    homing: list[_Homing] = []
    drill: _Drill | None = None
    plant: _Plant = _Plant()


PhaseOf = Callable[[str, Source, tuple[str | int, ...]], PhaseTable]
RampOf = Callable[[str, Source, tuple[str | int, ...]], RampTable]
MotorOf = Callable[[str | None, PhaseTable, Source, tuple[str | int, ...]], Motor]


def parse_machine(source: Source, shipped: bool, phase_of: PhaseOf, ramp_of: RampOf, motor_of: MotorOf) -> Machine:
    """A machine from its file's text; the three callables find the tables that it names. Raises TableError."""
    raw = source.records(_File)
    _check_names(source, raw)
    axes = tuple(
        _axis(source, raw, index, phase_of, ramp_of, motor_of) for index in range(len(raw.axis))
    )
    _check_wiring(source, raw, axes)
    names = [axis.name for axis in axes]
    drill = raw.drill or _Drill(axes=[names[-1]])
    return Machine(
        name=raw.name,
        description=raw.description,
        tick_hz=raw.tick_hz,
        emergency_stop=raw.emergency_stop,
        configuration=Configuration(*msgspec.structs.astuple(raw.configuration)),
        axes=axes,
        sensors=tuple(_sensor(source, raw, index, axes) for index in range(len(raw.sensor))),
        outputs=tuple(raw.outputs.items()),
        homing=tuple(_homing(source, row, index, names) for index, row in enumerate(raw.homing)),
        drill_axes=_indexes(source, drill.axes, names, "drill", "axes"),
        drill_down_steps=drill.down,
        board_surface=_surfaces(source, raw.plant.board_surface, names),
        file=str(source.file),
        shipped=shipped,
    )


def _check_names(source: Source, raw: _File) -> None:
    for key, names in (("axis", [row.name for row in raw.axis]), ("sensor", [row.name for row in raw.sensor])):
        for index, name in enumerate(names):
            if name in names[:index]:
                raise source.error(f"{key} {name}: a second one of this name", key, index, "name")


def _axis(
    source: Source, raw: _File, index: int, phase_of: PhaseOf, ramp_of: RampOf, motor_of: MotorOf
) -> AxisTable:
    row = raw.axis[index]
    phase = phase_of(row.phase, source, ("axis", index, "phase"))
    ramp = ramp_of(row.ramp, source, ("axis", index, "ramp"))
    motor = motor_of(row.motor, phase, source, ("axis", index, "motor"))
    low, high = row.range
    if low > 0 or high <= 0:
        reason = f"axis {row.name}: range {low}..{high} must reach from 0 or below to above 0"
        raise source.error(reason, "axis", index, "range")
    if not low <= row.start <= high:
        reason = f"axis {row.name}: start {row.start} is outside its range {low}..{high}"
        raise source.error(reason, "axis", index, "start")
    if row.columns_per_step > phase.columns:
        reason = f"axis {row.name}: {row.columns_per_step} columns a step, its table has {phase.columns}"
        raise source.error(reason, "axis", index, "columns_per_step")
    bits = tuple(_wire_bit(source, raw, index, name) for name in phase.wire_names())
    return AxisTable(
        row.name, phase, ramp, motor, row.columns_per_step, row.columns_per_inch,
        low, high, row.start, row.invert, bits,
    )  # fmt: skip


def _wire_bit(source: Source, raw: _File, index: int, wire: str) -> int:
    name = f"{raw.axis[index].name}.{wire}"
    if name not in raw.wiring:
        raise source.error(f'wiring: no bit for "{name}", a wire of its phase table', "wiring", 0)
    return raw.wiring[name]


def _check_wiring(source: Source, raw: _File, axes: tuple[AxisTable, ...]) -> None:
    known = {f"{axis.name}.{wire}" for axis in axes for wire in axis.phase.wire_names()}
    for name in raw.wiring:
        if name not in known:
            raise source.error(f'wiring: no axis has a wire "{name}"', "wiring", 0, name)
    _check_distinct(source, [("wiring", name, bit) for name, bit in raw.wiring.items()]
                    + [("outputs", name, bit) for name, bit in raw.outputs.items()])  # fmt: skip
    taken: dict[int, str] = {}
    for index, sensor in enumerate(raw.sensor):
        if sensor.bit in taken:
            reason = f"sensor {sensor.name}: input bit {sensor.bit} is {taken[sensor.bit]}'s already"
            raise source.error(reason, "sensor", index, "bit")
        taken[sensor.bit] = sensor.name


def _check_distinct(source: Source, outputs: list[tuple[str, str, int]]) -> None:
    taken: dict[int, str] = {}
    for table, name, bit in outputs:
        if bit in taken:
            raise source.error(f'{table}: output bit {bit} of "{name}" is {taken[bit]}\'s already', table, 0, name)
        taken[bit] = name


def _sensor(source: Source, raw: _File, index: int, axes: tuple[AxisTable, ...]) -> Sensor:
    row = raw.sensor[index]
    (axis,) = _indexes(source, [row.axis], [a.name for a in axes], "sensor", index, "axis")
    if any(other.axis == row.axis and other.end == row.end for other in raw.sensor[:index]):
        raise source.error(f"sensor {row.name}: {row.axis} has a {row.end} sensor already", "sensor", index, "end")
    table = axes[axis]
    brake = table.ramp.top
    room = row.edge - brake >= table.low_steps if row.end == "min" else row.edge + brake <= table.high_steps
    if not room:
        reason = (
            f"sensor {row.name}: edge {row.edge} leaves no room to brake ({brake} steps) "
            f"inside the range {table.low_steps}..{table.high_steps}"
        )
        raise source.error(reason, "sensor", index, "edge")
    return Sensor(row.name, row.bit, row.active, axis, row.end, row.edge, row.hysteresis)


def _homing(source: Source, row: _Homing, index: int, names: list[str]) -> HomingStep:
    axes = _indexes(source, row.axes, names, "homing", index, "axes")
    return HomingStep(row.do, axes, row.end, row.limit)


def _surfaces(source: Source, surfaces: dict[str, int], names: list[str]) -> tuple[int | None, ...]:
    _indexes(source, list(surfaces), names, "plant", "board_surface")
    return tuple(surfaces.get(name) for name in names)


def _indexes(source: Source, wanted: list[str], names: list[str], *place: str | int) -> tuple[int, ...]:
    unknown: Iterator[str] = (name for name in wanted if name not in names)
    for name in unknown:
        reason = f"{place[0]}: no axis is named {name!r}; there are {', '.join(names)}"
        raise source.error(reason, *place)
    return tuple(names.index(name) for name in wanted)


