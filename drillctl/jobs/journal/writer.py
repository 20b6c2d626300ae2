"""An open journal: a run writes into it what it is about to do, and what was done.

Rule: each line is on the disk before what it announces may happen, and is checked as a reader will check it.
"""

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from drillctl.files import system
from drillctl.jobs.journal.account import Account, Head, OutOfPlace
from drillctl.jobs.journal.chain import NO_SEAL, JournalError, sealed
from drillctl.jobs.journal.reader import (
    FORMAT,
    MAGIC,
    NAME,
    account_of,
    bytes_of,
    ended_well,
    read_journal,
    whole_bytes,
)
from drillctl.language import Message, message_of
from drillctl.viewmodel.jobs import Site


class Journal:
    """An open journal, locked: no second run may write or go on with it. Every method has its line on the disk when
    it returns. Raises JournalError; a file that holds anything worth keeping is left as it is then.
    """

    def __init__(self, file: Path, start_from: Head | Account, site: Site):
        """A Head begins a new journal, where there is none or one that is finished; an Account goes on with the one
        it was read from. The line that says so, and where, is written together with the first line that follows: a run
        that never came to move leaves the journal as it was.
        """
        self.file = file
        self._resumption: dict[str, Any] | None = None
        self._broken = False
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            new = ("O_CREAT",) if isinstance(start_from, Head) else ()
            flags = system.flags("O_RDWR", "O_APPEND", "O_CLOEXEC", *new)
            self._handle = os.open(file, flags, 0o644)
        except OSError as error:
            raise JournalError(Message("can't be written: {why}", why=message_of(error)).at(file)) from error
        try:
            self._lock()
            if isinstance(start_from, Account):
                self._account = self._go_on(start_from, site)
            else:
                self._account = self._begin(start_from, site)
        except BaseException:
            self.close()
            raise

    def begun(self, hole: int) -> None:
        """Writes that a hole is begun; to be called before the head may come down there."""
        self._write({"begun": hole})

    def done(self, holes: list[int]) -> None:
        """Writes that holes are done; to be called after execution has confirmed them."""
        for hole in holes:
            self._write({"done": hole})

    def suspect(self, holes: Sequence[int]) -> None:
        """Writes that holes which are done may be bad."""
        for hole in holes:
            self._write({"suspect": hole})

    def ended(self, how: str) -> None:
        """Writes how the run ended: ``done``, ``stopped`` or the name of a fault."""
        self._write({"ended": how})

    def close(self) -> None:
        """Closes the file and gives its lock up."""
        os.close(self._handle)

    def _begin(self, head: Head, site: Site) -> Account:
        _check_finished(self.file)
        self._cut(0)
        seal = self._append({NAME: FORMAT, **vars(head), "site": msgspec.structs.asdict(site)}, NO_SEAL)
        system.sync_folder(self.file.parent)
        return Account(head, site, seal=seal)

    def _go_on(self, account: Account, site: Site) -> Account:
        """Goes on with a journal. Raises JournalError where another run has written to it since it was read."""
        if read_journal(self.file) != account:
            raise JournalError(Message("another run has gone on with it meanwhile; resume again").at(self.file))
        self._resumption = {"resumed": msgspec.structs.asdict(site), "again": account.again}
        return replace(account, torn=False)

    def _lock(self) -> None:
        """Locks the file. The child processes of a paced run inherit the lock, which lasts until the last has ended."""
        try:
            system.lock(self._handle)
        except OSError as error:
            raise JournalError(Message("is being written by a run that is still going on").at(self.file)) from error

    def _write(self, line: Mapping[str, Any]) -> None:
        """Writes a line; before the first of a resumed run the line of its resumption, in place of a torn one."""
        if self._resumption is not None:
            self._cut(whole_bytes(bytes_of(self.file)))
            self._write_one(self._resumption)
            self._resumption = None
        self._write_one(line)

    def _write_one(self, line: Mapping[str, Any]) -> None:
        try:
            account = self._account.with_line(line)
        except OutOfPlace as error:
            raise JournalError(Message("not written: {why}", why=message_of(error)).at(self.file)) from error
        self._account = replace(account, seal=self._append(line, self._account.seal))

    def _append(self, line: Mapping[str, Any], before: str) -> str:
        """Appends a line and returns its seal. A line that is not on the disk whole is taken off again; where that
        fails too, nothing more is written.
        """
        if self._broken:
            raise JournalError(Message("can't be written: its last line is torn").at(self.file))
        data, seal = sealed(line, before)
        size_bytes = os.fstat(self._handle).st_size
        reason = Message("the disk is full")
        try:
            whole = os.write(self._handle, data) == len(data)
            os.fsync(self._handle)
        except OSError as error:
            whole, reason = False, message_of(error)
        if not whole:
            self._broken = True
            self._cut(size_bytes)
            self._broken = False
            raise JournalError(Message("can't be written: {why}", why=reason).at(self.file))
        return seal

    def _cut(self, size_bytes: int) -> None:
        try:
            os.ftruncate(self._handle, size_bytes)
            os.fsync(self._handle)
        except OSError as error:
            raise JournalError(Message("can't be written: {why}", why=message_of(error)).at(self.file)) from error


def _check_finished(file: Path) -> None:
    """Raises JournalError for a file that is not to be overwritten: an unfinished journal, or no journal at all."""
    data = bytes_of(file)
    if whole_bytes(data) == 0 or (data.startswith(MAGIC) and ended_well(data)):
        return
    account = account_of(data, file)
    if account.unfinished:
        raise JournalError(
            Message(
                "holds a job that is not finished: {file}, {done}; go on with `drillctl resume {journal}`, "
                "or delete the file to begin anew",
                done=account.share_done,
                file=account.head.job,
                journal=file,
            ).at(file)
        )

