"""Machine files: axes, wiring, sensors, homing, configuration. Checked whole before a machine is handed out.

Rule: an unknown key is an error, and so is a wire without a bit, a bit used twice, an edge outside its range.
library.py finds the files that a machine names.
"""

from collections.abc import Iterable, Mapping

import msgspec

from drillctl.language import Counted, Message, known_words, nearest
from drillctl.machine.axis_ramp import ramp_and_scale
from drillctl.machine.homing import axes_named, homing_steps
from drillctl.machine.inputs import encoder_indexes, sensors_and_inputs
from drillctl.machine.model import AxisTable, Configuration, Machine, Sensor, Surroundings
from drillctl.machine.outputs import outputs_of
from drillctl.machine.parameter_file import check_parameters, read_parameters, with_backlash
from drillctl.machine.parameters import Parameters
from drillctl.machine.parts import Parts
from drillctl.machine.reactions import only_zero_after, reactions
from drillctl.machine.settings import settings_of, wire_settings_of
from drillctl.machine.shape import Bit, DrillPart, MachineFile, PlantPart, Steps
from drillctl.machine.source import Source
from drillctl.machine.spindle import spindle_of
from drillctl.machine.tool_change import tool_changer

# Names that a trace gives to its own signals and scopes: an axis must not have the same name.
TRACE_NAMES = frozenset({"in", "out", "kmd", "request", "hand", "late", "fault", "pace", "sensors", "plant"})


def parse_machine(source: Source, shipped: bool, parts: Parts) -> Machine:
    """Returns the machine that a file's text describes; ``parts`` finds the tables that it names. Raises TableError."""
    raw = source.records(MachineFile)
    _check_names(source, raw)
    wiring = source.numbers(raw.wiring, Bit, "wiring")
    parameters = read_parameters(source, raw)
    axes = tuple(_axis(source, raw, index, wiring, parts, parameters) for index in range(len(raw.axis)))
    _check_wiring(source, wiring, axes)
    outputs = outputs_of(source, raw, wiring)
    _check_locked(source, raw)
    names = [axis.name for axis in axes]
    sensors, inputs, input_words = sensors_and_inputs(source, raw, axes)
    indexes = encoder_indexes(source, raw, names)
    homing = homing_steps(source, raw, names, sensors, indexes)
    drill = raw.drill or DrillPart(axes=[names[-1]])
    drill_axes = axes_named(source, drill.axes, names, "drill", "axes")
    _check_depth(source, drill, [axes[index] for index in drill_axes])
    _check_clear(source, drill, sensors, [(index, axes[index]) for index in drill_axes])
    machine = Machine(
        name=raw.name,
        description=raw.description,
        tick_hz=raw.tick_hz,
        emergency_stop=raw.emergency_stop,
        configuration=Configuration(*msgspec.structs.astuple(raw.configuration)),
        axes=axes,
        sensors=sensors,
        outputs=outputs.bits,
        homing=homing,
        drill_axes=drill_axes,
        drill_down_steps=drill.down,
        board_surface=_surfaces(source, raw.plant.board_surface, names),
        files=tuple(map(str, parts.files)),
        shipped=shipped,
        surroundings=Surroundings(**_plain(raw.plant)),
        inputs=inputs,
        indexes=indexes,
        reactions=reactions(source, raw, homing),
        only_zero_after=only_zero_after(source, raw),
        return_interval=raw.return_interval,
        parameters=parameters,
        levels=outputs.levels,
        output_words=outputs.words,
        input_words=input_words,
        drill_clear_steps=drill.clear,
        mill_mm_min=drill.mill_mm_min,
        spindle=spindle_of(source, raw, outputs.words, input_words),
        tool_changer=tool_changer(source, raw),
    )
    check_parameters(source, machine)
    return with_backlash(source, raw, machine)


def _plain(plant: PlantPart) -> dict[str, float]:
    """What stands in [plant] beside the surfaces of the board."""
    return {name: value for name, value in msgspec.structs.asdict(plant).items() if name != "board_surface"}


def _check_names(source: Source, raw: MachineFile) -> None:
    sensors = [row.name for row in raw.sensor]
    inputs, indexes = ([row.name for row in rows] for rows in (raw.input, raw.index))
    kinds = (("axis", [row.name for row in raw.axis]), ("sensor", sensors), ("input", inputs), ("index", indexes))
    for key, names in kinds:
        for index, name in enumerate(names):
            if name in names[:index]:
                raise source.error(
                    Message("{kind} {name}: a second one of this name", kind=key, name=name), key, index, "name"
                )
    for index, axis in enumerate(raw.axis):
        if axis.name in TRACE_NAMES:
            raise source.error(
                Message("axis {name}: traces use this name for their own", name=axis.name), "axis", index, "name"
            )
    for index, switch in enumerate(raw.input):
        if switch.name in sensors:
            reason = Message("input {name}: a sensor has this name already", name=switch.name)
            raise source.error(reason, "input", index, "name")
    for number, row in enumerate(raw.index):
        if row.name in (*sensors, *inputs):
            reason = Message("index {name}: a sensor or an input has this name already", name=row.name)
            raise source.error(reason, "index", number, "name")


