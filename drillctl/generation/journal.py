"""The job's journal: what was to be drilled, and each hole begun and done as execution confirmed it.

Rule: append-only, one JSON object a line, synced before what it announces may happen; never rewritten. A torn last
line (the power went) is left out and said; any other damage refuses the journal. Called by desk and resume.
"""

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from drillctl.generation.job import Job

FORMAT = 1
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


class Journal:
    """An open journal. Every method has the line on the disk when it returns. Raises JournalError."""

    def __init__(self, file: Path, head: Head | None):
        """``head`` begins a new journal in place of an old one; None goes on with the one that is there."""
        self.file = file
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            flags = os.O_WRONLY | os.O_APPEND | os.O_CLOEXEC | (os.O_CREAT | os.O_TRUNC if head else 0)
            self._handle = os.open(file, flags, 0o644)
        except OSError as error:
            raise JournalError(f"{file}: can't be written: {error.strerror}") from error
        if head is not None:
            self._append({"drillctl-journal": FORMAT, **vars(head)})

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
        """Nothing more is written."""
        os.close(self._handle)

    def _append(self, line: dict[str, Any]) -> None:
        data = json.dumps(line).encode() + b"\n"
        try:
            written = os.write(self._handle, data)
            os.fsync(self._handle)
        except OSError as error:
            raise JournalError(f"{self.file}: can't be written: {error.strerror}") from error
        if written != len(data):
            raise JournalError(f"{self.file}: can't be written: the disk is full")


def read_journal(file: Path) -> Account:
    """What a journal says. Raises JournalError; nothing is guessed."""
    lines, torn = _lines(file)
    account = Account(_head(file, lines[0] if lines else None), torn=torn)
    for number, line in enumerate(lines[1:], start=2):
        for key, value in line.items():
            if key in ("begun", "done") and isinstance(value, int) and 1 <= value <= account.head.holes:
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
        file_digest = hashlib.sha256(file.read_bytes()).hexdigest()
    except OSError as error:
        raise JournalError(f"{file}: can't be read: {error.strerror}") from error
    program_digest = hashlib.sha256(job.program.tobytes()).hexdigest()
    machine = job.machine
    where = str(file.resolve())
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


def _lines(file: Path) -> tuple[list[dict[str, Any]], bool]:
    try:
        if file.stat().st_size > LARGEST_JOURNAL_BYTES:
            raise JournalError(f"{file}: larger than {LARGEST_JOURNAL_BYTES >> 20} MiB: not a journal")
        whole, _, rest = file.read_bytes().rpartition(b"\n")
    except OSError as error:
        raise JournalError(f"{file}: can't be read: {error.strerror}") from error
    found = []
    for number, line in enumerate(whole.split(b"\n") if whole else [], start=1):
        try:
            parsed = json.loads(line)
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
