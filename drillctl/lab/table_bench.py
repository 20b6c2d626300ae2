"""A table that is being edited, tried on the motors of the machine in use (viewmodel/bench.py): what its columns do to
a rotor, and moves of many lengths on the dynamic plant's motor.

Rule: the controller is the real automaton (moves.py), the motor that of the plant; the machine in use knows nothing of
it. A motor without dynamics is tried as an ideal one.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from math import cos, hypot, radians, sin
from pathlib import Path

import msgspec

from drillctl.lab.grades import RATES_HZ
from drillctl.lab.latency import LatencyError, a_moment, measure
from drillctl.lab.moves import move
from drillctl.lab.trials import FULL_STEPS_PER_CYCLE, LOST_FULL_STEPS
from drillctl.language import Message, message_of
from drillctl.machine import AxisTable, Machine, TableError
from drillctl.machine.edit import UNSAVED
from drillctl.machine.phase import PhaseTable, parse_phase
from drillctl.machine.ramp import RampTable
from drillctl.machine.ramp_file import parse_ramp
from drillctl.machine.source import Source
from drillctl.plant.dynamic.rotor import DynamicRotor
from drillctl.plant.rotor import Rotor, WindingRotor, rotor_of
from drillctl.viewmodel.bench import BenchReport, CyclePath, MotorRun, PathColumn
from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.tables import TableKind

MEASURED_S = 2
FASTEST_HZ = max(RATES_HZ)  # above it no usual rate is told
SHORT_STEPS = (1, 3, 6, 10)  # in which a motor swings
CRUISE_COLUMNS = (48, 240)  # at full speed in the longest moves
IDEAL_STEPS = (1, 3)  # an ideal motor is the same at any speed: few moves tell
MOST_TICKS = 60_000  # of all the moves of a motor: a ramp of thousands of states is tried on short moves alone


class TableBench:
    """A Bench (viewmodel/bench.py) of the motors of the machine that ``machine`` returns; None for none."""

    def __init__(self, machine: Callable[[], Machine | None]):
        self._machine = machine

    def path(self, name: str, text: str) -> CyclePath:
        """The rests of a rotor over one cycle; no columns for a table that can't be read or that fits no motor."""
        try:
            phase = parse_phase(_source(text))
        except TableError:
            return CyclePath()
        fitting = [axis for axis in self._axes("phase", name, phase) if not axis.motor.pulse]
        return _cycle(fitting[0], fitting[0].phase.name == name, phase) if fitting else CyclePath()

    def run(self, kind: TableKind, name: str, text: str, watch: Watch) -> tuple[BenchReport | None, Problems]:
        """Runs the motors that have the table, else the first that fits."""
        try:
            table = parse_phase(_source(text)) if kind == "phase" else parse_ramp(_source(text))
        except TableError as error:
            return None, (message_of(error),)
        machine = self._machine()
        axes = self._axes(kind, name, table if isinstance(table, PhaseTable) else None)
        if machine is None or not axes:
            return None, (Message("no motor of the machine in use has the wires of this table"),)
        in_use = getattr(axes[0], kind).name == name
        runs = _runs([_with(axis, kind, table) for axis in axes], machine, watch)
        return BenchReport(machine.tick_hz, in_use, runs), ()

    def carried_hz(self, tick_hz: int, watch: Watch) -> tuple[int | None, Problems]:
        """Measured as ``drillctl latency`` does, on an idle machine, for MEASURED_S."""
        machine = self._machine()
        if machine is None:
            return None, (Message("there is no machine"),)
        advance, begun_s = watch(Message("measuring how late ticks are here")), time.monotonic()

        def meanwhile() -> bool:
            advance(min(int(time.monotonic() - begun_s), MEASURED_S), MEASURED_S)
            return a_moment()

        try:
            return measure(machine.at_rate(min(tick_hz, FASTEST_HZ)), MEASURED_S, meanwhile).carries_hz, ()
        except LatencyError as error:
            return None, (message_of(error),)

    def _axes(self, kind: TableKind, name: str, phase: PhaseTable | None) -> list[AxisTable]:
        """The axes that have the table of this name; where none has it, the first that could have it."""
        machine = self._machine()
        axes = machine.axes if machine else ()
        fitting = [axis for axis in axes if phase is None or set(phase.wire_names()) == set(axis.phase.wire_names())]
        return [axis for axis in fitting if getattr(axis, kind).name == name] or fitting[:1]


def _source(text: str) -> Source:
    return Source(Path(UNSAVED), text)


