"""One run of a job, from opening the port to the last line of the journal. Called by run and resume."""

import hashlib
import os
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
from drillctl.generation.pcb_drill.board import without_holes
from drillctl.generation.readers import load_job
from drillctl.generation.recipe import Recipe
from drillctl.jobs.journal import Account, Head, Journal, check_same, head_of
from drillctl.jobs.runner import JobResult, JobRunner, Operator, ToolChange, Watcher
from drillctl.jobs.site import site_of
from drillctl.machine import Machine
from drillctl.ticker.forecast import forecast
from drillctl.ticker.launch import FREE, RunSettings, files_of, is_soon_over, pace_of, start
from drillctl.trace.segments import MOST_TICKS


@dataclass(frozen=True)
class Session:
    """A job and how it is run. With a journal file: kept there, begun with a Head, or gone on with from an Account."""

    job: Job
    running: RunSettings
    journal: Path | None = None
    known: Head | Account | None = None
    tool_change: ToolChange | None = None
    operator: Operator | None = None

    def journalled(self, file: Path, journal: Path | None, recipe: Recipe) -> "Session":
        """With a journal for a job made from ``file``; in the user's state folder where no place is given."""
        return replace(self, journal=journal or default_journal(file), known=head_of(file, self.job, recipe.options()))

    @property
    def files(self) -> tuple[Path, ...]:
        """What it keeps on the disk while it runs: no place for its results."""
        kept = () if self.journal is None else (self.journal, _status_of(self.journal))
        return (*kept, *files_of(self.running.port))

    def run(self, watcher: Watcher) -> JobResult:
        """Raises JournalError or PortError before anything moves."""
        foreseen = self._foreseen()
        done_before = self.known.holes_done if isinstance(self.known, Account) else 0
        with ExitStack() as opened:
            journal = None
            if self.journal is not None and self.known is not None:
                journal = opened.enter_context(closing(Journal(self.journal, self.known, site_of(self.running))))
            status_file = opened.enter_context(_status_file(self.journal))
            link = opened.enter_context(closing(start(self.job.machine, self.running, status_file)))
            desk = JobRunner(
                self.job, link, watcher, journal, done_before, foreseen,
                tool_change=self.tool_change, operator=self.operator,
            )  # fmt: skip
            return desk.run()

    def _foreseen(self) -> NDArray[np.int64] | None:
        """The ticks of each command, where somebody waits for them. Raises JobError for a run that is to be kept in a
        trace and has more ticks than one has room for.
        """
        kept = self.running.traced and pace_of(self.running) == FREE
        if not kept and (not self.job.work or is_soon_over(self.running)):
            return None
        told = forecast(self.job.program, self.job.machine)
        if kept and told.total_ticks > MOST_TICKS:
            reason = f"{told.total_ticks} ticks; a trace has room for {MOST_TICKS}"
            hint = "record a part of the job, or run it without --trace and --vcd"
            raise JobError([f"{self.job.name}: {reason}; {hint}"])
        return None if is_soon_over(self.running) or not self.job.work else told.ticks


@dataclass(frozen=True, eq=False)
class RemainingJob:
    """A journalled job made again: the whole of it, and what is left."""

    recipe: Recipe
    whole: Job
    left: Job


def rest_of(journal: Path, account: Account, machine: Machine) -> RemainingJob:
    """Refused unless it is the same job. Raises JobError, JournalError, PlacingError or AlignmentError."""
    recipe = Recipe.of_options(account.head.options, journal)
    file = Path(account.head.job)
    wishes = recipe.wishes(machine)
    job = load_job(file, machine, wishes, *recipe.reading())
    check_same(journal, account.head, head_of(file, job, account.head.options))
    if account.complete:
        raise JobError([f"{journal}: all {job.holes_total} holes of {file.name} are drilled; nothing is left"])
    return RemainingJob(recipe, job, without_holes(job, account.done, wishes))


def default_journal(file: Path) -> Path:
    """Where a job's journal is kept when nobody says where: one for each file, wherever that lies."""
    place = hashlib.sha256(os.fsencode(real_path(file))).hexdigest()[:8]
    return journals() / f"{file.stem}-{place}.journal"


def journals() -> Path:
    """The user's folder of journals."""
    from platformdirs import user_state_path

    return user_state_path("drillctl", appauthor=False)


def _status_of(journal: Path) -> Path:
    return journal.parent / f"{journal.name}.status"  # with_name would raise for a folder, which is refused later


@contextmanager
def _status_file(journal: Path | None) -> Iterator[Path]:
    """The mapped file of a paced run: beside the journal, where it stays after a crash until the next run; else for
    the moment.
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
