"""Makes a report's data from a recorded run: the run once more, its holes, its axes over time, its commands in order.

Rule: the run is played again as in dynamic_rerun.py: on the dynamic plant that it was made on, else on the ideal one.
A report is for reading, so that curves are drawn from STRETCHES points and waves end after MOST_CHANGES changes.
"""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.dynamic_rerun import check_one_rate, columns_of, holes_of, images_of, plane_of, recorded_run
from drillctl.lab.errors import LabError
from drillctl.language import Message
from drillctl.language.words import N_
from drillctl.machine import AxisTable, Library, Machine
from drillctl.plant import PlantChoice
from drillctl.plant.dynamic.plant import DynamicPlant
from drillctl.replay.derived_signals import with_columns
from drillctl.replay.header import choice_of, machine_of
from drillctl.ticker.sampler import vcd_layout, wire_names
from drillctl.trace import Difference, Trace, VcdVar, first_difference, render
from drillctl.trace.files import read_trace
from drillctl.trace.text import COMMAND
from drillctl.viewmodel.fault_texts import FAULT_WORDS
from drillctl.viewmodel.reports import BoardPlan
from drillctl.viewmodel.run_report import (
    Comparison,
    ReportAxis,
    ReportCommand,
    ReportEvent,
    ReportWave,
    RunReport,
)

STRETCHES = 1200  # points of a curve: more than a page is wide
MOST_TICKS = 5_000_000
MOST_CHANGES = 150_000  # of all waves together: about half a megabyte of page
EVENTS = {"request": N_("request {what}"), "fault": N_("fault {what}"), "late": N_("{what} periods late")}
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def run_report(file: Path, library: Library) -> RunReport:
    """Returns the report of a trace. Raises TraceError for a file that is no trace or can't be run, TableError for its
    machine, LabError for a run that is too long, has a change of the tick rate, or was recorded with other tables.
    """
    return report_of(*recorded_run(file, library), file)


def report_of(recorded: Trace, machine: Machine, file: Path) -> RunReport:
    """Returns the report of a run that was read already, and the machine it was made on; ``file`` is its name. Raises
    LabError and TraceError as ``run_report``.
    """
    if recorded.end > MOST_TICKS:
        reason = Message("{ticks} ticks; a report takes {most} at most", ticks=recorded.end, most=MOST_TICKS)
        raise LabError(reason.at(file))
    check_one_rate(recorded, file)
    again = with_columns(recorded, machine, file)
    columns = columns_of(again, machine)
    choice = choice_of(recorded)
    motion = _played(recorded, machine, choice, columns)
    waves_to = _waves_to(again, machine)
    return RunReport(
        name=file.name,
        machine=machine.name,
        description=machine.description,
        plant=str(choice),
        tick_hz=machine.tick_hz,
        ticks=recorded.end,
        fault=_fault(recorded),
        holes=motion.holes,
        axes=tuple(_axis(machine, index, columns[index], motion) for index in range(len(machine.axes))),
        commands=tuple(_commands(recorded)),
        events=tuple(_events(recorded)),
        waves=tuple(_waves(again, machine, waves_to)),
        waves_to=waves_to,
    )


def compared(file: Path, other: Path, library: Library) -> Comparison:
    """Returns where two recorded runs part, the first taken as the one expected. Raises as ``run_report``."""
    expected, actual = read_trace(file), read_trace(other)
    found = first_difference(expected, actual)
    return comparison(file.name, other.name, found, machine_of(expected, file, library))


def comparison(first: str, second: str, found: Difference | None, machine: Machine) -> Comparison:
    """Returns a comparison of two runs by their names and the first difference, None where there is none."""
    if found is None:
        return Comparison(first, second, None)
    return Comparison(first, second, found.tick, tuple(render(found, wire_names(machine)).splitlines()))


class _Motion:
    """What a plant did on the images of a run: places (ticks, axes) in columns where it is dynamic, and the holes."""

    def __init__(self, places: Floats, holes: BoardPlan, lost: tuple[int, ...]):
        self.places, self.holes, self.lost = places, holes, lost


def _played(recorded: Trace, machine: Machine, choice: PlantChoice, columns: list[Ints]) -> _Motion:
    """Drives a new plant of the run's kind by the run's images."""
    plant = choice.build(machine)
    images = images_of(recorded, machine)
    dynamic = isinstance(plant, DynamicPlant)
    places = np.empty((len(images) if dynamic else 0, len(machine.axes)))
    touched: list[tuple[int, list[float]]] = []
    touches = 0
    for tick, image in _driving(images, dynamic):
        plant.drive(image)
        if dynamic:
            places[tick] = [rotor.columns for rotor in plant.rotors]
        if plant.touches != touches:
            touches = plant.touches
            touched.append((tick, [plant.position_steps(axis) for axis in plane_of(machine)]))
    holes = holes_of(touched, recorded, machine, columns)
    lost = tuple(
        round(plant.lost_steps(index, int(column[-1]) if len(column) else 0)) for index, column in enumerate(columns)
    )
    return _Motion(places, holes, lost)


