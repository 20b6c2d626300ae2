"""The stores of the machine in use, and the part program that was called from them (viewmodel/workpieces.py).

Rule: a part program is planned whole, by the code of ``drillctl run NN``, or the one before stays. What runs is what
was planned, at the tick rate in force.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.console.machine_in_use import MachineInUse
from drillctl.console.running_job import RunningJob
from drillctl.files.outputs import OutputError
from drillctl.generation.boiler_drum import cells
from drillctl.generation.boiler_drum.gears import GEARS_MM_MIN, MM_PER_M
from drillctl.generation.boiler_drum.holes import holes, wall_mm
from drillctl.generation.boiler_drum.part import job_of
from drillctl.generation.boiler_drum.stores import RAM, change_ram, find_part, has_stores, read_eprom, read_ram
from drillctl.generation.boiler_drum.text import Part
from drillctl.generation.boiler_drum.times import command_ticks
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.kmd import Condition, Request
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.records import Estimate
from drillctl.viewmodel.workpieces import HoleView, PartView, SentenceView, WorkpieceView

EPROM_AT = 0x8000  # of the code space; the RAM is at 0000 of the data space
TENTHS_PER_MM = 10
ZERO_UNKNOWN = Message("zero is not known: take a place as zero first (initialise), or run a workpiece")
NOTHING_CALLED = Message("no workpiece is called: two digits, then PROG")


@dataclass(frozen=True, eq=False)
class Called:
    """A part program that was called: ``ticks`` (n,) of each command of the job's program."""

    number: int
    part: Part
    job: Job
    ticks: NDArray[np.int64]
    view: PartView


class StoredWorkpieces:
    """The stores of ``used``. ``running`` runs jobs on it; ``busy`` says why none can be begun now, ``to_zero`` begins
    the return to zero.
    """

    def __init__(
        self, used: MachineInUse, running: RunningJob, busy: Callable[[], Problems], to_zero: Callable[[], Problems]
    ):
        self._used, self._running, self._busy, self._to_zero = used, running, busy, to_zero
        self._zero_wanted = False  # once the program that was held has ended
        self._called: Called | None = None
        self._machine: Machine | None = None
        self._present = False
        self._done = 0

    @property
    def present(self) -> bool:
        """Whether the machine in use has stores."""
        machine = self._used.machine
        if machine is not self._machine:
            self._machine, self._present = machine, has_stores(machine)
        return self._present

    def listed(self) -> tuple[Sequence[WorkpieceView], Problems]:
        """The workpieces of RAM and EPROM, by number."""
        try:
            stores = [read_ram(self._used.machine, None), read_eprom(self._used.machine)]
        except JobError as error:
            return (), error.messages
        found = [
            WorkpieceView(number, store.kind, _address(store.kind, cells.offset_of(store.cells, number) or 0))
            for store in stores for number in store.numbers()
        ]  # fmt: skip
        return sorted(found, key=lambda each: (each.number, each.store)), ()

    def called(self) -> PartView | None:
        """The part program that was called."""
        return self._called.view if self._called else None

    def call(self, number: int) -> Problems:
        """Plans a workpiece of the RAM, else of the EPROM."""
        try:
            part = find_part(number, self._used.machine, None)
            self._called = _planned(number, part, self._used.machine)
        except JobError as error:
            return error.messages
        self._done = 0
        return ()

    def forget(self) -> None:
        """Another workpiece may be called."""
        self._called, self._done = None, 0

    def run(self) -> Problems:
        """Runs the program that was called, planned anew where another tick rate is in force now."""
        called = self._called
        if called is None:
            return (NOTHING_CALLED,)
        if problems := self._busy():
            return problems
        if called.job.machine is not self._used.machine:
            try:
                called = self._called = _planned(called.number, called.part, self._used.machine)
            except JobError as error:
                return error.messages
        self._done = 0
        self._running.begin(called.job, ticks=called.ticks)
        return ()

    def return_to_zero(self) -> Problems:
        """Returns to zero; after a pause the held program is ended first, and the return begins once that is done."""
        status = self._used.link.status()
        if not status["position_known"]:
            return (ZERO_UNKNOWN,)
        if status["condition"] != Condition.HOLDING:
            return self._to_zero()
        self._used.link.post(Request.STOP)
        self._zero_wanted = True
        return ()

    def carry_on(self) -> None:
        """Begins the return that waits for the end of a held program; none begins after a fault."""
        if self._zero_wanted and not self._running.at_work:
            self._zero_wanted = False
            if self._used.link.status()["condition"] == Condition.READY:
                self._to_zero()

    def sentence(self) -> int:
        """The sentence in execution, by the tag of its command."""
        program, done_before = self._running.program
        if program is None or self._called is None or program is not self._called.job.program:
            return 0
        status = self._used.link.status()
        row = int(status["sequence"]) - done_before - 1
        number = int(program["tag"][row]) if 0 <= row < len(program) else 0
        self._done = max(self._done, number - 1)
        return number

    def done(self) -> int:
        """How many sentences are done: those of the run that ended last, or of the one that goes on."""
        self.sentence()
        return self._done

    def ended(self, job: Job, commands: int) -> None:
        """A job is over, so many of its commands done: of the part program that was called, how far it came is kept."""
        if self._called is not None and job is self._called.job:
            tags = job.program["tag"][:commands]
            self._done = int(tags.max(initial=0))

    def cell(self, address: int) -> tuple[int, Problems]:
        """The content of a cell as the 8031 has it at this address."""
        try:
            if 0 <= address < cells.STORE_CELLS:
                return read_ram(self._used.machine, None).cells[address], ()
            if EPROM_AT <= address < EPROM_AT + cells.STORE_CELLS:
                return read_eprom(self._used.machine).cells[address - EPROM_AT], ()
        except JobError as error:
            return 0, error.messages
        return 0, (_no_cell(address),)

    def set_cell(self, address: int, content: int) -> Problems:
        """Writes one cell of the RAM, to the disk before it returns."""
        if EPROM_AT <= address < EPROM_AT + cells.STORE_CELLS:
            return (Message("cell {address} is in the EPROM, which is read only", address=f"{address:04X}"),)
        if not 0 <= address < cells.STORE_CELLS:
            return (_no_cell(address),)
        try:
            change_ram(self._used.machine, None, lambda old, _file: cells.with_cell(old, address, content))
        except (JobError, OutputError) as error:
            return error.messages
        self.forget()
        return ()


