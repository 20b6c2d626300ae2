"""Runs one job: puts its commands into the queue, journals its holes, listens to the operator, says how it ended.

Rule: the runner knows a job, a link to a ticker (queue, requests, status) and a journal; everything below the queue is
the ticker's. On every way out the outputs are safe.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from types import FrameType

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.errors import JobError
from drillctl.generation.feeder import Feeder
from drillctl.generation.job import Job, MadeHole
from drillctl.jobs.estimate import TimeLeft
from drillctl.jobs.interrupts import caught
from drillctl.jobs.journal import Journal, JournalError
from drillctl.jobs.magazine import MagazineError
from drillctl.jobs.operator import HoldLimit, JobHold, Operator, ToolChange
from drillctl.jobs.outcome import JobResult, fault_code, outcome_of
from drillctl.jobs.tool_keeping import ToolKeeping
from drillctl.kmd import Request, is_complete, is_over
from drillctl.language import Message
from drillctl.replay.header import trace_header
from drillctl.ticker.link import Link
from drillctl.viewmodel.records import Outcome, Progress

BY_OPERATOR = Message("the operator stopped the job")
BY_OTHERS = Message("the job was stopped before its end")  # by a signal to a process beside this one
Watcher = Callable[[Progress], None]


@dataclass
class JobRunner:
    """One job on one link: ``begin``, ``advance`` until it is over, ``end``; or ``run``, which does all three.

    watcher        is given the progress at every turn
    journal        is written where there is one; it and the link stay open afterwards
    done_before    holes drilled by earlier runs of this job
    ticks          (n,) that each command of the program takes; None where that was not worked out, which may take
                   longer than a ticker tolerates the desk's silence
    tool_change    None: each tool change counts as made
    resumes_itself see JobHold
    tools          keeps the magazine record, on a machine that has one
    room_ticks     the most that its record has room for; None: that was looked at before
    hold_limit     ends a job that inputs hold for too long; None: it waits for its operator
    """

    job: Job
    link: Link
    watcher: Watcher
    journal: Journal | None = None
    done_before: int = 0
    ticks: NDArray[np.int64] | None = None
    holes: list[MadeHole] = field(default_factory=list)
    trouble: Message | None = None
    tool_change: ToolChange | None = None
    operator: Operator | None = None
    resumes_itself: bool = True
    tools: ToolKeeping | None = None
    hold_limit: HoldLimit | None = None
    room_ticks: int | None = None

    def __post_init__(self) -> None:
        self.first = self.status = self.link.status()
        self.feeder = Feeder(self.job.program, self.link.queue)
        self.confirmed = 0
        self.hold = JobHold(self.resumes_itself)
        self._time_left = None if self.ticks is None else TimeLeft(self.ticks)
        self._stop_asked = False

    def run(self) -> JobResult:
        """Runs the job to its end. Ctrl-C, SIGTERM or a closed terminal stops it; a second one is an emergency stop."""
        with _stopping(self.link) as stopped:
            self.begin()
            while not self.advance():
                pass
        return self.end(stopped[0] if stopped else None)

    def begin(self) -> None:
        """Sends the program, numbered on from what the ticker has done, so that no earlier command counts as ours."""
        self.first = self.link.status()
        program = self.job.program.copy()
        program["sequence"] += self.first["done"]
        program["epoch"] = self.first["epoch"]
        self.feeder = Feeder(program, self.link.queue)
        if self.journal is not None:
            self.feeder.hold_back()
        if self.tool_change is not None:
            self.feeder.gate_tools()
        if self.tools is not None:
            self.feeder.stop_before(self.tools.barriers)
        self.status = self.first
        self._feed()

    def advance(self) -> bool:
        """Feeds the queue, lets the machine run for a moment and reads its status; returns whether the job is over.
        Raises JobError where its record has no room for more ticks.
        """
        self._feed()
        self.link.turn()
        self.status = status = self.link.status()
        if self.room_ticks is not None:
            check_room(self.job, int(status["tick"] - self.first["tick"]), self.room_ticks)
        self._confirm()
        self._change_tool()
        self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
        self.watcher(self.progress())
        if self.link.lost() or is_over(status, self.last_sequence, int(self.first["epoch"])):
            return True
        self._hear_operator()
        return False

    @property
    def last_sequence(self) -> int:
        """The sequence number of the program's last command, as it was sent."""
        return int(self.first["done"]) + len(self.job.program)

    def end(self, stopped_by: int | None = None) -> JobResult:
        """Ends the journal and returns how the job ended; ``stopped_by`` is the signal that stopped it."""
        self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
        outcome = self.settle(stopped_by is not None)
        trace = self.link.trace(trace_header(self.job, self.link.plant_header))
        return JobResult(outcome, self.holes, trace, stopped_by, self.trouble, tuple(self.link.notices()))

    def settle(self, interrupted: bool = False) -> Outcome:
        """Writes the end of the job into the journal and returns it; ``interrupted``: a signal stopped it."""
        outcome = self._outcome(interrupted)
        self._end_journal(outcome)
        return outcome

    def progress(self) -> Progress:
        """How far the job is: holes, tool, time, and the time left where the ticks of its commands are known."""
        hz, ticks = self.job.machine.tick_hz, int(self.status["tick"] - self.first["tick"])
        left = None if self._time_left is None else self._time_left.ticks(self._commands, ticks) / hz
        done = self.done_before + self.confirmed
        total = self.done_before + self.job.holes_total
        return Progress(done, total, int(self.status["tool"]), ticks, ticks / hz, left, self.hold.held)

    def _feed(self) -> None:
        """Fills the queue. With a journal, a hole's commands are sent after the hole was journalled as begun, and only
        one such hole is ahead of those done. A hole that waits for its tool has not begun.
        """
        wanted = min(self.confirmed + 1, self.feeder.holes)
        stopping = self.trouble or self._stop_asked
        next_one = self.feeder.released_holes < wanted and not self.feeder.gated(wanted)
        if self.journal is not None and next_one and not stopping:
            try:
                self.journal.begun(self.job.hole_number(wanted))
                self.feeder.release(wanted)
            except JournalError as error:
                self._stop_for(error.message)
        self.feeder.feed()
        self._begin_transfer()

    def _begin_transfer(self) -> None:
        """Notes the transfer of a tool that comes next, and then lets its first command through."""
        due = self.tools is not None and self.feeder.at_barrier and self.tools.is_due(self._commands)
        if self.tools is None or not due or self.trouble:
            return
        self._keep(self.tools.begin)
        if not self.trouble:
            self.feeder.let_through()
            self.feeder.feed()

    def _keep(self, note: Callable[[], None]) -> None:
        """Changes the magazine record; where that fails, stops the job."""
        try:
            note()
        except MagazineError as error:
            self._stop_for(error.message)

    def _hear_operator(self) -> None:
        """Passes on what the operator asked since the last turn, and what the hold still needs."""
        for request in self.operator.requests(self.hold.held) if self.operator else ():
            if request in (Request.HOLD, Request.RESUME):
                self.hold.wanted = request == Request.HOLD
            else:
                self.link.post(request)
                self._stop_asked |= request == Request.STOP
        if self.hold_limit and (reason := self.hold_limit.exceeded(self.status)):
            self._stop_for(reason)
        if (due := self.hold.due(self.status)) is not None:
            self.link.post(due)

    def _change_tool(self) -> None:
        """Asks the operator for the tool that the program needs next, once everything before is done and at rest."""
        tool = self.feeder.awaited_tool()
        if tool is None or self.tool_change is None or self._commands < self.feeder.put or self.status["moving"]:
            return
        groups = self.job.work.groups if self.job.work else ()
        diameter_mm = next((group.diameter_mm for group in groups if group.number == tool), None)
        if self.tool_change(tool, diameter_mm):
            self.feeder.open_gate()

    def _confirm(self) -> None:
        """Journals the holes that are done: a hole is, once the head is up again. A lower sensor that answers too early
        is noticed there at the latest (SENSOR_CONTRADICTION), and its hole is drilled again.
        """
        if self.tools is not None and not self.trouble:
            self._keep(partial(self.tools.done, self._commands, int(self.status["fault"])))
        done = self.feeder.holes_ended(self._commands)
        if self.journal is not None and done > self.confirmed and not self.trouble:
            try:
                self.journal.done([self.job.hole_number(hole) for hole in range(self.confirmed + 1, done + 1)])
            except JournalError as error:
                self._stop_for(error.message)
        self.confirmed = done

    def _stop_for(self, reason: Message) -> None:
        """Stops the job because its journal or the magazine record can't be written, or it is held for too long."""
        if self.trouble is None:
            self.trouble = reason
            self.link.post(Request.STOP)

    def _end_journal(self, outcome: Outcome) -> None:
        if self.journal is None:
            return
        how = "stopped" if outcome.interrupted or self.trouble else "done"
        try:
            self.journal.suspect(outcome.suspect)
            self.journal.ended(outcome.fault.name if outcome.fault else how)
        except JournalError as error:
            self.trouble = self.trouble or error.message

    def _outcome(self, interrupted: bool) -> Outcome:
        over = is_complete(self.status, self.last_sequence) or bool(fault_code(self.link, self.status))
        if not (over or interrupted or self.trouble):
            self.trouble = BY_OPERATOR if self._stop_asked else BY_OTHERS
        return outcome_of(
            self.job,
            self.link,
            self.first,
            self.status,
            done_before=self.done_before,
            done=self.confirmed,
            interrupted=interrupted or not over,
        )

    @property
    def _commands(self) -> int:
        """How many commands of the program are done."""
        return int(self.status["done"]) - int(self.first["done"])


def check_room(job: Job, ticks: int, room_ticks: int) -> None:
    """Raises JobError for a run of more ticks than its record has room for."""
    if ticks > room_ticks:
        reason = Message(
            "{ticks} ticks; a trace has room for {room}; record a part of the job, or run it without --trace and "
            "--vcd",
            ticks=ticks,
            room=room_ticks,
        )
        raise JobError(reason.at(job.name))


@contextmanager
def _stopping(link: Link) -> Iterator[list[int]]:
    """Within it the first signal asks for a stop down the ramp, the second for an emergency stop. Yields the list of
    the signals that came.
    """
    came: list[int] = []

    def ask(number: int, frame: FrameType | None) -> None:
        link.post(Request.ESTOP if came else Request.STOP)
        came.append(number)

    with caught(ask):
        yield came
