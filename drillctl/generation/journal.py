"""The job's journal: what was to be drilled, and each hole begun and done as execution confirmed it.

Rule: append-only, one JSON object a line, synced before what it announces may happen; never rewritten. A torn last
line (the power went) is left out and said; any other damage refuses the journal. Called by desk and resume.
"""

import fcntl
import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from drillctl.generation.job import Job
from drillctl.inputs import json_of, opened, read_bytes, real_path

FORMAT = 1
MAGIC = b'{"drillctl-journal": '  # how the first line begins
LARGEST_JOURNAL_BYTES = 256 * 1024 * 1024


class JournalError(Exception):
    """A journal that can't be read, written or believed. ``str()`` is ``FILE:LINE: reason`` or ``FILE: reason``."""


@dataclass(frozen=True)
class Head:
    """The first line: enough to build the same job again, and to see that it is the same.

    file_digest     of the drill file; program_digest: of what was made from it, placing and order included
    options         of the command line that made the job, by name
    """

    job: str
    file_digest: str
    program_digest: str
    machine: str
    machine_digest: str
    holes: int
    options: Mapping[str, Any]


@dataclass
class Account:
    """What a journal says: holes by their number from 1. ``open`` are begun and not done: drilled again, and named."""

    head: Head
    done: set[int] = field(default_factory=set)
    begun: set[int] = field(default_factory=set)
    ended: str | None = None
    torn: bool = False

    @property
    def open(self) -> list[int]:
        """Holes that were cut off in the middle."""
        return sorted(self.begun - self.done)

    @property
    def unfinished(self) -> bool:
        """Something was begun, and not all is done."""
        return bool(self.begun) and len(self.done) < self.head.holes


class Journal:
    """An open journal, locked: no second run may write or go on with it. Every method has its line on the disk when
    it returns. Raises JournalError; a file that holds anything worth keeping is left as it is then.
    """

    def __init__(self, file: Path, known: Head | Account):
        """A Head begins a new journal, where there is none or one that is finished; an Account goes on with the one
        it was read from.
        """
        self.file = file
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            flags = os.O_RDWR | os.O_APPEND | os.O_CLOEXEC | (os.O_CREAT if isinstance(known, Head) else 0)
            self._handle = os.open(file, flags, 0o644)
        except OSError as error:
            raise JournalError(f"{file}: can't be written: {error.strerror}") from error
        try:
            self._lock()
            if isinstance(known, Account):
                self._go_on(known)
            else:
                self._begin(known)
        except BaseException:
            self.close()
            raise

    def begun(self, hole: int) -> None:
        """Before the head may come down at a hole."""
        self._append({"begun": hole})

    def done(self, holes: list[int]) -> None:
        """Execution has confirmed these."""
        for hole in holes:
            self._append({"done": hole})

    def ended(self, how: str) -> None:
        """The run is over: ``done``, ``stopped`` or a fault's name."""
        self._append({"ended": how})

    def close(self) -> None:
        """Nothing more is written; the lock goes with it."""
        os.close(self._handle)

    def _begin(self, head: Head) -> None:
        _check_finished(self.file)
        self._cut(0)
        self._append({"drillctl-journal": FORMAT, **vars(head)})
        _sync_folder(self.file.parent)

    def _go_on(self, account: Account) -> None:
        """What was read before the lock was had must still hold; a torn line goes."""
        if read_journal(self.file) != account:
            raise JournalError(f"{self.file}: another run has gone on with it meanwhile; resume again")
        self._cut(_whole_bytes(self.file))

    def _lock(self) -> None:
        """The children of a paced run inherit it: it lasts until the last of them has ended."""
        try:
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise JournalError(f"{self.file}: is being written by a run that is still going on") from error

    def _append(self, line: dict[str, Any]) -> None:
        """A line that does not fit whole is taken back, so that the journal ends as it did."""
        data = json.dumps(line).encode() + b"\n"
        size_bytes = os.fstat(self._handle).st_size
        try:
            whole = os.write(self._handle, data) == len(data)
            os.fsync(self._handle)
        except OSError as error:
            raise JournalError(f"{self.file}: can't be written: {error.strerror}") from error
        if not whole:
            self._cut(size_bytes)
            raise JournalError(f"{self.file}: can't be written: the disk is full")

    def _cut(self, size_bytes: int) -> None:
        try:
            os.ftruncate(self._handle, size_bytes)
            os.fsync(self._handle)
        except OSError as error:
            raise JournalError(f"{self.file}: can't be written: {error.strerror}") from error


