"""Wiring: one run of a job, from opening the port to the last line of the journal. Called by run and resume."""

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from drillctl.desk import Desk, Run, Watcher
from drillctl.generation.job import Job
from drillctl.generation.journal import Head, Journal, head_of
from drillctl.machinery import Running, start


@dataclass(frozen=True)
class Session:
    """A job and how it is run. With a journal file: kept there; ``head`` None goes on with the one that is there."""

    job: Job
    running: Running
    journal: Path | None = None
    head: Head | None = None
    done_before: int = 0

    def journalled(self, file: Path, journal: Path | None, options: Mapping[str, Any]) -> "Session":
        """With a journal for a job made from ``file``; in the user's state folder where no place is given."""
        return replace(self, journal=journal or default_journal(file), head=head_of(file, self.job, options))

    def run(self, watcher: Watcher) -> Run:
        """Raises JournalError or PortError before anything moves."""
        journal = Journal(self.journal, self.head) if self.journal else None
        with _status_file(self.journal) as status_file:
            link = start(self.job.machine, self.running, status_file)
            return Desk(self.job, link, watcher, journal, self.done_before).run()


def default_journal(file: Path) -> Path:
    """Where a job's journal is kept when nobody says where."""
    return journals() / f"{file.stem}.journal"


def journals() -> Path:
    """The user's folder of journals."""
    from platformdirs import user_state_path

    return user_state_path("drillctl", appauthor=False)


@contextmanager
def _status_file(journal: Path | None) -> Iterator[Path]:
    """The mapped file of a paced run: beside the journal, where it tells of a crash; else for the moment."""
    if journal is not None:
        yield journal.with_name(f"{journal.name}.status")
        return
    with tempfile.TemporaryDirectory(prefix="drillctl-") as folder:
        yield Path(folder) / "status"
