"""The board on the operator's desk: planned as asked for, journalled, opened again, gone on with.

Rule: a board is planned whole or the one before stays; a job that is drilled has a journal as `drillctl run` keeps it,
and what was cut off is made again by the same code as `drillctl resume`. Used by station.
"""

from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from drillctl.console.operator_state import Base
from drillctl.console.recent_jobs import RecentJobs
from drillctl.console.views import board_view
from drillctl.files.inputs import real_path
from drillctl.generation import alignment
from drillctl.generation.alignment import decompose
from drillctl.generation.errors import JobError
from drillctl.generation.job import Job
from drillctl.generation.measured import AlignmentError
from drillctl.generation.placing import PlacingError
from drillctl.generation.readers import load_job
from drillctl.generation.recipe import MeasuredRow, Recipe
from drillctl.jobs.estimate import foresee
from drillctl.jobs.journal import Account, Head, Journal, JournalError, head_of, read_journal
from drillctl.jobs.journal.folder import give_up, unfinished
from drillctl.jobs.runner import JobRunner
from drillctl.jobs.session import default_journal, journals, rest_of
from drillctl.jobs.site import moved
from drillctl.machine import Library, Machine
from drillctl.viewmodel.console import BoardView, Problems
from drillctl.viewmodel.jobs import AlignmentReport, Asked, MeasuredHole, RecentJob, Site, UnfinishedJob

REFUSALS = (JobError, PlacingError, AlignmentError, JournalError, OSError)


@dataclass(frozen=True, eq=False)
class Plan:
    """A board as it will be drilled; ``left`` of it, ``known`` by a new journal's head or by an old one's account."""

    file: Path
    recipe: Recipe
    view: BoardView
    left: Job
    foreseen: NDArray[np.int64]  # ticks of each command of what is left
    journal: Path
    known: Head | Account

    @property
    def done_before(self) -> int:
        """Holes of earlier runs."""
        return self.known.holes_done if isinstance(self.known, Account) else 0


class Boards:
    """One board at a time, with the lists of what was opened and what was cut off."""

    def __init__(self) -> None:
        self._recent = RecentJobs(journals() / "recent.json")
        self.plan: Plan | None = None
        self.journal: Journal | None = None
        self.troubles: Problems = ()

    def load(self, file: Path, asked: Asked, machine: Machine, base: Base) -> Problems:
        """A drill file, as asked."""
        try:
            recipe = recipe_of(asked, machine, base)
        except msgspec.ValidationError as error:
            return (f"{file}: it can't be opened with these settings: {error}",)
        if problems := self._planned(file, recipe, machine):
            return problems
        self._recent.add(file, asked)
        return ()

    def based(self, machine: Machine, base: Base) -> Problems:
        """The same board from another working base, or at another tick rate. Nothing where it is planned so."""
        if self.plan is None or (self.plan.recipe.base, self.plan.recipe.tick_hz) == (base, machine.tick_hz):
            return ()
        recipe = msgspec.structs.replace(self.plan.recipe, base=base, tick_hz=machine.tick_hz)
        return self._planned(self.plan.file, recipe, machine)

    def forget(self) -> None:
        """No board lies on the desk."""
        self.plan = None

    def recent(self) -> list[RecentJob]:
        """The newest first."""
        return self._recent.read()

    def unfinished(self, here: Site) -> list[UnfinishedJob]:
        """The newest first, whichever machine they were begun on; ``here`` is where they would go on."""
        return [_unfinished_job(file, account, here) for file, account in unfinished(journals())]

    def take_up(self, journal: Path, machine: Machine, here: Site, elsewhere: bool) -> Problems:
        """What is left of a job that was cut off, from its own base; not elsewhere unless that was agreed to."""
        try:
            account = read_journal(journal)
            if account.head.machine != machine.name:
                return (f"the job was begun on machine {account.head.machine}; choose that one first",)
            if not elsewhere and (reason := moved(account.site, here)):
                return (f"{journal}: {reason}",)
            rest = rest_of(journal, account, machine)
            told, ticks = foresee(rest.left)
            view = board_view(Path(account.head.job), rest.whole, told, *rest.recipe.reading())
        except REFUSALS as error:
            return _problems(error)
        self.plan = Plan(Path(account.head.job), rest.recipe, view, rest.left, ticks, journal, account)
        return ()

    def give_up(self, journal: Path) -> Problems:
        """It is not gone on with."""
        try:
            give_up(journal)
        except JournalError as error:
            return _problems(error)
        return ()

    def begin(self, here: Site) -> Problems:
        """Opens the journal of the board on the desk. Refused too where an unfinished job of its file would be lost."""
        assert self.plan is not None
        try:
            self.journal = Journal(self.plan.journal, self.plan.known, here)
        except JournalError as error:
            return _problems(error)
        return ()

    def ended(self, desk: JobRunner, machine: Machine) -> None:
        """A job is over, its journal with it. What can be started now is the whole board again."""
        if self.journal is None:
            return
        self.troubles = (desk.trouble,) if desk.trouble else ()  # of the journal; that the job was stopped is no news
        desk.settle()
        self.close()
        if self.plan is not None and isinstance(self.plan.known, Account):
            self._planned(self.plan.file, self.plan.recipe, machine)

    def close(self) -> None:
        """Nothing more is written of a job that was cut off."""
        if self.journal is not None:
            self.journal.close()
            self.journal = None

    def _planned(self, file: Path, recipe: Recipe, machine: Machine) -> Problems:
        try:
            job = load_job(file, machine, recipe.wishes(machine), *recipe.reading())
            if job.work is None:
                return (f"{file}: a queue of commands; it is run from the queue editor",)
            told, ticks = foresee(job)
            view = board_view(file, job, told, *recipe.reading())
            head = head_of(file, job, recipe.options())
        except REFUSALS as error:
            return _problems(error)
        self.plan = Plan(file, recipe, view, job, ticks, default_journal(file), head)
        return ()


