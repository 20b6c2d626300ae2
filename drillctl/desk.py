"""Wiring of layers 1 and 2: takes a job down the queue to its end, journals it, and says how it ended.

Rule: no layer is skipped; the desk knows a job, a link (queue, requests, status) and a journal, the ticker the rest.
On every way out the outputs are safe. Called by the verbs.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

import numpy as np

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import Job, MadeHole, names_of
from drillctl.generation.journal import Journal, JournalError
from drillctl.interrupts import caught
from drillctl.kmd import Condition, Fault, Request, to_text
from drillctl.lab import forecast
from drillctl.link import Link, is_over
from drillctl.panel import Outcome, Progress, fault_report
from drillctl.trace import Trace

Watcher = Callable[[Progress], None]


@dataclass(frozen=True)
class Run:
    """A job that is over: how it ended, the holes that the plant saw made, the trace if one was kept."""

    outcome: Outcome
    holes: list[MadeHole]
    trace: Trace | None
    signal: int | None  # that stopped it
    trouble: str | None = None  # of the journal
    notices: tuple[str, ...] = ()  # of how it was paced


@dataclass
class Desk:
    """One job on one link. ``watcher`` is shown the progress; ``journal`` is kept where there is one."""

    job: Job
    link: Link
    watcher: Watcher
    journal: Journal | None = None
    done_before: int = 0
    holes: list[MadeHole] = field(default_factory=list)
    trouble: str | None = None

    def run(self) -> Run:
        """Drills the job to its end. Ctrl-C, SIGTERM and a closed terminal stop it; a second one drops it."""
        # A queue written by hand can only be foreseen by running it; nobody wants to wait for that twice.
        total_ticks = forecast(self.job.program, self.job.machine).total_ticks if self.job.work else None
        try:
            with _stopping(self.link) as stopped:
                status = self._carry_through(total_ticks)
            self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
            outcome = self._outcome(status, bool(stopped))
            self._close_journal(outcome)
            trace = self.link.trace(trace_header(self.job))
            notices = tuple(self.link.notices())
            return Run(outcome, self.holes, trace, stopped[0] if stopped else None, self.trouble, notices)
        finally:
            self.link.close()

    def _carry_through(self, total_ticks: int | None) -> np.void:
        feeder = Feeder(self.job.program, self.link.queue)
        if self.journal is not None:
            feeder.hold_back()
        first_epoch = int(self.link.status()["epoch"])
        confirmed = 0
        while True:
            self._feed(feeder, confirmed)
            self.link.turn()
            status = self.link.status()
            confirmed = self._confirm(confirmed, status)
            self.holes += [self.job.made_hole(*touch) for touch in self.link.touches()]
            self.watcher(self._progress(status, total_ticks))
            if self.link.lost() or is_over(status, len(self.job.program), first_epoch):
                return status
            if status["condition"] == Condition.HOLDING and not status["moving"] and not self.trouble:
                self.link.post(Request.RESUME)  # held by a gap in time, not by a person

    def _feed(self, feeder: Feeder, confirmed: int) -> None:
        """With a journal: a hole is written down before its commands may go, and only one is ahead."""
        if self.journal is not None and feeder.released_holes < min(confirmed + 1, feeder.holes) and not self.trouble:
            try:
                self.journal.begun(self.job.hole_number(confirmed + 1))
                feeder.release(confirmed + 1)
            except JournalError as error:
                self._stop_for(error)
        feeder.feed()

    def _confirm(self, confirmed: int, status: np.void) -> int:
        """Holes that execution has drilled, into the journal; returns how many there are now."""
        done = int(status["holes_done"])
        if self.journal is not None and done > confirmed and not self.trouble:
            try:
                self.journal.done([self.job.hole_number(hole) for hole in range(confirmed + 1, done + 1)])
            except JournalError as error:
                self._stop_for(error)
        return done

    def _stop_for(self, error: JournalError) -> None:
        """What can't be written down is not drilled."""
        if self.trouble is None:
            self.trouble = str(error)
            self.link.post(Request.STOP)

    def _close_journal(self, outcome: Outcome) -> None:
        if self.journal is None:
            return
        how = outcome.fault.name if outcome.fault else "stopped" if outcome.interrupted or self.trouble else "done"
        try:
            self.journal.ended(how)
        except JournalError as error:
            self.trouble = self.trouble or str(error)
        self.journal.close()

    def _progress(self, status: np.void, total_ticks: int | None) -> Progress:
        hz, ticks = self.job.machine.tick_hz, int(status["tick"])
        left = None if total_ticks is None else max(0, total_ticks - ticks) / hz
        done = self.done_before + int(status["holes_done"])
        return Progress(done, self.done_before + self.job.holes_total, int(status["tool"]), ticks, ticks / hz, left)

    def _outcome(self, status: np.void, interrupted: bool) -> Outcome:
        names = self.job.machine.axis_names
        code = self.link.lost() or int(status["fault"])
        kept = bool(status["fault_kept"]) and not self.link.lost()
        by_axis = {name: status[name].tolist() for name in ("steps", "position", "lost")}
        return Outcome(
            machine=self.job.machine.name,
            holes_done=self.done_before + int(status["holes_done"]),
            holes_total=self.done_before + self.job.holes_total,
            ticks=int(status["tick"]),
            tick_hz=self.job.machine.tick_hz,
            steps=dict(zip(names, by_axis["steps"], strict=False)),
            position=dict(zip(names, by_axis["position"], strict=False)),
            position_known=bool(status["position_known"]) and not self.link.lost(),
            lost_steps=dict(zip(names, by_axis["lost"], strict=False)) if self.link.measured else None,
            starved=int(status["starved"]),
            fault=fault_report(Fault(code), kept) if code else None,
            late_count=int(status["late"]),
            late_greatest_ms=int(status["late_worst_ns"]) / 1e6,
            interrupted=interrupted,
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


def trace_header(job: Job) -> list[tuple[str, str]]:
    """What a trace says of itself, enough to run it again; the machine is named by whoever writes the file."""
    names = names_of(job.machine)
    commands = [("command", f"{record['sequence']} {to_text(record, names)}") for record in job.program]
    return [
        ("machine", job.machine.name),
        ("digest", job.machine.digest),
        ("tick_hz", str(job.machine.tick_hz)),
        ("plant", "ideal"),
        ("seed", "0"),
        *commands,
    ]