def _cycle(axis: AxisTable, in_use: bool, phase: PhaseTable) -> CyclePath:
    axis = _with_wires_in_order(axis, phase)
    rotor = WindingRotor(axis)
    patterns = [_pattern(axis, column) for column in range(axis.phase.columns)]
    rotor.pull(patterns[-1])
    begin = rotor.columns
    columns = []
    for column, pattern in enumerate(patterns):
        rotor.pull(pattern)
        columns.append(PathColumn(rotor.columns - begin, _torque(axis, column)))
    own = axis.dynamics
    one_nm = own.torque_nm_per_a * (own.normal_volts - own.switch_volts) / own.resistance_ohm if own else None
    return CyclePath(
        axis.name, in_use, tuple(columns), rotor.columns - begin, axis.motor.columns_per_cycle,
        None if one_nm is None else 1000 * one_nm,
    )  # fmt: skip


def _with_wires_in_order(axis: AxisTable, phase: PhaseTable) -> AxisTable:
    """The axis with another phase table: the bits go with the wires' names, in whatever order the table has them."""
    bits = dict(zip(axis.phase.wire_names(), axis.wire_bits, strict=True))
    return replace(axis, phase=phase, wire_bits=tuple(bits[name] for name in phase.wire_names()))


def _pattern(axis: AxisTable, column: int) -> int:
    """The bits of the wires that are on in a column, without forcing."""
    wires = zip(axis.phase.wires, axis.wire_bits, strict=True)
    return sum(1 << bit for wire, bit in wires if wire.forward[column] and not wire.forcing)


def _torque(axis: AxisTable, column: int) -> float:
    """The torque of the windings that are on in a column, in that of a single one."""
    on = {wire.name for wire in axis.phase.wires if wire.forward[column]}
    pulls = [radians(degrees) for name, degrees in axis.motor.windings if name in on]
    return round(hypot(sum(map(cos, pulls)), sum(map(sin, pulls))), 6)


def _with(axis: AxisTable, kind: TableKind, table: PhaseTable | RampTable) -> AxisTable:
    return _with_wires_in_order(axis, table) if isinstance(table, PhaseTable) else replace(axis, ramp=table)


def _runs(axes: list[AxisTable], machine: Machine, watch: Watch) -> tuple[MotorRun, ...]:
    """A run for each axis; of motors that are alike one is computed."""
    kinds = [(axis.motor, axis.dynamics, axis.phase, axis.ramp, axis.columns_per_step) for axis in axes]
    found = {kind: _run(axis, machine.tick_hz, watch) for kind, axis in dict(zip(kinds, axes, strict=True)).items()}
    return tuple(msgspec.structs.replace(found[kind], motor=axis.name) for kind, axis in zip(kinds, axes, strict=True))


def _run(axis: AxisTable, tick_hz: int, watch: Watch) -> MotorRun:
    """Every length both ways, and of them the move that lost the most, or was behind by most."""
    runs: list[tuple[int, int, tuple[float, ...]]] = []  # steps lost, steps of the move, steps behind by tick
    ticks, lengths = 0, _lengths(axis)
    advance = watch(Message("motor {axis} on the bench", axis=axis.name.upper()))
    for number, steps in enumerate(lengths):
        advance(number, len(lengths))
        for way in (1, -1):
            behind = _behind(axis, tick_hz, way * steps)
            runs.append((_lost(axis, behind[-1]), way * steps, behind))
            ticks += len(behind)
        if ticks > MOST_TICKS:
            break
    lost, steps, behind = max(runs, key=lambda run: (abs(run[0]), max(map(abs, run[2])), abs(run[1])))
    return MotorRun(axis.name, axis.dynamics is not None, len(runs), lost, steps, behind)


def _lengths(axis: AxisTable) -> list[int]:
    """Short moves, those that just reach the top state, and long ones."""
    if axis.dynamics is None:
        return [*IDEAL_STEPS, *(max(4, columns // axis.columns_per_step) for columns in CRUISE_COLUMNS)]
    summit = 2 * axis.ramp.top
    cruises = (summit + max(4, columns // axis.columns_per_step) for columns in CRUISE_COLUMNS)
    return sorted({*SHORT_STEPS, summit, summit + 1, *cruises})


def _behind(axis: AxisTable, tick_hz: int, steps: int) -> tuple[float, ...]:
    """How far the rotor is behind in every tick of a move, in steps."""
    rotor: Rotor = DynamicRotor(axis, tick_hz) if axis.dynamics else rotor_of(axis)
    done = move(axis, steps)
    behind = []
    for image, columns in zip(done.images.tolist(), done.columns.tolist(), strict=True):
        rotor.pull(image)
        behind.append((columns - rotor.columns) / axis.columns_per_step)
    return tuple(behind)


def _lost(axis: AxisTable, behind_steps: float) -> int:
    """The steps that were lost for good: what is less than a full step of the motor, friction and rests explain."""
    full_step = axis.motor.columns_per_cycle / FULL_STEPS_PER_CYCLE / axis.columns_per_step
    return round(behind_steps) if abs(behind_steps) >= LOST_FULL_STEPS * full_step else 0
