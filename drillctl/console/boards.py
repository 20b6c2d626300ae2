"""The board that is loaded: planned by its options, journalled, and what is left of one that was cut off.

Rule: a board is planned whole or the one before stays; a job that is drilled has a journal as `drillctl run` keeps it,
and what was cut off is made again by the same code as `drillctl resume`.
"""

from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from drillctl.console.job_request import setup_of
from drillctl.console.operator_state import Base
from drillctl.console.recent_jobs import RecentJobs
from drillctl.console.views import board_view
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.job_setup import JobSetup
from drillctl.generation.measured import AlignmentError
from drillctl.generation.placing import PlacingError
from drillctl.generation.readers import load_job
from drillctl.generation.waits import PLANNED, unwatched
from drillctl.jobs.estimate import estimate_with_ticks
from drillctl.jobs.journal import Account, Head, Journal, JournalError, head_of, read_journal
from drillctl.jobs.journal.folder import give_up, unfinished
from drillctl.jobs.magazine import MagazineError
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.session import default_journal, journals, rest_of
from drillctl.jobs.site import moved
from drillctl.jobs.tool_keeping import ToolKeeping, with_tools
from drillctl.language import Message, Refusal, message_of
from drillctl.machine import Machine
from drillctl.viewmodel.console import BoardView, Problems, Watch
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.jobs import RecentJob, Site, UnfinishedJob

REFUSALS = (JobError, PlacingError, AlignmentError, JournalError, MagazineError, OSError)


@dataclass(frozen=True, eq=False)
class Plan:
    """A board as it will be drilled.

    left     the job that drills it, or what is left of it
    ticks    (n,) that each command of ``left`` takes
    journal  its file; begun with ``start_from``, or gone on with where that is the account of an earlier run
    """

    file: Path
    setup: JobSetup
    view: BoardView
    left: Job
    ticks: NDArray[np.int64]
    journal: Path
    start_from: Head | Account

    @property
    def done_before(self) -> int:
        """How many holes earlier runs have drilled."""
        return self.start_from.holes_done if isinstance(self.start_from, Account) else 0


class Boards:
    """One board at a time, with the lists of what was opened and what was cut off.

    begun     the job that was begun, with the tools that the machine has, and what keeps the record of these
    troubles  of the journal of the job that ran last; that the job was stopped is none
    """

    def __init__(self) -> None:
        self._recent = RecentJobs(journals() / "recent.json")
        self.plan: Plan | None = None
        self.journal: Journal | None = None
        self.begun: tuple[Job, ToolKeeping | None] | None = None
        self.troubles: Problems = ()

    def load(self, file: Path, options: JobOptions, machine: Machine, base: Base, watch: Watch) -> Problems:
        """Plans the board of a drill file, from this working base; it becomes the newest of the recent jobs."""
        try:
            setup = setup_of(options, machine, base)
        except msgspec.ValidationError as error:
            return (Message("it can't be opened with these settings: {why}", why=message_of(error)).at(file),)
        if problems := self._planned(file, setup, machine, watch):
            return problems
        self._recent.add(file, options)
        return ()

    def plan_again(self, machine: Machine, base: Base) -> Problems:
        """Plans the loaded board again where its working base or the machine's tick rate is another one now."""
        if self.plan is None or (self.plan.setup.base, self.plan.setup.tick_hz) == (base, machine.tick_hz):
            return ()
        setup = msgspec.structs.replace(self.plan.setup, base=base, tick_hz=machine.tick_hz)
        return self._planned(self.plan.file, setup, machine)

    def forget(self) -> None:
        """From now on no board is loaded."""
        self.plan = None

    def recent(self) -> list[RecentJob]:
        """The boards opened last, the newest first."""
        return self._recent.read()

    def unfinished(self, here: Site) -> list[UnfinishedJob]:
        """The jobs that were cut off, the newest first, on whichever machine; ``here`` is where they would go on."""
        return [_unfinished_job(file, account, here) for file, account in unfinished(journals())]

    def take_up(self, journal: Path, machine: Machine, here: Site, elsewhere: bool, watch: Watch) -> Problems:
        """Plans what is left of a job that was cut off, from its own working base. Refused where it ran on another
        machine, or elsewhere than ``here``; ``elsewhere``: the operator has agreed to the latter.
        """
        try:
            account = read_journal(journal)
            if account.head.machine != machine.name:
                return (
                    Message(
                        "the job was begun on machine {machine}; choose that one first", machine=account.head.machine
                    ),
                )
            if not elsewhere and (reason := moved(account.site, here)):
                return (reason.at(journal),)
            rest = rest_of(journal, account, machine, watch)
            estimate, ticks = estimate_with_ticks(rest.left, waits=watch)
            watch(PLANNED)
            view = board_view(Path(account.head.job), rest.whole, estimate, *rest.setup.reading())
        except REFUSALS as error:
            return _problems(error)
        self.plan = Plan(Path(account.head.job), rest.setup, view, rest.left, ticks, journal, account)
        return ()

    def give_up(self, journal: Path) -> Problems:
        """Deletes the journal of a job that was cut off."""
        try:
            give_up(journal)
        except JournalError as error:
            return _problems(error)
        return ()

    def begin(self, here: Site) -> Problems:
        """Opens the journal of the loaded board. Refused where it holds an unfinished job, which would be lost, or
        where the tools of the machine do not do for what is left.
        """
        assert self.plan is not None
        try:
            self.begun = with_tools(self.plan.left, journals())
            self.journal = Journal(self.plan.journal, self.plan.start_from, here)
        except REFUSALS as error:
            return _problems(error)
        return ()

    def ended(self, runner: JobRunner, machine: Machine) -> None:
        """Ends the journal of a job that is over. What can be started now is the whole board again."""
        if self.journal is None:
            return
        self.troubles = (runner.trouble,) if runner.trouble else ()
        runner.settle()
        self.close()
        if self.plan is not None and isinstance(self.plan.start_from, Account):
            self._planned(self.plan.file, self.plan.setup, machine)

    def close(self) -> None:
        """Closes the journal; of a job that still runs, as where it was cut off."""
        if self.journal is not None:
            self.journal.close()
            self.journal = None

    def _planned(self, file: Path, setup: JobSetup, machine: Machine, watch: Watch = unwatched) -> Problems:
        try:
            job = load_job(file, machine, setup, watch)
            if job.work is None:
                return (Message("a queue of commands; it is run from the queue editor").at(file),)
            estimate, ticks = estimate_with_ticks(job, waits=watch)
            watch(PLANNED)
            view = board_view(file, job, estimate, *setup.reading())
            head = head_of(file, job, setup.as_journalled())
        except REFUSALS as error:
            return _problems(error)
        self.plan = Plan(file, setup, view, job, ticks, default_journal(file), head)
        return ()


def _problems(error: Refusal | OSError) -> Problems:
    if isinstance(error, OSError):
        return (Message("can't be read: {why}", why=message_of(error)).at(error.filename),)
    return error.messages


def _unfinished_job(file: Path, account: Account, here: Site) -> UnfinishedJob:
    head = account.head
    return UnfinishedJob(
        journal=str(file),
        file=head.job,
        machine=head.machine,
        holes_done=account.holes_done,
        holes_total=head.holes,
        again=tuple(account.open),
        torn=account.torn,
        spotted=head.options.get("spot") is not None,
        doubtful=account.doubtful,
        suspect=account.suspect,
        ran=account.site,
        here=here,
    )
