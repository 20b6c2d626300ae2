"""The machine in use under the operator's hands: one job after another on it, jogs, queues, requests.

Rule: nothing is begun while something else is on its way, and what overtakes the queue is never refused for that. The
base of station, which adds the boards.
"""

import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drillctl.console.jogging import TOO_FAR, Jogging, way_left
from drillctl.console.machine_in_use import MachineInUse
from drillctl.console.operator_state import HoldRequest, ToolChangePrompt, WorkingBase, asks_for_tools
from drillctl.console.scope import Recording
from drillctl.generation.job import Job, names_of
from drillctl.generation.sequences import holes_passed
from drillctl.jobs.journal import Journal
from drillctl.jobs.runner import JobRunner
from drillctl.kmd import Condition, KmdError, Op, Request, parse_program
from drillctl.machine import Machine
from drillctl.ticker.link import Link
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.records import Progress

BUSY = "the machine is at work; hold or stop it first"
BASES = (Op.INICJALIZACJA, Op.BAZA)


class OperatedMachine:
    """One machine, one job at a time. ``tools``: ask or assume at a tool change; None: as the machine's file has it."""

    def __init__(self, used: MachineInUse, tools: str | None):
        self._used, self._tools = used, tools
        self._gate, self._hand = ToolChangePrompt(), HoldRequest()
        self._jogs = Jogging(
            lambda axis, steps: self.run_queue(f"KMD_RUCHd {axis}={steps}\n"),
            lambda: self.link.post(Request.STOP),
            lambda axis, steps: way_left(self.machine, self.link.status(), axis, steps),
        )
        self._desk: JobRunner | None = None
        self._last: Progress | None = None
        self._base = WorkingBase(used.machine)

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
    def used(self) -> MachineInUse:
        """The machine in use, with its port."""
        return self._used

    @property
    def at_work(self) -> bool:
        """A job, a jog or an initialisation is on its way."""
        return self._desk is not None

    def turn(self) -> bool:
        """The running job goes on; without one the link alone lives."""
        if self._desk is None:
            self.link.turn()
            self.link.touches()
        elif self._desk.advance():
            self._over(self._desk)
        if self._used.follow_rate():
            self._paced()
        condition = self.link.status()["condition"]
        if condition == Condition.RETURNING:  # by the homing table, which ends at machine zero
            self._base.move(0, 0)
        if self._hand.wish is False and condition != Condition.HOLDING:
            self._hand.wish = None
        self.recording.keep()
        self._jogs.carry_on(self.at_work, time.monotonic())
        return self.at_work and self._used.runs_free

    def progress(self) -> Progress | None:
        """Of the job that runs, or ran last."""
        return self._last if self._desk is None else _progress(self._desk)

    def run_queue(self, text: str) -> Problems:
        """A queue written by hand."""
        try:
            program = parse_program(text, names_of(self.machine), "queue")
        except KmdError as error:
            return (str(error),)
        return self._begin(Job("queue", program, self.machine))

    def initialise(self) -> Problems:
        """Machine zero becomes the working base."""
        return self.run_queue("KMD_INICJALIZACJA\n")

    def set_tick_hz(self, hz: int) -> Problems:
        """A request, served in a tick of its own."""
        return self.busy() or self._used.set_tick_hz(hz)

    def jog(self, axis: str, steps: int) -> Problems:
        """Not while anything else runs, nor while a jog is held; nor farther than the axis is long, known or not."""
        index = self.machine.axis_index(axis)
        if index is not None and abs(steps) > self.machine.axes[index].span_steps:
            return (TOO_FAR,)
        held = self.link.status()["condition"] != Condition.READY
        if self.at_work and (held or not self._jogs.under_way):
            return (BUSY,)
        return self._jogs.press((axis, steps), self.at_work, time.monotonic())

    def go_to(self, x_mm: float, y_mm: float) -> Problems:
        """The drill goes up first."""
        base = self.link.status()["base"].tolist()
        x, y = (self._base.commanded(axis, mm, base) for axis, mm in (("x", x_mm), ("y", y_mm)))
        return self.run_queue(f"KMD_WIERTLO_GORA\nKMD_GOTO_X_Y {x} {y}\n")

    def set_base(self) -> Problems:
        """For X and Y."""
        return self.run_queue("KMD_BAZA\n")

    def tool_changed(self) -> Problems:
        """The queue goes on, unless it is held."""
        return self._gate.confirm()

    def hold(self) -> Problems:
        """A request: it overtakes the queue."""
        self._jogs.forget()
        self._hand.wish = self.at_work or None
        return self._post(Request.HOLD, self.at_work, "nothing runs that could be held")

    def resume(self) -> Problems:
        """After a hold; a paused clock goes on too."""
        held = self._hand.held or self.link.gate.paused or self.link.status()["condition"] == Condition.HOLDING
        self.link.gate.open()
        self._hand.wish = False
        return self._post(Request.RESUME, held, "nothing is held")

    def stop(self) -> Problems:
        """Ends the job. Of a machine at rest there is nothing to stop, and what is asked next must not be."""
        self._jogs.forget()
        status = self.link.status()
        if self.at_work or status["moving"] or status["job"] or status["condition"] != Condition.READY:
            self.link.post(Request.STOP)
        return ()

    def emergency_stop(self) -> Problems:
        """At once."""
        self._jogs.forget()
        return self._post(Request.ESTOP, True, "")

    def acknowledge(self) -> Problems:
        """Of a latched fault."""
        latched = self.link.status()["condition"] == Condition.LATCHED
        return self._post(Request.ACK, latched, "there is nothing to acknowledge")

    def busy(self) -> Problems:
        """Why nothing new can be begun now."""
        status = self.link.status()
        if self.link.lost():
            return ("the ticker's process is gone; acknowledge, and it is started anew",)
        if status["condition"] == Condition.LATCHED:
            return ("a fault waits to be acknowledged",)
        return (BUSY,) if self.at_work or status["moving"] else ()

    def _begin(
        self, job: Job, journal: Journal | None = None, foreseen: NDArray[np.int64] | None = None, done_before: int = 0
    ) -> Problems:
        if problems := self.busy():
            return problems
        asks = asks_for_tools(self.machine, self.link.measured, self._tools)
        self._gate.open_for(job)
        self._hand.wish = None
        self._desk = JobRunner(
            job, self.link, _nobody, journal, done_before, foreseen,
            tool_change=self._gate if asks else None, operator=self._hand, resumes_itself=False,
        )  # fmt: skip
        self._desk.begin()
        self.recording.begin(job.program, int(self._desk.first["done"]))
        return ()

    def _over(self, desk: JobRunner) -> None:
        """A job has ended: nothing of it is left to be done or waited for."""
        self._last, self._desk = replace(_progress(desk), seconds_left=None), None
        self._hand.wish = None
        if _took_a_base(desk):
            self._base.take(desk.status["base"].tolist())
        self._gate.close()
        self.link.gate.open()

    def _paced(self) -> None:
        """The machine has come to another tick rate."""

    def _post(self, request: Request, makes_sense: bool, otherwise: str) -> Problems:
        if not makes_sense:
            return (otherwise,)
        self.link.post(request)
        return ()


def _took_a_base(desk: JobRunner) -> bool:
    """Of what the operator asked for; the program of a board takes the operator's base again."""
    done = int(desk.status["done"] - desk.first["done"])
    return desk.job.work is None and bool(np.isin(desk.job.program["opcode"][:done], BASES).any())


def _progress(desk: JobRunner) -> Progress:
    """A dry run drills nothing: there a hole counts as done once the head has been over it."""
    told = desk.progress()
    if desk.feeder.holes:
        return told
    done = int(desk.status["done"] - desk.first["done"])
    return replace(told, holes_done=holes_passed(desk.job.program, done) if desk.job.work else 0)


def _nobody(progress: Progress) -> None:
    """The screen asks for the progress itself."""