def _address(store: str, cell: int) -> int:
    return cell if store == RAM else EPROM_AT + cell


def _no_cell(address: int) -> Message:
    return Message(
        "there is no cell {address}; RAM: 0000 to {ram}, EPROM: {first} to {last}",
        address=f"{address:04X}",
        ram=f"{cells.STORE_CELLS - 1:04X}",
        first=f"{EPROM_AT:04X}",
        last=f"{EPROM_AT + cells.STORE_CELLS - 1:04X}",
    )


def _planned(number: int, part: Part, machine: Machine) -> Called:
    job = job_of(part, machine)
    ticks = command_ticks(job.program, machine)
    estimate = Estimate(machine.name, 0, int(ticks.sum()), machine.tick_hz, tools=(), exact=True, fault=None)
    store = part.source.split()[0]
    view = PartView(
        number=number,
        store=store,
        sentences=tuple(_sentences(part, job, ticks, store)),
        holes=tuple(HoleView(*hole) for hole in holes(part, machine)),
        estimate=estimate,
        warnings=job.warnings,
        surface_mm=wall_mm(machine),
    )
    return Called(number, part, job, ticks, view)


def _sentences(part: Part, job: Job, ticks: NDArray[np.int64], store: str) -> list[SentenceView]:
    """The sentences as they are shown. The ticks of a gear's command count to the sentence that it is for."""
    tags = job.program["tag"].astype(np.int64)
    of = np.maximum.accumulate(tags) + (tags == 0)  # a command without a tag belongs to the sentence that follows
    taken = np.bincount(of, weights=ticks, minlength=len(part.sentences) + 2).astype(np.int64).tolist()
    here = {"x": 0, "y": 0}
    found = []
    for number, (sentence, cell) in enumerate(zip(part.sentences, part.lines, strict=True), start=1):
        here[sentence.axis] += sentence.signed_tenths
        found.append(SentenceView(
            text=str(sentence), words=sentence.words(), cell=_address(store, cell), axis=sentence.axis,
            way_mm=sentence.signed_tenths / TENTHS_PER_MM, m_min=GEARS_MM_MIN[sentence.gear] / MM_PER_M,
            x_mm=here["x"] / TENTHS_PER_MM, y_mm=here["y"] / TENTHS_PER_MM, ticks=taken[number],
        ))  # fmt: skip
    return found