def _driving(images: Ints, every: bool) -> Iterator[tuple[int, int]]:
    """The ticks at which a plant is driven: every one, or those in which the image changes."""
    ticks = np.arange(len(images)) if every else np.flatnonzero(np.diff(images, prepend=-1))
    return zip(ticks.tolist(), images[ticks].tolist(), strict=True)


def _axis(machine: Machine, index: int, columns: Ints, motion: _Motion) -> ReportAxis:
    table = machine.axes[index]
    per_mm = table.columns_per_step * table.steps_per_mm
    edges = np.linspace(0, len(columns), min(STRETCHES, max(len(columns), 1)) + 1).astype(np.int64)
    rotor = motion.places[:, index] if len(motion.places) else np.empty(0)
    return ReportAxis(
        name=table.name,
        speed_mm_s=_speeds(columns, edges, machine.tick_hz / per_mm),
        rotor_mm_s=_speeds(rotor, edges, machine.tick_hz / per_mm) if len(rotor) else np.empty(0),
        lag_steps=_greatest(_lag(table, columns, rotor), edges) if len(rotor) else np.empty(0),
        lost_steps=motion.lost[index],
        travelled_mm=float(np.abs(np.diff(columns, prepend=0)).sum() / per_mm),
    )


def _lag(table: AxisTable, columns: Ints, rotor: Floats) -> Floats:
    full_steps_per_cycle = 4
    return (columns - rotor) * full_steps_per_cycle / table.motor.columns_per_cycle


def _speeds(places: NDArray[np.float64] | Ints, edges: Ints, scale: float) -> Floats:
    """(n,): the mean speed in each stretch between two edges; ``scale``: of columns a tick."""
    at = np.asarray(places, np.float64)[np.maximum(edges - 1, 0)]
    lengths = np.maximum(np.diff(edges), 1)
    speeds: Floats = np.diff(at) / lengths * scale
    return speeds


def _greatest(values: Floats, edges: Ints) -> Floats:
    """(n,): in each stretch the value that is farthest from 0."""
    return np.array([_farthest(values[first:end]) for first, end in pairwise(edges)])


def _farthest(values: Floats) -> float:
    return float(values[np.abs(values).argmax()]) if len(values) else 0.0


def _fault(recorded: Trace) -> tuple[str, Message, Message] | None:
    name = recorded.shown_at("fault", recorded.end - 1) if recorded.end else ""
    words = {fault.name: told for fault, told in FAULT_WORDS.items()}.get(name)
    return words and (name, Message(words.cause), Message(words.remedy))


def _commands(recorded: Trace) -> Iterator[ReportCommand]:
    """Commands as they were current, with their text from the header."""
    texts = {int(number): text for number, _, text in (line.partition(" ") for line in recorded.header_values(COMMAND))}
    signal = recorded.signals[recorded.index_of("kmd")]
    ticks, values = recorded.changes_of("kmd")
    ends = np.append(ticks[1:], recorded.end)
    for first, end, value in zip(ticks.tolist(), ends.tolist(), values.tolist(), strict=True):
        number, _, name = signal.show(value).partition(":")
        if name:
            yield ReportCommand(int(number), texts.get(int(number), name), first, end)


def _events(recorded: Trace) -> Iterator[ReportEvent]:
    found = [
        ReportEvent(tick, Message(template, what=recorded.signals[recorded.index_of(name)].show(value)))
        for name, template in EVENTS.items()
        for tick, value in zip(*(column.tolist() for column in recorded.changes_of(name)), strict=True)
        if value
    ]
    yield from sorted(found, key=lambda event: event.tick)


def _waves_to(again: Trace, machine: Machine) -> int:
    """The tick up to which all waves together have MOST_CHANGES changes."""
    ticks = np.sort(np.concatenate([_wave(again, var)[0] for var in _shown(again, machine)]))
    return again.end if len(ticks) <= MOST_CHANGES else int(ticks[MOST_CHANGES])


def _waves(again: Trace, machine: Machine, end: int) -> Iterator[ReportWave]:
    for var in _shown(again, machine):
        ticks, values = _wave(again, var)
        rows = ticks < end
        if len(np.unique(values[rows])) > 1 or var.kind != "wire":
            yield ReportWave(f"{var.scope}.{var.name}", var.kind == "wire", ticks[rows], values[rows])


def _shown(again: Trace, machine: Machine) -> list[VcdVar]:
    return [var for var in vcd_layout(machine) if var.scope != "kmd" and again.has(var.source)]


def _wave(again: Trace, var: VcdVar) -> tuple[Ints, Ints]:
    """Ticks and values of the changes of one variable."""
    ticks, values = again.changes_of(var.source)
    if var.bit is None:
        return ticks, values
    values = (values >> var.bit & 1) ^ int(var.invert)
    news = np.diff(values, prepend=-1) != 0
    return ticks[news], values[news]
