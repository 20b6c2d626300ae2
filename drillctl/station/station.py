"""Wiring of the screens: one machine kept running, and the operator's jobs on it one after the other.

Rule: a Console (panel/console.py): never blocks, never raises for what a person did. The machine runs in a process of
its own, so a screen that hangs disturbs no tick. Created by the screen verb.
"""

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from drillctl.generation.errors import JobError
from drillctl.generation.job import Job, load_job, names_of
from drillctl.generation.placing import Placing, PlacingError
from drillctl.generation.strokes import record
from drillctl.generation.wishes import Wishes
from drillctl.kmd import Condition, KmdError, Op, Request, parse_program
from drillctl.machine import Library, Machine, TableError
from drillctl.panel.console import Asked, BoardView, MachineView, Problems
from drillctl.panel.records import Progress
from drillctl.ports import PortError
from drillctl.station.views import board_view, machine_view
from drillctl.wiring.desk import Desk
from drillctl.wiring.estimate import estimate
from drillctl.wiring.link import Link
from drillctl.wiring.machinery import Running, start

BUSY = "the machine is at work; hold or stop it first"


class Station:
    """One operator, one machine. ``running`` says on which port and at which pace."""

    def __init__(self, library: Library, machine: Machine, running: Running):
        self._library, self._running = library, running
        self._folder = tempfile.TemporaryDirectory(prefix="drillctl-")
        self._machine = machine
        self._link = self._started(machine)
        self._job: Job | None = None
        self._board: BoardView | None = None
        self._desk: Desk | None = None
        self._last: Progress | None = None
        self._base_steps = [0] * len(machine.axes)

    def turn(self) -> None:
        """The running job goes on; without one the link alone lives."""
        if self._desk is None:
            self._link.turn()
            self._link.touches()
        elif self._desk.advance():
            self._last = self.progress()
            self._desk = None

    @property
    def machine(self) -> Machine:
        """The one in use."""
        return self._machine

    @property
    def at_work(self) -> bool:
        """A job, a jog or an initialisation is on its way."""
        return self._desk is not None

    def view(self) -> MachineView:
        """From the status record."""
        running = self._desk.job.program if self._desk else None
        first = int(self._desk.first["done"]) if self._desk else 0
        return machine_view(
            self._machine, self._running.port, self._link, self._link.status(), running, first, self._base_steps
        )

    def board(self) -> BoardView | None:
        """As planned."""
        return self._board

    def progress(self) -> Progress | None:
        """Of the job that runs, or ran last."""
        if self._desk is None:
            return self._last
        told = self._desk.progress()
        done = int(self._desk.status["done"] - self._desk.first["done"])
        return replace(told, holes_done=max(told.holes_done, _visited(self._desk.job, done)))

    def machines(self) -> Sequence[tuple[str, str]]:
        """Those that can be loaded."""
        found = []
        for name in self._library.machine_names():
            try:
                found.append((name, self._library.machine(name).description))
            except TableError as error:
                found.append((name, str(error)))
        return found

    def choose_machine(self, name: str) -> Problems:
        """The old one's outputs are safe before the new one starts."""
        if problems := self._busy():
            return problems
        try:
            machine = self._library.machine(name)
            self._link.close()
            self._machine, self._link = machine, self._started(machine)
        except (TableError, PortError) as error:
            return (str(error),)
        self._job = self._board = self._last = None
        self._base_steps = [0] * len(machine.axes)
        return ()

    def load(self, file: str, asked: Asked) -> Problems:
        """Read, placed, ordered, checked against the reach, and foreseen; or nothing changes. Takes its time."""
        if self._desk is not None:
            return (BUSY,)
        try:
            placing = Placing(asked.origin, asked.mirror, asked.rotate_deg, asked.offset_mm)
            wishes = Wishes(placing, asked.order)
            job = load_job(Path(file), self._machine, wishes, asked.format)
            self._board = board_view(Path(file), job, estimate(job), asked.format)
        except (JobError, PlacingError, OSError) as error:
            return tuple(str(error).splitlines())
        self._job = job
        return ()

    def start(self, dry: bool) -> Problems:
        """The job's own program begins with an initialisation."""
        if self._job is None or self._board is None:
            return ("no board is loaded: open a drill file first",)
        return self._begin(_dry(self._job)) if dry else self._begin(self._job, self._board.estimate.ticks)

    def run_queue(self, text: str) -> Problems:
        """A queue written by hand."""
        try:
            program = parse_program(text, names_of(self._machine), "queue")
        except KmdError as error:
            return (str(error),)
        return self._begin(Job("queue", program, self._machine))

    def initialise(self) -> Problems:
        """Machine zero becomes the working base."""
        problems = self.run_queue("KMD_INICJALIZACJA\n")
        if not problems:
            self._base_steps = [0] * len(self._machine.axes)
        return problems

    def jog(self, axis: str, steps: int) -> Problems:
        """Checked against the range by execution."""
        return self.run_queue(f"KMD_RUCHd {axis}={steps}\n")

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """The drill goes up first."""
        x, y = (round(mm * self._steps_per_mm(axis)) for axis, mm in (("x", x_mm), ("y", y_mm)))
        return self.run_queue(f"KMD_WIERTLO_GORA\nKMD_GOTO_X_Y {x} {y}\n")

    def set_base(self) -> Problems:
        """For X and Y."""
        problems = self.run_queue("KMD_BAZA\n")
        if not problems:
            position = self._link.status()["position"].tolist()
            heads = self._machine.drill_axes
            self._base_steps = [0 if i in heads else position[i] for i in range(len(self._machine.axes))]
        return problems

    def hold(self) -> Problems:
        """A request: it overtakes the queue."""
        return self._post(Request.HOLD, self._desk is not None, "nothing runs that could be held")

    def resume(self) -> Problems:
        """After a hold."""
        held = self._link.status()["condition"] == Condition.HOLDING
        return self._post(Request.RESUME, held, "nothing is held")

    def stop(self) -> Problems:
        """Ends the job."""
        return self._post(Request.STOP, True, "")

    def emergency_stop(self) -> Problems:
        """At once."""
        return self._post(Request.ESTOP, True, "")

    def acknowledge(self) -> Problems:
        """Of a latched fault."""
        latched = self._link.status()["condition"] == Condition.LATCHED
        return self._post(Request.ACK, latched, "there is nothing to acknowledge")

    def close(self) -> None:
        """Everything that was started ends."""
        self._link.close()
        self._folder.cleanup()

    def _started(self, machine: Machine) -> Link:
        return start(machine, self._running, Path(self._folder.name) / "status")

    def _begin(self, job: Job, total_ticks: int | None = None) -> Problems:
        if problems := self._busy():
            return problems
        self._desk = Desk(job, self._link, _nobody, total_ticks=total_ticks, resumes_itself=False)
        self._desk.begin()
        return ()

    def _busy(self) -> Problems:
        status = self._link.status()
        if self._link.lost():
            return ("the ticker's process is gone; choose the machine again",)
        if status["condition"] == Condition.LATCHED:
            return ("a fault waits to be acknowledged",)
        return (BUSY,) if self._desk is not None or status["moving"] else ()

    def _post(self, request: Request, makes_sense: bool, otherwise: str) -> Problems:
        if not makes_sense:
            return (otherwise,)
        self._link.post(request)
        return ()

    def _steps_per_mm(self, name: str) -> float:
        index = self._machine.axis_index(name)
        return 0.0 if index is None else self._machine.axes[index].steps_per_mm


def _dry(job: Job) -> Job:
    """The same journey with the drill up: every stroke down is left out."""
    kept = job.program[~np.isin(job.program["opcode"], (Op.WIERTLO_DOL, Op.RUCH))].copy()
    up = np.concatenate([kept[:1], record(Op.WIERTLO_GORA), kept[1:]])
    up["sequence"] = np.arange(1, len(up) + 1)
    return replace(job, program=up)


def _visited(job: Job, done: int) -> int:
    """Numbered holes that the head has been over, once so many commands are done; in a dry run none is drilled."""
    tags = job.program["tag"][:done]
    return len(np.unique(tags[tags > 0])) if job.work else 0


def _nobody(progress: Progress) -> None:
    """The screen asks for the progress itself."""


