"""A folder of journals: the jobs in it that were cut off, and giving one of them up.

Rule: a journal that a run still writes belongs to that run; it is neither offered nor taken away. Called by station
and by the resume verb.
"""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drillctl.generation.journal import Account, JournalError, read_journal
from drillctl.inputs import opened

MOST_LOOKED_AT = 20
LAST_LINE_BYTES = 64
FINISHED = b'{"ended": "done"}\n'


def unfinished(folder: Path) -> list[tuple[Path, Account]]:
    """Those that can be gone on with, the newest first; damaged ones and those in use are passed over."""
    found = []
    for file in _newest(folder):
        try:
            if not _ended_well(file) and (account := _read(file)).unfinished:
                found.append((file, account))
        except (OSError, JournalError):
            continue
    return found


def give_up(file: Path) -> None:
    """The job is not gone on with: its journal goes. Raises JournalError."""
    try:
        with _alone(file):
            file.unlink()
    except OSError as error:
        raise JournalError(f"{file}: can't be taken away: {error.strerror}") from error


def _newest(folder: Path) -> list[Path]:
    try:
        found = [entry for entry in os.scandir(folder) if entry.name.endswith(".journal")]
        dated = [(entry.stat().st_mtime, Path(entry)) for entry in found]
    except OSError:
        return []
    return [file for _, file in sorted(dated, reverse=True)[:MOST_LOOKED_AT]]


def _ended_well(file: Path) -> bool:
    """Told by its last line alone, so that finished journals cost nothing."""
    with opened(file) as stream:
        stream.seek(max(0, os.fstat(stream.fileno()).st_size - LAST_LINE_BYTES))
        return stream.read(LAST_LINE_BYTES).endswith(FINISHED)


def _read(file: Path) -> Account:
    with _alone(file):
        return read_journal(file)


@contextmanager
def _alone(file: Path) -> Iterator[None]:
    """As long as nobody writes it; lets go of it afterwards. Raises JournalError, OSError."""
    with opened(file) as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise JournalError(f"{file}: is being written by a run that is still going on") from error
        yield