def read_journal(file: Path) -> Account:
    """What a journal says. Raises JournalError; nothing is guessed."""
    lines, torn = _lines(file)
    account = Account(_head(file, lines[0] if lines else None), torn=torn)
    for number, line in enumerate(lines[1:], start=2):
        for key, value in line.items():
            if key in ("begun", "done") and type(value) is int and 1 <= value <= account.head.holes:
                getattr(account, key).add(value)
                account.ended = None
            elif key == "ended" and isinstance(value, str):
                account.ended = value
            else:
                raise JournalError(f"{file}:{number}: {key} {value!r} is nothing that a journal holds")
    return account


def head_of(file: Path, job: Job, options: Mapping[str, Any]) -> Head:
    """The first line for a job that was made from a file. Raises JournalError where that can't be read."""
    try:
        with opened(file) as stream:
            file_digest = hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        raise JournalError(f"{file}: can't be read: {error.strerror}") from error
    program_digest = hashlib.sha256(job.program.tobytes()).hexdigest()
    machine = job.machine
    where = str(real_path(file))
    return Head(where, file_digest, program_digest, machine.name, machine.digest, job.holes_total, options)


def check_same(journal: Path, then: Head, now: Head) -> None:
    """Raises JournalError unless the job made now is the one that the journal began with."""
    compared = (
        ("file_digest", f"{then.job} has changed since the job was begun"),
        ("machine_digest", f"machine {then.machine} is not the one that the job was begun on"),
        ("program_digest", "the placing, the order or a table beside the job has changed since it was begun"),
    )
    for name, reason in compared:
        if getattr(then, name) != getattr(now, name):
            raise JournalError(f"{journal}: {reason}; what is left of it can't be told")


def _check_finished(file: Path) -> None:
    """Raises JournalError for a file that is not to be overwritten: an unfinished journal, or no journal at all."""
    if _whole_bytes(file) == 0:
        return
    account = read_journal(file)
    if account.unfinished:
        raise JournalError(
            f"{file}: holds a job that is not finished: {len(account.done)} of {account.head.holes} holes of "
            f"{account.head.job} are drilled; go on with `drillctl resume {file}`, or delete the file to begin anew"
        )


def _whole_bytes(file: Path) -> int:
    """Up to the end of the last line that is whole. A beginning of ours that was cut off in its first line is none."""
    data = _bytes(file)
    whole = data.rfind(b"\n") + 1
    return whole if whole or data.startswith(MAGIC) else len(data)


def _sync_folder(folder: Path) -> None:
    """A new file's name is on the disk only when its folder is."""
    handle = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _bytes(file: Path) -> bytes:
    try:
        return read_bytes(file, LARGEST_JOURNAL_BYTES, "a journal")
    except OSError as error:
        raise JournalError(f"{file}: can't be read: {error.strerror}") from error


def _lines(file: Path) -> tuple[list[dict[str, Any]], bool]:
    whole, _, rest = _bytes(file).rpartition(b"\n")
    found = []
    for number, line in enumerate(whole.split(b"\n") if whole else [], start=1):
        try:
            parsed = json_of(line)
        except ValueError:
            parsed = None
        if not isinstance(parsed, dict):
            raise JournalError(f"{file}:{number}: damaged: not a line of a journal")
        found.append(parsed)
    return found, bool(rest)


def _head(file: Path, line: dict[str, Any] | None) -> Head:
    if line is None or line.pop("drillctl-journal", None) != FORMAT:
        raise JournalError(f"{file}: not a journal of this program")
    try:
        head = Head(**line)
    except TypeError as error:
        raise JournalError(f"{file}:1: damaged: its first line is not whole") from error
    if not (isinstance(head.holes, int) and isinstance(head.job, str) and isinstance(head.options, dict)):
        raise JournalError(f"{file}:1: damaged: its first line is not whole")
    return head
