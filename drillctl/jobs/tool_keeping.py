"""Keeps the magazine record while a job runs: what each command of its program does to the tools, in order.

Rule: a transfer is noted before its first command may be sent, and as done once the command that confirms it is; holes
are counted for the tool that made them. Called by the runner at every turn.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from drillctl.generation import sequences
from drillctl.generation.eight_axis.magazine import Magazine, Transfer
from drillctl.generation.eight_axis.transfers import transfers
from drillctl.generation.job import Job
from drillctl.generation.sequences import Change
from drillctl.jobs.magazine import MagazineFile, default_file
from drillctl.kmd import Op

AHEAD = 2  # commands: the move that brings the chucks there, and the KMD_KROK behind it


class _Event(NamedTuple):
    """What is known once so many commands are done: a transfer has ended, a tool was renewed, a tool made a hole."""

    done: int
    transfer: Transfer | None = None
    renewed: int = 0
    hit: int = 0


class ToolKeeping:
    """The record of one job's machine. ``barriers`` are the indexes of the commands that begin a transfer."""

    def __init__(self, job: Job, kept: MagazineFile):
        self._kept = kept
        moved = list(transfers(job.program, job.machine))
        self.barriers = [each.begin for each in moved]
        self._next = list(moved)
        self._under_way = False
        self._events = sorted(
            [_Event(each.end, transfer=each.transfer) for each in moved] + _changes(job) + _hits(job),
            key=lambda event: event.done,
        )
        self._at = 0

    @property
    def file(self) -> Path:
        """The file of the record."""
        return self._kept.file

    def is_due(self, commands: int) -> bool:
        """Whether the next transfer is to be noted as begun, once so many commands are done: the last one has ended,
        and of the commands before it all but the one that is carried out and its step's.
        """
        return not self._under_way and commands >= self._next[0].begin - AHEAD

    def begin(self) -> None:
        """Notes that the next transfer begins; to be called before its first command is sent. Raises MagazineError."""
        self._kept.keep(self._kept.magazine.begun(self._next[0].transfer))
        self._next.pop(0)
        self._under_way = True

    def done(self, commands: int) -> None:
        """Notes what so many commands have done. Raises MagazineError."""
        magazine = self._kept.magazine
        while self._at < len(self._events) and self._events[self._at].done <= commands:
            event = self._events[self._at]
            magazine = _after(magazine, event)
            self._under_way &= event.transfer is None
            self._at += 1
        if magazine != self._kept.magazine:
            self._kept.keep(magazine)


def with_tools(job: Job, folder: Path) -> tuple[Job, ToolKeeping | None]:
    """Returns a board's job with the tools where the machine's record in ``folder`` has them, and what keeps the
    record; the job itself and None on a machine without a magazine. Raises MagazineError, and JobError where the job
    can't be done with these tools.
    """
    if job.machine.parameters is None or job.work is None:
        return job, None
    kept = MagazineFile(default_file(folder, job.machine), job.machine)
    job = job.equipped(kept.magazine)
    return job, ToolKeeping(job, kept)


def _after(magazine: Magazine, event: _Event) -> Magazine:
    if event.transfer is not None:
        return magazine.ended(event.transfer)
    return magazine.renew(event.renewed) if event.renewed else magazine.hit(event.hit, 1)


def _changes(job: Job) -> list[_Event]:
    """The bits that an operator puts in for a tool of the machine."""
    rows = sequences.asked_changes(job.program)
    args = job.program["args"][rows]
    renewed = zip(rows.tolist(), args[:, 1].tolist(), args[:, 2].tolist(), strict=True)
    return [_Event(row + 1, renewed=tool) for row, change, tool in renewed if tool and change & Change.RENEWED]


def _hits(job: Job) -> list[_Event]:
    """The holes, each by the tool that was noted last before it."""
    begins, ends = sequences.holes(job.program)
    changes = np.flatnonzero(job.program["opcode"] == Op.NARZEDZIE)
    if not len(changes):
        return []
    last = changes[np.searchsorted(changes, begins, side="right") - 1]
    tools = job.program["args"][last, 2].tolist()
    return [_Event(end, hit=tool) for end, tool in zip(ends.tolist(), tools, strict=True) if tool]
