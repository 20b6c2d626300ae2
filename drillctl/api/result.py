"""A run as another program sees it: its outcome, and what happened in each tick as numpy arrays.

Rule: a run is kept as it was recorded; an array is made when it is asked for. (ticks,) is the number of ticks run.
An array that the run keeps for the next who asks can't be written to.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from drillctl.api.arguments import path_of
from drillctl.files.outputs import Output, reserved
from drillctl.generation.job import Job, MadeHole
from drillctl.jobs.outcome import JobResult
from drillctl.lab.dynamic_rerun import AxisRun, axis_of_run
from drillctl.language import Message, Refusal
from drillctl.machine import Machine
from drillctl.plant import PlantChoice
from drillctl.replay.compare import in_form_of
from drillctl.replay.derived_signals import with_columns
from drillctl.replay.header import machine_named
from drillctl.replay.recorded_vcd import write_recorded_vcd
from drillctl.trace import Segments, Trace, dense, first_difference
from drillctl.trace.files import whole_trace, write_record
from drillctl.ui.report.board import run_html
from drillctl.viewmodel.records import FaultReport, Outcome

HOLES = np.dtype(
    [
        ("number", "i8"), ("tool", "i8"), ("diameter_mm", "f8"),
        ("wanted_x_mm", "f8"), ("wanted_y_mm", "f8"), ("made_x_mm", "f8"), ("made_y_mm", "f8"), ("error_mm", "f8"),
        ("spindle", "i8"),
    ]
)  # fmt: skip
RUN = Path("run")  # how messages call a run that is in no file
FULL_STEPS_PER_CYCLE = 4
Integers = NDArray[np.int64]
Floats = NDArray[np.float64]
ArrayT = TypeVar("ArrayT", bound=NDArray[np.generic])
SUFFIXES = (".trace", ".seg", ".vcd")


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """A run that is over. Axes are called by name; ``time_s``, ``holes``, ``currents`` and ``speed`` are read-only.

    job      what was run, made for ``machine``
    plant    which plant it ran on, with its faults and seed
    result   the runner's own record
    """

    job: Job
    plant: PlantChoice
    result: JobResult
    _motions: dict[str, AxisRun] = field(default_factory=dict, init=False, repr=False)

    def __repr__(self) -> str:
        ended = self.fault.name if self.fault else "no fault"
        return f"<Run of {self.job.name} on {self.machine.name}, {self.plant.kind} plant: {self.ticks} ticks, {ended}>"

    @property
    def machine(self) -> Machine:
        """The machine it ran on."""
        return self.job.machine

    @property
    def outcome(self) -> Outcome:
        """How it ended, as ``drillctl run --json`` tells it: ``outcome.as_dict()``."""
        return self.result.outcome

    @property
    def fault(self) -> FaultReport | None:
        """The fault that ended it: ``code``, ``name``, ``cause``, ``remedy``, ``position``; None where there was
        none.
        """
        return self.outcome.fault

    @property
    def lost_steps(self) -> Mapping[str, int]:
        """By axis: the steps by which the plant is behind the controller at the end, whole electrical cycles."""
        return self.outcome.lost_steps or {}

    @property
    def ticks(self) -> int:
        """How many ticks were run."""
        return self.outcome.ticks

    @cached_property
    def time_s(self) -> Floats:
        """(ticks,): the time at which each tick began, in seconds."""
        return _kept(np.arange(self.ticks) / self.outcome.tick_hz)

    @cached_property
    def holes(self) -> NDArray[np.void]:
        """(holes,) in drilling order, a record each (dtype HOLES): where the bit was wanted and where it met the board,
        in the file's coordinates; of a queue, which wants no hole at a place, the wanted ones are NaN. A machine with
        several spindles has a record for each bit; ``spindle`` counts from 1.
        """
        return _kept(np.array([self._hole(hole) for hole in self.result.holes], HOLES))

    def __eq__(self, other: object) -> bool:
        """Whether two runs on machines of the same tables put out the same in every tick."""
        if not isinstance(other, Run):
            return NotImplemented
        same_machine = self.machine.digest == other.machine.digest
        return same_machine and first_difference(self.trace, other.trace) is None

    __hash__ = None  # type: ignore[assignment]  # equality looks through its arrays

    def wires(self, axis: str) -> NDArray[np.bool_]:
        """(ticks, wires): which wires of the axis are on, in the order of ``wire_names``."""
        bits = self.machine.axes[self._index(axis)].wire_bits
        word = self._images()
        return np.stack([(word >> np.uint64(bit) & np.uint64(1)).astype(bool) for bit in bits], axis=1)

    def wire_names(self, axis: str) -> list[str]:
        """The wires of the axis, as its phase table calls them."""
        return [wire.name for wire in self.machine.axes[self._index(axis)].phase.wires]

    def columns(self, axis: str) -> Integers:
        """(ticks,): the column of the phase table that is out, from 1."""
        return self.signal(f"{self._name(axis)}.column")

    def positions(self, axis: str) -> Integers:
        """(ticks,): where the controller believes the axis to be, in steps from machine zero."""
        return self.signal(f"{self._name(axis)}.position")

    def states(self, axis: str) -> Integers:
        """(ticks,): the state of the ramp, its sign the direction; 0 at rest."""
        return self.signal(f"{self._name(axis)}.state")

    def currents(self, axis: str) -> Floats:
        """(ticks, windings): the currents of the motor on the dynamic plant, in A. Raises Refused for an axis without
        dynamics. A run on the ideal plant is driven through the dynamic one once more.
        """
        return _kept(self._motion(axis).rotor.currents)

    def speed(self, axis: str) -> Floats:
        """(ticks,): the speed of the rotor on the dynamic plant, in rad/s. Raises Refused as ``currents``."""
        return _kept(self._motion(axis).rotor.speed)

    def lag(self, axis: str) -> Floats:
        """(ticks,): by how many full steps the rotor is behind the column that is out; 4 are an electrical cycle, which
        is lost. Of a drive that takes pulses 4 are a pulse, and it comes after. Raises Refused as ``currents``.
        """
        motion = self._motion(axis)
        cycle = motion.table.motor.columns_per_cycle
        return (motion.commanded - motion.rotor.columns) * FULL_STEPS_PER_CYCLE / cycle

    def signal(self, name: str) -> Integers:
        """(ticks,): any signal of the record: ``in.0``, ``out.0``, ``kmd``, ``x.column``... Raises Refused for a name
        that is none.
        """
        name = str(name)
        trace = self._derived if "." in name and not name.startswith(("in.", "out.")) else self.trace
        if not trace.has(name):
            known = ", ".join(signal.name for signal in self._derived.signals)
            raise Refusal(Message("no signal {name!r}; there are {known}", name=name, known=known))
        return dense(trace, name)

    @cached_property
    def trace(self) -> Trace:
        """The record as changes, tick by tick. Raises Refused for a run that was made with ``trace=False``."""
        record = self._record
        return whole_trace(record, RUN) if isinstance(record, Segments) else record

    def save(self, file: str | PathLike[str]) -> None:
        """Writes the run for others: ``.trace`` or ``.seg`` for replay, ``.vcd`` for wave viewers. Raises Refused, also
        for another ending; the file is whole or as it was.
        """
        path = path_of(file)
        if path.suffix not in SUFFIXES:
            raise Refusal(Message("a run is written as {suffixes}", suffixes=", ".join(SUFFIXES)).at(path))
        record = self._record
        with reserved([path], []) as (output,):
            assert output is not None
            self._write(record, output)

    def _write(self, record: Trace | Segments, output: Output) -> None:
        if output.path.suffix == ".vcd":
            output.write(lambda stream: write_recorded_vcd(record, self.machine, stream))
            return
        if isinstance(record, Trace):
            record = in_form_of(output.path, record, self.machine)
        named = machine_named(self.machine, output.path)
        write_record(record.with_header([("machine", named), *record.header[1:]]), output)

    def _repr_html_(self) -> str:
        """What Jupyter shows: the outcome in a table, and the board with its holes."""
        return run_html(self.job.name, self.outcome, self.holes)

    @property
    def _record(self) -> Trace | Segments:
        if self.result.trace is None:
            raise Refusal(Message("this run has no record of its ticks: it was made with trace=False"))
        return self.result.trace

    @cached_property
    def _derived(self) -> Trace:
        return with_columns(self.trace, self.machine, RUN)

    def _images(self) -> NDArray[np.uint64]:
        """(ticks,): the port image of each tick, all cards in one number."""
        words = [dense(self.trace, f"out.{card}").astype(np.uint64) for card in range(self.machine.cards)]
        shifted = (word << np.uint64(32 * card) for card, word in enumerate(words))
        return np.bitwise_or.reduce([*shifted])

    def _motion(self, axis: str) -> AxisRun:
        name = self._name(axis)
        if name not in self._motions:
            self._motions[name] = axis_of_run(self.trace, self.machine, RUN, name)
        return self._motions[name]

    def _hole(self, hole: MadeHole) -> tuple[float | None, ...]:
        wanted = self.job.file_place(hole.number) if self.job.work and hole.number else (np.nan, np.nan)
        error_mm = float(np.hypot(hole.x_mm - wanted[0], hole.y_mm - wanted[1]))
        diameter_mm = np.nan if hole.diameter_mm is None else hole.diameter_mm
        return (hole.number, hole.tool, diameter_mm, *wanted, hole.x_mm, hole.y_mm, error_mm, hole.spindle)

    def _index(self, axis: str) -> int:
        return self.machine.axis_names.index(self._name(axis))

    def _name(self, axis: str) -> str:
        if axis not in self.machine.axis_names:
            names = ", ".join(self.machine.axis_names)
            raise Refusal(Message("no axis {axis!r}; there are {names}", axis=axis, names=names))
        return axis


def _kept(array: ArrayT) -> ArrayT:
    array.setflags(write=False)
    return array
