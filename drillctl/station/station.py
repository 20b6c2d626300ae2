"""Wiring of the screens: one machine kept running, and the operator's jobs on it one after the other.

Rule: a Console (panel/console.py): never blocks, never raises for what a person did. The machine runs in a process of
its own, so a screen that hangs disturbs no tick. Created by the screen verb.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.job import Job, names_of
from drillctl.kmd import Condition, KmdError, Request, parse_program
from drillctl.machine import Library, Machine
from drillctl.panel.console import BoardView, MachineView, Problems
from drillctl.panel.jobs import Alignment, Asked, Measured, RecentJob, UnfinishedJob
from drillctl.panel.records import Progress
from drillctl.station.boards import Boards, align
from drillctl.station.dryrun import dry_run, visited
from drillctl.station.inuse import InUse
from drillctl.station.jogging import Jogging, way_left
from drillctl.station.scope import Recording
from drillctl.station.toolgate import ToolGate, asks_for_tools
from drillctl.station.views import machine_list, machine_view
from drillctl.station.workingbase import WorkingBase
from drillctl.wiring.desk import Desk
from drillctl.wiring.link import Link
from drillctl.wiring.machinery import Running

BUSY = "the machine is at work; hold or stop it first"


class Station:
    """One operator, one machine. ``running``, ``tick_hz``, ``port_won``: as station/inuse.py has them.

    tools  ask or assume, at a tool change; None: as the machine's file has it
    """

    def __init__(
        self, library: Library, machine: Machine, running: Running, tools: str | None = None,
        tick_hz: int | None = None, port_won: bool = False,
    ):  # fmt: skip
        self._library, self._tools = library, tools
        self._gate = ToolGate()
        self._jogs = Jogging(
            lambda axis, steps: self.run_queue(f"KMD_RUCHd {axis}={steps}\n"),
            lambda: self.link.post(Request.STOP),
            lambda axis, steps: way_left(self.machine, self.link.status(), axis, steps),
        )
        self._used = InUse(library, machine, running, tick_hz, port_won)
        self._boards = Boards()
        self._desk: Desk | None = None
        self._last: Progress | None = None
        self._base = WorkingBase(machine)

    def turn(self) -> None:
        """The running job goes on; without one the link alone lives."""
        if self._desk is None:
            self.link.turn()
            self.link.touches()
        elif self._desk.advance():
            self._over(self._desk)
            self._gate.close()
            self.link.gate.open()
        if self.link.status()["condition"] == Condition.RETURNING:  # by the homing table, which ends at machine zero
            self._base.move(0, 0)
        self.recording.keep()
        self._jogs.carry_on(self._desk is not None, time.monotonic())

    @property
    def machine(self) -> Machine:
        """The one in use."""
        return self._used.machine

    @property
    def link(self) -> Link:
        """To the machine in use."""
        return self._used.link

    @property
    def recording(self) -> Recording:
        """Of the runs of the machine in use."""
        return self._used.recording

    @property
    def used(self) -> InUse:
        """The machine in use, with its port."""
        return self._used

    @property
    def at_work(self) -> bool:
        """A job, a jog or an initialisation is on its way."""
        return self._desk is not None

    def view(self) -> MachineView:
        """From the status record."""
        running = self._desk.job.program if self._desk else None
        first = int(self._desk.first["done"]) if self._desk else 0
        view = machine_view(
            self.machine, self._used.running.port, self.link, self.link.status(), running, first, self._base.steps
        )
        notices = (*self._used.notices(), *view.notices, *self._boards.troubles)
        return replace(view, tool_wanted=self._gate.wanted, real_wanted=self._used.real_wanted, notices=notices)

    def board(self) -> BoardView | None:
        """As planned."""
        return self._boards.plan.view if self._boards.plan else None

    def progress(self) -> Progress | None:
        """Of the job that runs, or ran last."""
        if self._desk is None:
            return self._last
        told = self._desk.progress()
        done = int(self._desk.status["done"] - self._desk.first["done"])
        return replace(told, holes_done=max(told.holes_done, visited(self._desk.job, done)))

    def machines(self) -> Sequence[tuple[str, str]]:
        """Those that can be loaded."""
        return machine_list(self._library)

    def choose_machine(self, name: str) -> Problems:
        """The old one's outputs are safe before the new one starts."""
        return self.change(lambda used: used.choose(name))

    def go_real(self) -> Problems:
        """On the port that the machine's file configures."""
        return self.change(InUse.go_real)

    def change(self, how: Callable[[InUse], Problems]) -> Problems:
        """Another machine, or the same on another port: what was loaded is forgotten. Refused while something moves."""
        if problems := self.busy():
            return problems
        before = self._used.link, self._used.machine
        problems = how(self._used)
        if (self._used.link, self._used.machine) != before:
            self._boards.forget()
            self._last = None
            self._base = WorkingBase(self.machine)
        return problems

    def load(self, file: str, asked: Asked) -> Problems:
        """Read, placed, ordered, checked against the reach, and foreseen; or nothing changes. Takes its time."""
        if self._desk is not None:
            return (BUSY,)
        return self._boards.load(Path(file), asked, self.machine, self._base.xy)

    def align(self, measured: tuple[Measured, ...], face_down: bool) -> tuple[Alignment | None, Problems]:
        """By the same fit as ``--align``."""
        return align(measured, face_down)

    def recent(self) -> Sequence[RecentJob]:
        """From the user's state folder."""
        return self._boards.recent()

    def unfinished(self) -> Sequence[UnfinishedJob]:
        """From the user's state folder; not the one that runs."""
        return self._boards.unfinished()

    def go_on(self, journal: str) -> Problems:
        """As ``drillctl resume`` does."""
        if problems := self.busy() or self._boards.take_up(Path(journal), self.machine):
            return problems
        return self._drill()

    def give_up(self, journal: str) -> Problems:
        """Its journal goes."""
        return self._boards.give_up(Path(journal))

    def start(self, dry: bool) -> Problems:
        """The job's own program begins with an initialisation. A board that is drilled has a journal."""
        if self._boards.plan is None:
            return ("no board is loaded: open a drill file first",)
        if problems := self.busy() or self._boards.based(self.machine, self._base.xy):
            return problems
        return self._begin(dry_run(self._boards.plan.left)) if dry else self._drill()

    def run_queue(self, text: str) -> Problems:
        """A queue written by hand."""
        try:
            program = parse_program(text, names_of(self.machine), "queue")
        except KmdError as error:
            return (str(error),)
        return self._begin(Job("queue", program, self.machine))

    def initialise(self) -> Problems:
        """Machine zero becomes the working base."""
        problems = self.run_queue("KMD_INICJALIZACJA\n")
        if not problems:
            self._base.move(0, 0)
        return problems

    def jog(self, axis: str, steps: int) -> Problems:
        """Not while anything else runs, nor while a jog is held."""
        held = self.link.status()["condition"] != Condition.READY
        if self._desk is not None and (held or not self._jogs.under_way):
            return (BUSY,)
        return self._jogs.press((axis, steps), self._desk is not None, time.monotonic())

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """The drill goes up first."""
        x, y = (round(mm * self._steps_per_mm(axis)) for axis, mm in (("x", x_mm), ("y", y_mm)))
        return self.run_queue(f"KMD_WIERTLO_GORA\nKMD_GOTO_X_Y {x} {y}\n")

    def set_base(self) -> Problems:
        """For X and Y."""
        problems = self.run_queue("KMD_BAZA\n")
        if not problems:
            self._base.take(self.link.status()["position"].tolist())
        return problems

    def tool_changed(self) -> Problems:
        """The queue goes on, unless it is held."""
        return self._gate.confirm()

    def hold(self) -> Problems:
        """A request: it overtakes the queue."""
        self._jogs.forget()
        return self._post(Request.HOLD, self._desk is not None, "nothing runs that could be held")

    def resume(self) -> Problems:
        """After a hold; a paused clock goes on too."""
        held = self.link.gate.paused or self.link.status()["condition"] == Condition.HOLDING
        self.link.gate.open()
        return self._post(Request.RESUME, held, "nothing is held")

    def stop(self) -> Problems:
        """Ends the job."""
        self._jogs.forget()
        return self._post(Request.STOP, True, "")

    def emergency_stop(self) -> Problems:
        """At once."""
        self._jogs.forget()
        return self._post(Request.ESTOP, True, "")

    def acknowledge(self) -> Problems:
        """Of a latched fault."""
        latched = self.link.status()["condition"] == Condition.LATCHED
        return self._post(Request.ACK, latched, "there is nothing to acknowledge")

    def close(self) -> None:
        """Everything that was started ends."""
        self._used.close()
        self._boards.close()

    def _drill(self) -> Problems:
        """From the base that the board was planned for, with its journal."""
        if problems := self._boards.begin():
            return problems
        plan = self._boards.plan
        assert plan is not None
        self._base.move(*plan.recipe.base)
        return self._begin(plan.left, plan.foreseen, plan.done_before)

    def _over(self, desk: Desk) -> None:
        """A job has ended, its journal with it; a board is planned anew where its base has moved."""
        self._last, self._desk = self.progress(), None
        self._boards.ended(desk, self.machine)
        self._boards.based(self.machine, self._base.xy)

    def _begin(self, job: Job, foreseen: NDArray[np.int64] | None = None, done_before: int = 0) -> Problems:
        if problems := self.busy():
            return problems
        asks = asks_for_tools(self.machine, self.link.measured, self._tools)
        gate = self._gate if asks else None
        self._gate.open_for(job)
        self._desk = Desk(
            job, self.link, _nobody, self._boards.journal, done_before, foreseen,
            tool_change=gate, resumes_itself=False,
        )  # fmt: skip
        self._desk.begin()
        self.recording.begin(job.program, int(self._desk.first["done"]))
        return ()

    def busy(self) -> Problems:
        """Why nothing new can be begun now."""
        status = self.link.status()
        if self.link.lost():
            return ("the ticker's process is gone; choose the machine again",)
        if status["condition"] == Condition.LATCHED:
            return ("a fault waits to be acknowledged",)
        return (BUSY,) if self._desk is not None or status["moving"] else ()

    def _post(self, request: Request, makes_sense: bool, otherwise: str) -> Problems:
        if not makes_sense:
            return (otherwise,)
        self.link.post(request)
        return ()

    def _steps_per_mm(self, name: str) -> float:
        index = self.machine.axis_index(name)
        return 0.0 if index is None else self.machine.axes[index].steps_per_mm


def _nobody(progress: Progress) -> None:
    """The screen asks for the progress itself."""
