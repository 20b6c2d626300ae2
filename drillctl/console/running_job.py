"""The job that runs on the machine in use, and how far the last one came: begun, advanced, held, over.

Rule: a jog, an initialisation and a queue typed by hand are jobs as well; one at a time. A stop, an emergency stop and
an acknowledgement need no job and are not here.
"""

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from drillctl.console.machine_in_use import MachineInUse
from drillctl.console.operator_state import ToolChangePrompt, asks_for_tools
from drillctl.generation.job import Job
from drillctl.generation.sequences import holes_passed
from drillctl.jobs.journal import Journal
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.tool_keeping import ToolKeeping
from drillctl.kmd import Condition, Op, Request
from drillctl.language import Message
from drillctl.viewmodel.console import Problems
from drillctl.viewmodel.records import Progress

BASES = (Op.INICJALIZACJA, Op.BAZA)  # commands that set the working base


class RunningJob:
    """At most one JobRunner on the machine in use. ``tools``: ``ask`` or ``assume`` at a tool change; None: as the
    machine's file has it.
    """

    def __init__(self, used: MachineInUse, tools: str | None):
        self._used, self._tools = used, tools
        self._runner: JobRunner | None = None
        self._last: Progress | None = None
        self.prompt = ToolChangePrompt()

    @property
    def at_work(self) -> bool:
        """Whether a job, a jog or an initialisation is on its way."""
        return self._runner is not None

    @property
    def program(self) -> tuple[NDArray[np.void] | None, int]:
        """The program that runs, None for none, and how many commands the ticker had done before it."""
        return (self._runner.job.program, int(self._runner.first["done"])) if self._runner else (None, 0)

    def begin(
        self, job: Job, journal: Journal | None = None, ticks: NDArray[np.int64] | None = None, done_before: int = 0,
        tools: ToolKeeping | None = None,
    ) -> None:  # fmt: skip
        """Begins a job; the caller has made sure that none runs. The rest is as JobRunner has it."""
        self.prompt.open_for(job)
        asks = asks_for_tools(self._used.machine, self._used.link.measured, self._tools)
        self._runner = JobRunner(
            job, self._used.link, _ignore, journal, done_before, ticks,
            tool_change=self.prompt if asks else None, resumes_itself=False, tools=tools,
        )  # fmt: skip
        self._runner.begin()
        self._used.recording.begin(job.program, int(self._runner.first["done"]))

    def advance(self) -> JobRunner | None:
        """Lets the machine run for a moment; returns the runner of a job that ended with that, once."""
        runner = self._runner
        if runner is None:
            self._used.link.turn()
            self._used.link.touches()
            return None
        if not runner.advance():
            return None
        self._last, self._runner = replace(_progress(runner), seconds_left=None), None
        self.prompt.close()
        self._used.link.gate.open()
        return runner

    def progress(self) -> Progress | None:
        """The progress of the job that runs, or ran last; None before the first on this machine."""
        return self._last if self._runner is None else _progress(self._runner)

    def forget(self) -> None:
        """Another machine is in use: nothing ran on it so far."""
        self._last = None

    def hold(self) -> Problems:
        """Asks the machine to hold the job; where that is not possible yet, the runner asks again."""
        if self._runner is None:
            return (Message("nothing runs that could be held"),)
        self._runner.hold.wanted = True
        self._used.link.post(Request.HOLD)
        return ()

    def resume(self) -> Problems:
        """Ends a hold, and starts a clock that was stopped."""
        link = self._used.link
        held = link.gate.paused or link.status()["condition"] == Condition.HOLDING
        link.gate.open()
        if self._runner is not None:
            held |= self._runner.hold.held
            self._runner.hold.wanted = False
        if not held:
            return (Message("nothing is held"),)
        link.post(Request.RESUME)
        return ()

    def condition_forecast(self, condition: str) -> str:
        """The condition that a machine in ``condition`` is about to have, by what the operator asked of the job."""
        return self._runner.hold.forecast(condition) if self._runner else condition


def took_a_base(runner: JobRunner) -> bool:
    """Whether a queue or a key has set the working base. A board's program does too, but to the operator's own."""
    done = int(runner.status["done"] - runner.first["done"])
    return runner.job.work is None and bool(np.isin(runner.job.program["opcode"][:done], BASES).any())


def _progress(runner: JobRunner) -> Progress:
    """A dry run drills nothing: there a hole counts as done once the head has been over it."""
    progress = runner.progress()
    if runner.feeder.holes:
        return progress
    done = int(runner.status["done"] - runner.first["done"])
    return replace(progress, holes_done=holes_passed(runner.job.program, done) if runner.job.work else 0)


def _ignore(progress: Progress) -> None:
    """A watcher that does nothing: the screen asks for the progress itself."""