def _axis(
    source: Source, raw: MachineFile, index: int, wiring: Mapping[str, int], parts: Parts, parameters: Parameters | None
) -> AxisTable:
    row = raw.axis[index]
    phase = parts.phase(row.phase, source, ("axis", index, "phase"))
    ramp, pulses_per_mm = ramp_and_scale(source, raw, index, parts, parameters)
    motor = parts.motor(row.motor, phase, source, ("axis", index, "motor"))
    dynamics = parts.dynamics(row.dynamics, motor, phase, source, ("axis", index, "dynamics"))
    low, high = row.range
    if low > 0 or high <= 0:
        reason = Message(
            "axis {name}: range {low}..{high} must reach from 0 or below to above 0", name=row.name, low=low, high=high
        )
        raise source.error(reason, "axis", index, "range")
    if not low <= row.start <= high:
        reason = Message(
            "axis {name}: start {start} is outside its range {low}..{high}",
            name=row.name,
            start=row.start,
            low=low,
            high=high,
        )
        raise source.error(reason, "axis", index, "start")
    if row.columns_per_step > phase.columns:
        reason = Counted(
            "axis {name}: {count} column a step, its table has {length}",
            "axis {name}: {count} columns a step, its table has {length}",
            row.columns_per_step,
            name=row.name,
            length=phase.columns,
        )
        raise source.error(reason, "axis", index, "columns_per_step")
    bits = tuple(_wire_bit(source, wiring, f"{row.name}.{wire}") for wire in phase.wire_names())
    return AxisTable(
        row.name, phase, ramp, motor, row.columns_per_step, row.columns_per_inch,
        low, high, row.start, row.invert, bits, row.backlash, dynamics, pulses_per_mm,
    )  # fmt: skip


def _wire_bit(source: Source, wiring: Mapping[str, int], name: str) -> int:
    if name not in wiring:
        raise source.error(Message('wiring: no bit for "{name}", a wire of its phase table', name=name), "wiring")
    return wiring[name]


def _check_wiring(source: Source, wiring: Mapping[str, int], axes: Iterable[AxisTable]) -> None:
    wires = {f"{axis.name}.{wire}" for axis in axes for wire in axis.phase.wire_names()}
    for name in wiring:
        if name in wires:
            continue
        if meant := nearest(name, sorted(wires)):
            raise source.error(
                Message('wiring: no axis has a wire "{name}"; did you mean "{meant}"?', name=name, meant=meant),
                "wiring",
                name,
            )
        raise source.error(Message('wiring: no axis has a wire "{name}"', name=name), "wiring", name)


def _check_locked(source: Source, raw: MachineFile) -> None:
    if not raw.locked:
        return
    settings = frozenset(name for setting in (*settings_of(raw), *wire_settings_of(raw)) for name in setting.names)
    for name in raw.locked:
        if name not in settings:
            raise source.error(
                Message(
                    "locked: no setting is named {name!r}; {words}",
                    name=name,
                    words=known_words(name, sorted(settings)),
                ),
                "locked",
            )


def _check_depth(source: Source, drill: DrillPart, heads: Iterable[AxisTable]) -> None:
    for head in heads:
        if drill.down is not None and not 0 < drill.down <= head.high_steps:
            raise source.error(
                Message(
                    "drill: down {down} is outside 1..{high} of {name}",
                    down=drill.down,
                    high=head.high_steps,
                    name=head.name,
                ),
                "drill",
                "down",
            )


def _check_clear(
    source: Source, drill: DrillPart, sensors: Iterable[Sensor], heads: Iterable[tuple[int, AxisTable]]
) -> None:
    """A head that is up must be clear, and one that is down must not be."""
    tops = {sensor.axis: sensor.edge_steps + sensor.hysteresis_steps for sensor in sensors if sensor.end == "min"}
    for index, head in heads:
        up, down = max(0, tops.get(index, 0)), drill.down or head.high_steps
        if drill.clear is not None and not up <= drill.clear < down:
            raise source.error(
                Message(
                    "drill: clear {clear} is outside {up}..{last} of {name}: between where it is up and where it "
                    "drills",
                    clear=drill.clear, up=up, last=down - 1, name=head.name,
                ),
                "drill", "clear",
            )  # fmt: skip


def _surfaces(source: Source, surfaces: Mapping[str, object], names: list[str]) -> tuple[int | None, ...]:
    axes_named(source, surfaces, names, "plant", "board_surface")
    steps = source.numbers(surfaces, Steps, "plant", "board_surface")
    return tuple(steps.get(name) for name in names)
