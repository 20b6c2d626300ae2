"""Keeps the magazine record while a job runs: what each command of its program does to the tools, in order.

Rule: a transfer is noted before its first command may be sent, and as done once the command that confirms it is; holes
are counted for the tool that made them, and a tool whose bit was found broken is noted as that. Called by the runner at
every turn.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.generation import sequences
from drillctl.generation.eight_axis.magazine import Magazine, Transfer
from drillctl.generation.eight_axis.transfers import transfers
from drillctl.generation.job import Job
from drillctl.generation.sequences import Change, Records
from drillctl.jobs.magazine import MagazineFile, default_file
from drillctl.kmd import Fault, Op

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
        self._job = job
        self._broken = False

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

    def done(self, commands: int, fault: int) -> None:
        """Notes what so many commands have done, and the fault of the one behind them, 0 for none. Raises
        MagazineError.
        """
        magazine = self._kept.magazine
        while self._at < len(self._events) and self._events[self._at].done <= commands:
            event = self._events[self._at]
            magazine = _after(magazine, event)
            self._under_way &= event.transfer is None
            self._at += 1
        if fault == Fault.BIT_BROKEN and not self._broken:
            self._broken, tool = True, _tools(self._job)[commands]
            magazine = magazine.broken(int(tool)) if tool else magazine
        if magazine != self._kept.magazine:
            self._kept.keep(magazine)


def last_of_bit(program: Records, commands: int) -> int | None:
    """Returns the last hole, in the order of a program and from 1, that was done with the bits that are in the chucks
    once so many commands are done; None for none. Each stroke looks whether its bits are whole as they meet the board,
    so no earlier hole can be bad where one has broken.
    """
    changes = np.flatnonzero(program["opcode"][:commands] == Op.NARZEDZIE)
    _, ends = sequences.holes(program)
    done = int(np.searchsorted(ends, commands, side="right"))
    since = changes[-1] if len(changes) else 0
    return done if done and ends[done - 1] > since else None


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
    tools = _tools(job)[begins].tolist()
    return [_Event(end, hit=tool) for end, tool in zip(ends.tolist(), tools, strict=True) if tool]


def _tools(job: Job) -> NDArray[np.int64]:
    """The tool of the machine in each command, (n,): the one that was noted last; 0 for none."""
    changes = job.program["opcode"] == Op.NARZEDZIE
    latest = np.maximum.accumulate(np.where(changes, np.arange(len(changes)), -1))
    tools: NDArray[np.int64] = np.where(latest < 0, 0, job.program["args"][latest, 2])
    return tools
