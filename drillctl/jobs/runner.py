"""Wiring of layers 1 and 2: takes a job down the queue to its end, journals it, and says how it ended.

Rule: no layer is skipped; the desk knows a job, a link (queue, requests, status) and a journal, the ticker the rest.
On every way out the outputs are safe. Called by the verbs.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import Job, MadeHole
from drillctl.jobs.estimate import TimeLeft
from drillctl.jobs.interrupts import caught
from drillctl.jobs.journal import Journal, JournalError
from drillctl.kmd import Condition, Fault, Request
from drillctl.replay.stimuli import trace_header
from drillctl.ticker.link import Link, is_over
from drillctl.trace import Segments, Trace
from drillctl.viewmodel import Outcome, Progress, fault_report

BY_OPERATOR = "the operator stopped the job"
BY_OTHERS = "the job was stopped before its end"  # by a signal to a process beside this one
Watcher = Callable[[Progress], None]
ToolChange = Callable[[int, float | None], bool]  # tool and diameter; asked again and again until it is True


class Operator(Protocol):
    """Somebody at the machine, asked at every turn."""

    def requests(self) -> Iterable[Request]:
        """Stops and emergency stops since the last call."""

    @property
    def held(self) -> bool:
        """Whether the machine is to be held."""


@dataclass(frozen=True)
class JobResult:
    """A job that is over: how it ended, the holes that the plant saw made, the trace if one was kept."""

    outcome: Outcome
    holes: list[MadeHole]
    trace: Trace | Segments | None
    signal: int | None  # that stopped it
    trouble: str | None = None  # what stopped it, but for faults and signals
    notices: tuple[str, ...] = ()  # of how it was paced


@dataclass
class JobRunner:
    """One job on one link: ``begin``, ``advance`` until it is over, ``end``; or ``run``, which does all three.

    watcher      is shown the progress; ``journal`` is kept where there is one. Both it and the link stay open.
    foreseen     ticks that each command of the program takes, None where nobody knows: foreseeing may take longer than
                 a link bears the desk's silence
    """

    job: Job
    link: Link
    watcher: Watcher
    journal: Journal | None = None
    done_before: int = 0
    foreseen: NDArray[np.int64] | None = None
    holes: list[MadeHole] = field(default_factory=list)
    trouble: str | None = None
    tool_change: ToolChange | None = None  # None: taken as made
    operator: Operator | None = None
    resumes_itself: bool = True  # after a hold for a gap in time; where nobody sits who could say go on

    def __post_init__(self) -> None:
        self.first = self.status = self.link.status()
        self.feeder = Feeder(self.job.program, self.link.queue)
        self.confirmed = 0
        self._time_left = None if self.foreseen is None else TimeLeft(self.foreseen)
        self._told_to_stop = False

    def run(self) -> JobResult:
        """Drills the job to its end. Ctrl-C, SIGTERM and a closed terminal stop it; a second one drops it."""
        with _stopping(self.link) as stopped:
            self.begin()
            while not self.advance():
                pass
        return self.end(stopped[0] if stopped else None)

    def begin(self) -> None:
        """The program is numbered on from what the ticker has done, so that nothing old counts as ours; and sent."""
        self.first = self.link.status()
        program = self.job.program.copy()
        program["sequence"] += self.first["done"]
        program["epoch"] = self.first["epoch"]
        self.feeder = Feeder(program, self.link.queue)
        if self.journal is not None:
            self.feeder.hold_back()
        if self.tool_change is not None:
            self.feeder.gate_tools()
        self.status = self.first
        self._feed()

    def advance(self) -> bool:
        """Feeds the queue, lets the machine go on for a moment, and looks at what came of it. True: it is over."""
        self._feed()
        self.link.turn()
        self.status = status = self.link.status()
        self._confirm()
        self._change_tool()
        self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
        self.watcher(self.progress())
        if self.link.lost() or is_over(status, self.last_sequence, int(self.first["epoch"])):
            return True
        self._hear_operator()
        return False

    @property
    def held(self) -> bool:
        """Whether the operator has it held."""
        return self.operator is not None and self.operator.held

    @property
    def last_sequence(self) -> int:
        """The number of the program's last command, as it was sent."""
        return int(self.first["done"]) + len(self.job.program)

    def end(self, stopped_by: int | None = None) -> JobResult:
        """How it ended, with all that was kept of it."""
        self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
        outcome = self.settle(stopped_by is not None)
        trace = self.link.trace(trace_header(self.job, self.link.plant_header))
        return JobResult(outcome, self.holes, trace, stopped_by, self.trouble, tuple(self.link.notices()))

    def settle(self, interrupted: bool = False) -> Outcome:
        """How it ended, in the journal too."""
        outcome = self._outcome(self.status, interrupted)
        self._end_journal(outcome)
        return outcome

    def progress(self) -> Progress:
        """How far the job is."""
        hz, ticks = self.job.machine.tick_hz, int(self.status["tick"] - self.first["tick"])
        commands = int(self.status["done"] - self.first["done"])
        left = None if self._time_left is None else self._time_left.ticks(commands, ticks) / hz
        done = self.done_before + self.confirmed
        total = self.done_before + self.job.holes_total
        return Progress(done, total, int(self.status["tool"]), ticks, ticks / hz, left, self.held)

    def _feed(self) -> None:
        """With a journal: a hole is written down before its commands may go, and only one is ahead. One that waits for
        its tool has not begun.
        """
        wanted = min(self.confirmed + 1, self.feeder.holes)
        stopping = self.trouble or self._told_to_stop
        next_one = self.feeder.released_holes < wanted and not self.feeder.gated(wanted)
        if self.journal is not None and next_one and not stopping:
            try:
                self.journal.begun(self.job.hole_number(wanted))
                self.feeder.release(wanted)
            except JournalError as error:
                self._stop_for(error)
        self.feeder.feed()

    def _hear_operator(self) -> None:
        """A hold, and its end, are asked for until they are so: a request may meet a gap's hold, or a command's end."""
        for request in self.operator.requests() if self.operator else ():
            self.link.post(request)
            self._told_to_stop |= request == Request.STOP
        condition = self.status["condition"]
        if self.held and condition == Condition.READY and self.status["job"]:
            self.link.post(Request.HOLD)
        if not self.held and self.resumes_itself and condition == Condition.HOLDING and not self.status["moving"]:
            self.link.post(Request.RESUME)

    def _change_tool(self) -> None:
        """At a gate, with everything before it done and at rest, the operator is asked."""
        tool = self.feeder.awaited_tool()
        done = int(self.status["done"]) - int(self.first["done"])
        if tool is None or self.tool_change is None or done < self.feeder.put or self.status["moving"]:
            return
        groups = self.job.work.groups if self.job.work else ()
        diameter_mm = next((group.diameter_mm for group in groups if group.number == tool), None)
        if self.tool_change(tool, diameter_mm):
            self.feeder.open_gate()

    def _confirm(self) -> None:
        """Holes that execution has drilled, into the journal: once the head is up again. A lower sensor that answers
        too early is caught there at the latest (SENSOR_CONTRADICTION), and its hole drilled again.
        """
        done = self.feeder.holes_ended(int(self.status["done"]) - int(self.first["done"]))
        if self.journal is not None and done > self.confirmed and not self.trouble:
            try:
                self.journal.done([self.job.hole_number(hole) for hole in range(self.confirmed + 1, done + 1)])
            except JournalError as error:
                self._stop_for(error)
        self.confirmed = done

    def _stop_for(self, error: JournalError) -> None:
        """What can't be written down is not drilled."""
        if self.trouble is None:
            self.trouble = str(error)
            self.link.post(Request.STOP)

    def _end_journal(self, outcome: Outcome) -> None:
        if self.journal is None:
            return
        how = "stopped" if outcome.interrupted or self.trouble else "done"
        try:
            self.journal.ended(outcome.fault.name if outcome.fault else how)
        except JournalError as error:
            self.trouble = self.trouble or str(error)

    def _outcome(self, status: np.void, interrupted: bool) -> Outcome:
        names = self.job.machine.axis_names
        code = self.link.lost() or int(status["fault"])
        complete = int(status["done"]) == self.last_sequence
        if not (code or complete or interrupted or self.trouble):
            self.trouble = BY_OPERATOR if self._told_to_stop else BY_OTHERS
        kept = bool(status["fault_kept"]) and not self.link.lost()
        by_axis = {name: status[name].tolist() for name in ("steps", "position", "lost")}
        return Outcome(
            machine=self.job.machine.name,
            holes_done=self.done_before + self.confirmed,
            holes_total=self.done_before + self.job.holes_total,
            ticks=int(status["tick"] - self.first["tick"]),
            tick_hz=self.job.machine.tick_hz,
            steps=dict(zip(names, by_axis["steps"], strict=False)),
            position=dict(zip(names, by_axis["position"], strict=False)),
            position_known=bool(status["position_known"]) and not self.link.lost(),
            lost_steps=dict(zip(names, by_axis["lost"], strict=False)) if self.link.measured else None,
            underruns=int(status["underruns"]),
            fault=fault_report(Fault(code), kept) if code else None,
            late_count=int(status["late"]),
            late_greatest_ms=int(status["late_worst_ns"]) / 1e6,
            interrupted=interrupted or not (code or complete),
        )


@contextmanager
def _stopping(link: Link) -> Iterator[list[int]]:
    """The first signal asks for a stop down the ramp, the second for an emergency stop. Yields those that came."""
    came: list[int] = []

    def ask(number: int, frame: FrameType | None) -> None:
        link.post(Request.ESTOP if came else Request.STOP)
        came.append(number)

    with caught(ask):
        yield came
