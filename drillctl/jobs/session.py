"""One run of a job, from opening the port to the last line of the journal; and the files that it leaves behind.

Rule: whatever can be refused is refused before anything moves; port, journal and status file are closed on every way
out.
"""

import hashlib
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import real_path
from drillctl.files.scratch import KEPT_IN_FOLDERS, Folder, sweep
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.readers import load_job
from drillctl.generation.waits import FORECASTING, Waits, unwatched
from drillctl.jobs.journal import Account, Head, Journal, check_same, head_of
from drillctl.jobs.operator import HoldLimit, Operator, ToolChange
from drillctl.jobs.outcome import JobResult
from drillctl.jobs.runner import JobRunner, Watcher, check_room
from drillctl.jobs.site import site_of
from drillctl.jobs.tool_keeping import ToolKeeping, with_tools
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.ticker.forecast import forecast
from drillctl.ticker.launch import FREE, RunSettings, check_site, files_of, in_batches, is_soon_over, pace_of, start
from drillctl.trace.segments import MOST_STRIP_TICKS, MOST_TICKS

MOST_HELD_S = 60.0


@dataclass(frozen=True)
class Session:
    """A job and how it is run. With ``journal``, a file: begun there with a Head, or gone on with from an Account.
    Without an operator, inputs may hold it for ``most_held_s`` seconds.
    """

    job: Job
    running: RunSettings
    journal: Path | None = None
    start_from: Head | Account | None = None
    tool_change: ToolChange | None = None
    operator: Operator | None = None
    tools: ToolKeeping | None = None
    most_held_s: float = MOST_HELD_S
    has_forecast: bool = False
    ticks: NDArray[np.int64] | None = None  # of each command, where the time left is shown

    def journalled(self, file: Path, journal: Path | None, setup: JobSetup) -> "Session":
        """The same with a journal for a job made from ``file``; in the user's state folder where no place is given."""
        work = self.job.work
        ordered = setup.as_ordered(None if work is None else work.order_steps)
        head = head_of(file, self.job, ordered.as_journalled())
        return replace(self, journal=journal or default_journal(file), start_from=head).equipped()

    def equipped(self) -> "Session":
        """The same with the tools where the magazine record has them, which is then kept; unchanged on a machine
        without a magazine. Raises MagazineError, and JobError where the job can't be done with these tools.
        """
        job, tools = with_tools(self.job, journals())
        return replace(self, job=job, tools=tools)

    @property
    def files(self) -> tuple[Path, ...]:
        """The files that it writes while it runs; its results must go elsewhere."""
        journal = () if self.journal is None else (self.journal, _status_of(self.journal))
        record = () if self.tools is None else (self.tools.file,)
        return (*journal, *record, *files_of(self.running.port))

    def run(self, watcher: Watcher) -> JobResult:
        """Runs the job to its end; ``watcher`` is given its progress. Raises JobError, JournalError or PortError before
        anything moves; for a run without a forecast whose record has no room for it, JobError after so many ticks of
        the simulation.
        """
        ticks = self.ticks if self.has_forecast else self.with_forecast().ticks
        done_before = self.start_from.holes_done if isinstance(self.start_from, Account) else 0
        with ExitStack() as opened:
            journal = None
            if self.journal is not None and self.start_from is not None:
                check_site(self.job.machine, self.running)  # a refusal leaves no journal behind
                journal = opened.enter_context(closing(Journal(self.journal, self.start_from, site_of(self.running))))
            status_file = opened.enter_context(_status_file(self.journal))
            link = opened.enter_context(closing(start(self.job.machine, self.running, status_file)))
            limit = None if self.operator else HoldLimit(self.job.machine, self.most_held_s)
            runner = JobRunner(
                self.job, link, watcher, journal, done_before, ticks,
                tool_change=self.tool_change, operator=self.operator, tools=self.tools, hold_limit=limit,
                room_ticks=self._room_ticks if self._keeps and self._is_soon_over else None,
            )  # fmt: skip
            return runner.run()

    def with_forecast(self, waits: Waits = unwatched) -> "Session":
        """The same with the ticks of each command, where the time left is shown; ``run`` makes the forecast
        itself where it was not made before. Raises JobError for a run that is to be kept in a trace and has more ticks
        than one has room for. A run that takes no longer than its forecast, and leaves no journal, is not forecast.
        """
        return replace(self, has_forecast=True, ticks=self._forecast(waits))

    def _forecast(self, waits: Waits) -> NDArray[np.int64] | None:
        shown = self.job.work is not None and not is_soon_over(self.running)
        if self._is_soon_over or not (self._keeps or shown):
            return None
        found = forecast(self.job.program, self.job.machine, advance=waits(FORECASTING))
        if self._keeps:
            check_room(self.job, found.total_ticks, self._room_ticks)
        return found.ticks if shown else None

    @property
    def _keeps(self) -> bool:
        """Whether the run is kept in a record, all of it."""
        return self.running.traced and pace_of(self.running) == FREE

    @property
    def _room_ticks(self) -> int:
        return MOST_STRIP_TICKS if self.running.taped and not in_batches(self.running) else MOST_TICKS

    @property
    def _is_soon_over(self) -> bool:
        """Whether the run is as good as its forecast: as quick, and nothing stays of it where it is refused."""
        return is_soon_over(self.running) and self.journal is None


@dataclass(frozen=True, eq=False)
class RemainingJob:
    """A job made again from its journal: what it is made by, the whole job, and the job that drills what is left."""

    setup: JobSetup
    whole: Job
    left: Job


def rest_of(journal: Path, account: Account, machine: Machine, waits: Waits = unwatched) -> RemainingJob:
    """Makes the job of a journal again and leaves out what is drilled. Raises JournalError unless it is the same job as
    then; JobError, PlacingError or AlignmentError where it can't be made, or nothing is left.
    """
    setup = JobSetup.of_journal(account.head.options, journal)
    file = Path(account.head.job)
    job = load_job(file, machine, setup, waits)
    check_same(journal, account.head, head_of(file, job, account.head.options))
    if account.complete:
        raise JobError(
            Message(
                "all holes of {file} are drilled ({total}); nothing is left", total=job.holes_total, file=file.name
            ).at(journal)
        )
    return RemainingJob(setup, job, job.without_holes(account.done))


def default_journal(file: Path) -> Path:
    """The journal's file where none is named: one for each drill file, by its name and a digest of its path."""
    named = str(real_path(file)).encode("utf-8", "surrogatepass")  # a name need be no UTF-8
    place = hashlib.sha256(named).hexdigest()[:8]
    return journals() / f"{file.stem}-{place}.journal"


def journals() -> Path:
    """The folder in which journals are kept: the user's state folder."""
    from platformdirs import user_state_path

    return user_state_path("drillctl", appauthor=False)


def _status_of(journal: Path) -> Path:
    return journal.parent / f"{journal.name}.status"  # with_name would raise for a folder, which is refused later


@contextmanager
def _status_file(journal: Path | None) -> Iterator[Path]:
    """A place for the file that desk and ticker share in a paced run: beside the journal, where a crash leaves it until
    the next run takes it away; without a journal in a folder that goes with this run.
    """
    if journal is not None:
        file = _status_of(journal)
        sweep(journals(), "*.journal.status")
        sweep(file.parent)
        yield file
        file.unlink(missing_ok=True)
        return
    with Folder() as folder:
        yield folder / KEPT_IN_FOLDERS
