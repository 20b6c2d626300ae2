"""A recorded run once more on the dynamic plant: where an axis was, how fast, its currents, and where holes came.

Rule: the port images are those of the trace. A run that was made on the dynamic plant is had again to the bit, with
its faults and its seed; of any other run this is what motors with inertia would have made of it.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.errors import LabError
from drillctl.lab.tables import axis_index
from drillctl.language import Message
from drillctl.machine import AxisTable, Library, Machine
from drillctl.plant.choice import DYNAMIC
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.plant.dynamic.recorder import Motion, MotionRecorder
from drillctl.plant.faults import PlantRefused
from drillctl.plant.rotor import forward_level
from drillctl.ports import CARD_BITS
from drillctl.replay.derived_signals import with_columns
from drillctl.replay.header import choice_of, machine_of, same_tables
from drillctl.trace import Trace, dense
from drillctl.trace.files import read_trace
from drillctl.trace.text import COMMAND
from drillctl.viewmodel.reports import BoardPlan

MOST_TICKS = 5_000_000  # 120 bytes each, and some minutes of the plant

TOOL_NOTED = re.compile(r"KMD_NARZEDZIE (\d{1,9})\b")

Counts = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class AxisRun:
    """One axis of a run, a value a tick.

    commanded  (ticks,) columns put out since power-up, forward counted
    rotor      what its motor did meanwhile
    holes      where X and Y were sent, and where they were, when the bit met the board
    as_run     the run was made on this very plant
    """

    machine: Machine
    table: AxisTable
    commanded: Counts
    rotor: Motion
    holes: BoardPlan
    as_run: bool

    @property
    def columns_per_mm(self) -> float:
        """Columns of the phase table to a millimetre of travel, negative where the motor is mounted the other way."""
        return self.table.columns_per_step * self.table.steps_per_mm * (-1 if self.table.invert else 1)


def rerun_axis(file: Path, library: Library, axis_name: str | None = None) -> AxisRun:
    """Runs a trace on the dynamic plant; ``axis_name`` None: the axis that went farthest.

    Raises TraceError for a file that is no trace or can't be run, TableError for its machine, LabError for a machine
    without dynamics, an axis that it hasn't, or other tables than the recorded ones.
    """
    return axis_of_run(*recorded_run(file, library), file, axis_name)


def recorded_run(file: Path, library: Library) -> tuple[Trace, Machine]:
    """Returns a trace and the machine that it was recorded on. Raises TraceError, TableError, and LabError for other
    tables than the recorded ones.
    """
    recorded = read_trace(file)
    machine = machine_of(recorded, file, library)
    if not same_tables(recorded, machine, file):
        reason = Message(
            "recorded with other tables of {name}; record it again, or give them (--tables)", name=machine.name
        )
        raise LabError(reason.at(file))
    return recorded, machine


def axis_of_run(recorded: Trace, machine: Machine, file: Path, axis_name: str | None = None) -> AxisRun:
    """Like ``rerun_axis`` for a run that was read already, and the machine it was made on; ``file`` is what messages
    call it.
    """
    if recorded.end > MOST_TICKS:
        raise LabError(
            Message("{end} ticks; a picture takes at most {most_ticks}", end=recorded.end, most_ticks=MOST_TICKS).at(
                file
            )
        )
    check_one_rate(recorded, file)
    again = with_columns(recorded, machine, file)
    columns = columns_of(again, machine)
    index = axis_index(machine, axis_name) if axis_name else _farthest(columns)
    plant, as_run = _plant(recorded, machine)
    rotor, holes = _driven(plant, recorded, machine, index, columns)
    return AxisRun(machine, machine.axes[index], columns[index], rotor, holes, as_run)


def check_one_rate(recorded: Trace, file: Path) -> None:
    """Raises LabError for a run in which the tick rate was changed."""
    if recorded.has("pace"):
        raise LabError(Message("the tick rate was changed on the way (PACE); a picture has one scale of time").at(file))


def columns_of(again: Trace, machine: Machine) -> list[Counts]:
    """Returns for each axis the columns put out since power-up, (ticks,), of a trace with derived signals."""
    images = images_of(again, machine)
    return [_put_out(axis, dense(again, f"{axis.name}.column"), images) for axis in machine.axes]


def _put_out(axis: AxisTable, column: Counts, images: Counts) -> Counts:
    """Columns put out since power-up from the column shown in each tick; at most one is put out a tick. A pulse has
    two columns, from which no way can be told: the direction wire has it.
    """
    length = axis.phase.columns
    turned = np.diff(column, prepend=length)
    if axis.motor.direction is None:
        return np.cumsum((turned + length // 2) % length - length // 2)
    wire = axis.wire_bits[axis.phase.wire_names().index(axis.motor.direction)]
    forward = (images >> wire & 1) == forward_level(axis)
    return np.cumsum(np.where(forward, 1, -1) * (turned != 0))


def _farthest(columns: list[Counts]) -> int:
    return int(np.argmax([float(np.ptp(each)) if len(each) else 0.0 for each in columns]))


def _plant(recorded: Trace, machine: Machine) -> tuple[DynamicPlant, bool]:
    try:
        choice = choice_of(recorded)
        as_run = choice.kind == DYNAMIC
        return DynamicPlant(machine, choice.faults if as_run else (), choice.seed), as_run
    except PlantRefused as error:
        raise LabError(error.message) from error


def _driven(
    plant: DynamicPlant, recorded: Trace, machine: Machine, index: int, columns: list[Counts]
) -> tuple[Motion, BoardPlan]:
    """Drives the plant through all ticks of the run; returns what one motor did, and the holes."""
    recorder, touches, places = MotionRecorder(plant.motors[index]), 0, []
    for tick, image in enumerate(images_of(recorded, machine).tolist()):
        plant.drive(image)
        recorder.sample()
        if plant.touches != touches:
            touches = plant.touches
            places.append((tick, [plant.position_steps(axis) for axis in plane_of(machine)]))
    return recorder.finish(), holes_of(places, recorded, machine, columns)


def images_of(recorded: Trace, machine: Machine) -> Counts:
    """Returns the port image of each tick, all cards in one number, (ticks,)."""
    words = (dense(recorded, f"out.{card}") << CARD_BITS * card for card in range(machine.cards))
    return np.bitwise_or.reduce([*words])


def plane_of(machine: Machine) -> tuple[int, ...]:
    """The two axes that a board lies under."""
    return tuple(axis for axis in range(len(machine.axes)) if axis not in machine.drill_axes)[:2]


def holes_of(
    places: list[tuple[int, list[float]]], recorded: Trace, machine: Machine, columns: list[Counts]
) -> BoardPlan:
    """Returns where holes were sent and drilled, in mm from the start, from the ticks in which the bit met the board,
    with the places of the plane's axes then. A hole that is come to again (peck after peck) counts once. A trace tells
    the numbers of tools, and not their diameters.
    """
    sent: list[list[float]] = []
    drilled: list[list[float]] = []
    ticks: list[int] = []
    for tick, reached in places:
        plane = [(machine.axes[axis], int(columns[axis][tick])) for axis in plane_of(machine)]
        wanted = [table.start_steps + _steps(table, travelled) for table, travelled in plane]
        if not sent or wanted != sent[-1]:
            sent.append(wanted)
            drilled.append(reached)
            ticks.append(tick)
    scale = np.array([machine.axes[axis].steps_per_mm for axis in plane_of(machine)])
    shape = (len(sent), len(scale))  # a machine may have one axis that positions the board, or none: the rest is 0
    missing = ((0, 0), (0, 2 - len(scale)))
    sent_mm, made_mm = (np.pad(np.array(each).reshape(shape) / scale, missing) for each in (sent, drilled))
    return BoardPlan(sent_mm, made_mm, np.full(len(sent), np.nan), _tools_at(recorded, ticks))


def _tools_at(recorded: Trace, ticks: list[int]) -> Counts:
    """(ticks,): the number of the tool that the program had noted last, 0 before the first."""
    texts = [line.partition(" ") for line in recorded.header_values(COMMAND)]
    tools = {int(number): int(found[1]) for number, _, text in texts if (found := TOOL_NOTED.match(text))}
    signal = recorded.signals[recorded.index_of("kmd")]
    begun, values = recorded.changes_of("kmd")
    current = [signal.show(value).partition(":")[0] for value in values.tolist()]
    noted = [(tick, tools[int(number)]) for tick, number in zip(begun.tolist(), current, strict=True)
             if number.isdecimal() and int(number) in tools]  # fmt: skip
    row = np.searchsorted([tick for tick, _ in noted], ticks, side="right")
    return np.array([0, *(tool for _, tool in noted)], np.int64)[row]


def _steps(table: AxisTable, columns: int) -> float:
    return columns * (-1 if table.invert else 1) / table.columns_per_step
