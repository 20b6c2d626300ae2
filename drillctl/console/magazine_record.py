"""The magazine record of the machine in use, for its screen: read again when its file has changed.

Rule: the file alone says what is known; whoever runs a job changes it (jobs/magazine.py). Where nothing is kept yet
nothing is shown.
"""

from collections.abc import Callable
from pathlib import Path

from drillctl.generation.eight_axis.magazine import Magazine
from drillctl.jobs.magazine import MagazineError, MagazineFile, default_file
from drillctl.jobs.session import journals
from drillctl.language import Message
from drillctl.machine import Machine

Stamp = tuple[int, int, int]  # of a file: its number, when it was changed, its size


class MagazineRecord:
    """``of`` returns the record of a machine; ``folder`` is where records are kept."""

    def __init__(self, folder: Callable[[], Path] = journals):
        self._folder = folder
        self._read: tuple[Machine, Stamp] | None = None
        self._found: tuple[Magazine | None, Message | None] = (None, None)

    def of(self, machine: Machine) -> tuple[Magazine | None, Message | None]:
        """The record, None where none is kept, and why it can't be read where it can't."""
        file = default_file(self._folder(), machine)
        stamp = _stamp(file)
        if stamp is None:
            return None, None
        if self._read is None or self._read[0] is not machine or self._read[1] != stamp:
            self._read, self._found = (machine, stamp), _read(file, machine)
        return self._found


def _read(file: Path, machine: Machine) -> tuple[Magazine | None, Message | None]:
    try:
        return MagazineFile(file, machine).magazine, None
    except MagazineError as error:
        return None, error.message


def _stamp(file: Path) -> Stamp | None:
    """What changes with the file; None where there is none."""
    try:
        found = file.stat()
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size
