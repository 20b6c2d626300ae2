"""A folder of journals: the jobs in it that were cut off, and giving one of them up.

Rule: a journal that a run still writes belongs to that run; it is neither offered nor taken away.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drillctl.files import system
from drillctl.files.inputs import opened
from drillctl.jobs.journal.account import Account
from drillctl.jobs.journal.chain import JournalError
from drillctl.jobs.journal.reader import LAST_LINE_BYTES, ended_well, read_journal
from drillctl.language import Message, message_of

MOST_LOOKED_AT = 20


class JournalInUse(JournalError):
    """Raised for a journal that a run still writes."""


def unfinished(folder: Path) -> list[tuple[Path, Account]]:
    """The journals that can be gone on with, the newest first; damaged ones and those in use are left out."""
    found = []
    for file in _newest(folder):
        try:
            if (account := _unfinished(file)) is not None:
                found.append((file, account))
        except JournalError:
            continue
    return found


def newest_unfinished(folder: Path) -> tuple[Path, Account] | None:
    """The journal to go on with where none is named; those in use are left out. Raises JournalError for a newer one
    that can't be read: it may be the one that is meant.
    """
    for file in _newest(folder):
        try:
            if (account := _unfinished(file)) is not None:
                return file, account
        except JournalInUse:
            continue
        except JournalError as error:
            raise JournalError(
                Message("{error}; to go on with another journal, name it", error=message_of(error))
            ) from error
    return None


def give_up(file: Path) -> None:
    """Deletes the journal of a job that is not to be gone on with. Raises JournalError."""
    try:
        with _alone(file):
            file.unlink()
    except OSError as error:
        raise JournalError(Message("can't be taken away: {why}", why=message_of(error)).at(file)) from error


def _newest(folder: Path) -> list[Path]:
    try:
        found = [entry for entry in os.scandir(folder) if entry.name.endswith(".journal") and entry.is_file()]
        dated = [(entry.stat().st_mtime, Path(entry)) for entry in found]
    except OSError:
        return []
    return [file for _, file in sorted(dated, reverse=True)[:MOST_LOOKED_AT]]


def _unfinished(file: Path) -> Account | None:
    """The account of an unfinished journal; None for one that is finished, or in which nothing was begun. Raises
    JournalError.
    """
    try:
        if _ended_well(file):
            return None
        with _alone(file):
            account = read_journal(file)
    except OSError as error:
        raise JournalError(Message("can't be read: {why}", why=message_of(error)).at(file)) from error
    return account if account.unfinished else None


def _ended_well(file: Path) -> bool:
    """Whether it is finished, by its last bytes alone, so that finished journals cost no time."""
    with opened(file) as stream:
        stream.seek(max(0, os.fstat(stream.fileno()).st_size - LAST_LINE_BYTES))
        return ended_well(stream.read(LAST_LINE_BYTES))


@contextmanager
def _alone(file: Path) -> Iterator[None]:
    """Within it the journal is locked, so that no run can write it. Raises JournalInUse, OSError."""
    with opened(file) as stream:
        try:
            system.lock(stream.fileno())
        except BlockingIOError as error:
            raise JournalInUse(Message("is being written by a run that is still going on").at(file)) from error
        yield