def recipe_of(asked: Asked, machine: Machine, base: Base) -> Recipe:
    """A board is placed by its measured holes alone where there are any. Raises msgspec.ValidationError for settings
    that the command line would not take: a list of recent jobs may hold anything.
    """
    panel = asked.panel
    told = {
        "machine": _reference(machine),
        "tick_hz": machine.tick_hz,
        "origin": None if asked.origin == "base" else asked.origin,
        "mirror": asked.mirror,
        "rotate": asked.rotate_deg,
        "offset": asked.offset_mm,
        "align": tuple(map(_row, asked.measured)) or None,
        "panel": (panel.columns, panel.rows, panel.pitch_x_mm, panel.pitch_y_mm) if panel else None,
        "order": asked.order,
        "skip_tools": tuple(sorted(asked.skip_tools)),
        "drills": asked.drills,
        "peck": asked.peck_mm,
        "spot": asked.spot_mm,
        "format": asked.format,
        "after_end": asked.after_end,
        "base": base,
    }
    return Recipe.checked(told)


def _reference(machine: Machine) -> str:
    """By its name where that leads to it, else by its file."""
    file = real_path(machine.file)
    named = Library.standard().find("machines", machine.name)
    return machine.name if named is not None and real_path(named) == file else str(file)


def align(measured: tuple[MeasuredHole, ...], face_down: bool) -> tuple[AlignmentReport | None, Problems]:
    """What measured holes say of where a board lies; or why they say nothing."""
    rows = [_row(hole) for hole in measured]
    try:
        found = alignment.fit([row[:2] for row in rows], [row[2:] for row in rows], mirrored=face_down)
    except AlignmentError as error:
        return None, _problems(error)
    parts = decompose(found.affine)
    residual_mm = tuple(found.residual_mm.tolist())
    scale = (parts.scale_x, parts.scale_y)
    told = AlignmentReport(
        found.kind, found.affine.matrix, residual_mm, parts.turn_deg, scale, found.warnings, found.rejected
    )
    return told, ()


def _row(hole: MeasuredHole) -> MeasuredRow:
    return hole.file_x_mm, hole.file_y_mm, hole.machine_x_mm, hole.machine_y_mm


def _problems(error: Exception) -> Problems:
    if isinstance(error, OSError):
        return (f"{error.filename}: can't be read: {error.strerror}",)
    return tuple(str(error).splitlines())


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
        ran=account.site,
        here=here,
    )
