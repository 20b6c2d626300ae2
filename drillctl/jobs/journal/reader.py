"""Reads a journal file, and makes the first line of a new one.

Rule: every line must be in its chain and its place, or the journal is refused.
"""

import hashlib
import re
from collections.abc import Mapping
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import opened, read_bytes, real_path
from drillctl.generation.job import Job
from drillctl.jobs.journal.account import Account, Head, OutOfPlace, head_of_line, site_of_line
from drillctl.jobs.journal.chain import NO_SEAL, Damaged, JournalError, unsealed
from drillctl.language import Message, message_of

FORMAT = 2
NAME = "drillctl-journal"
MAGIC = b'{"drillctl-journal": '  # how the first line begins
VERSION = re.compile(rb'\{"drillctl-journal": (\d{1,9}), ')
FINISHED = re.compile(rb'\{"ended": "done"(, "chain": "[0-9a-f]{16}")?\}\n')  # the last line, of version 1 too
LAST_LINE_BYTES = 64
EIGHT_AXES_BYTES = 52  # of a record with eight arguments
LARGEST_JOURNAL_BYTES = 256 * 1024 * 1024


def read_journal(file: Path) -> Account:
    """Reads a journal. Raises JournalError for one that is damaged anywhere but in a torn last line."""
    return account_of(bytes_of(file), file)


def account_of(data: bytes, file: Path) -> Account:
    """Reads the bytes of a journal; ``file`` is named in errors. Raises JournalError."""
    lines = BytesIO(data)  # one after the other: a list of many short ones would take many times the file
    first = lines.readline()
    account = _begun(first[:-1] if first.endswith(b"\n") else b"", file)
    for number, line in enumerate(lines, start=2):
        if not line.endswith(b"\n"):
            return replace(account, torn=True)
        try:
            content, seal = unsealed(line[:-1], account.seal)
            account = replace(account.with_line(content), seal=seal)
        except Damaged as error:
            raise JournalError(
                Message("damaged: not what was written behind the line above").at(file, number)
            ) from error
        except OutOfPlace as error:
            raise JournalError(error.message.at(file, number)) from error
    return account


def whole_bytes(data: bytes) -> int:
    """How many bytes the whole lines have; 0 for a journal that was cut off in its first line."""
    whole = data.rfind(b"\n") + 1
    return whole if whole or data.startswith(MAGIC) else len(data)


def ended_well(data: bytes) -> bool:
    """Whether a journal, or the end of one, ends as a finished job's does, whichever version wrote it."""
    return FINISHED.fullmatch(data[data.rfind(b"\n", 0, len(data) - 1) + 1 :]) is not None


def bytes_of(file: Path) -> bytes:
    """The bytes of a journal file. Raises JournalError where it can't be read."""
    try:
        return read_bytes(file, LARGEST_JOURNAL_BYTES, Message("a journal"))
    except OSError as error:
        raise JournalError(Message("can't be read: {why}", why=message_of(error)).at(file)) from error


def head_of(file: Path, job: Job, options: Mapping[str, Any]) -> Head:
    """The first line for a job that was made from a file. Raises JournalError where that can't be read."""
    try:
        with opened(file) as stream:
            file_digest = hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        raise JournalError(Message("can't be read: {why}", why=message_of(error)).at(file)) from error
    program_digest = hashlib.sha256(_records_of(job.program)).hexdigest()
    machine = job.machine
    where = str(real_path(file))
    return Head(where, file_digest, program_digest, machine.name, machine.digest, job.holes_total, options)


def _records_of(program: NDArray[np.void]) -> bytes:
    """The records of a program without the arguments of axes past the eighth, where none is used: journals of the time
    when a record had room for eight axes keep their digest.
    """
    rows = np.ascontiguousarray(program).view(np.uint8).reshape(len(program), -1)
    return (rows if rows[:, EIGHT_AXES_BYTES:].any() else rows[:, :EIGHT_AXES_BYTES]).tobytes()


def check_same(journal: Path, then: Head, now: Head) -> None:
    """Raises JournalError unless the job made now is the one that the journal began with."""
    compared = (
        ("file_digest", Message("{file} has changed since the job was begun", file=then.job)),
        ("machine_digest", Message("machine {name} is not the one that the job was begun on", name=then.machine)),
        ("program_digest", Message("the placing, the order or a table beside the job has changed since it was begun")),
        ("holes", Message("the placing, the order or a table beside the job has changed since it was begun")),
    )
    for name, reason in compared:
        if getattr(then, name) != getattr(now, name):
            raise JournalError(Message("{why}; it can't be known what is left of it", why=reason).at(journal))


def _begun(line: bytes, file: Path) -> Account:
    """The account of a journal that has only this first line. Raises JournalError."""
    version = VERSION.match(line)
    if version is None:
        raise JournalError(Message("not a journal of this program").at(file))
    if int(version[1]) != FORMAT:
        raise JournalError(
            Message(
                "a journal of version {version}, and this program goes on with those of version {format}; go on with "
                "the drillctl that wrote it, or delete the file to begin the board anew",
                version=int(version[1]),
                format=FORMAT,
            ).at(file)
        )
    try:
        content, seal = unsealed(line, NO_SEAL)
        del content[NAME]
        return Account(site=site_of_line(content.pop("site", None)), head=head_of_line(content), seal=seal)
    except Damaged as error:
        raise JournalError(Message("damaged: its first line is not the one that was written").at(file, 1)) from error
    except OutOfPlace as error:
        raise JournalError(Message("damaged: {why}", why=message_of(error)).at(file, 1)) from error
