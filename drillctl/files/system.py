"""What one operating system has and another lacks: locks on files, flags of open, signals, the terminal's errors.

Rule: only this module asks whether a system has fcntl or termios. Where it has none, machines are simulated all the
same: files are not locked, and what needs a real port, real pace or a terminal's keys is refused where it is asked for.
"""

import os
import signal
from contextlib import suppress
from pathlib import Path
from typing import Any

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]  # a module where there is one
try:
    import termios
except ImportError:
    termios = None  # type: ignore[assignment]  # likewise

HAS_LOCKS = fcntl is not None
RENAMES_OPEN_FILES = hasattr(os, "O_DIRECTORY")  # as POSIX systems do
TERMINAL_ERRORS: tuple[type[Exception], ...] = (OSError,) if termios is None else (OSError, termios.error)


def flags(*names: str) -> int:
    """Returns flags of ``os.open`` by their names; those that the system lacks count nothing. Bytes are never changed
    on the way (O_BINARY, where text is another thing).
    """
    found = getattr(os, "O_BINARY", 0)
    for name in names:
        found |= getattr(os, name, 0)
    return int(found)


def signals(*names: str) -> tuple[signal.Signals, ...]:
    """Returns the signals of these names that the system has."""
    return tuple(getattr(signal, name) for name in names if hasattr(signal, name))


def lock(handle: int, wait: bool = False) -> None:
    """Locks an open file for as long as this description of it is open in any process; does nothing where the system
    has no locks. Raises BlockingIOError where another process holds it and ``wait`` is false; OSError for a file system
    without locks.
    """
    if fcntl is not None:
        fcntl.flock(handle, fcntl.LOCK_EX if wait else fcntl.LOCK_EX | fcntl.LOCK_NB)


def is_own(found: os.stat_result) -> bool:
    """Returns whether a file is this user's; where the system has no such numbers, what can be opened is."""
    return not hasattr(os, "geteuid") or found.st_uid == os.geteuid()


def unblocked(handle: int) -> None:
    """Lets reads of a file wait again that was opened with O_NONBLOCK."""
    if hasattr(os, "O_NONBLOCK"):
        os.set_blocking(handle, True)


def open_folder(path: Path) -> int:
    """Returns a handle of a folder; -1 where folders can't be opened. Raises OSError."""
    if not hasattr(os, "O_DIRECTORY"):
        return -1
    return os.open(path, flags("O_RDONLY", "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC"))


def sync_folder(path: Path) -> None:
    """Writes a folder's names to the disk: the new place of a file is among them. Raises OSError."""
    handle = open_folder(path)
    if handle >= 0:
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def give_usual_rights(handle: int) -> None:
    """Gives a new file the rights that files have here by default, by the process's mask."""
    if hasattr(os, "fchmod"):
        mask = os.umask(0)
        os.umask(mask)
        os.fchmod(handle, 0o666 & ~mask)


def end_group(pid: int) -> None:
    """Ends a process and all that it has started in its session."""
    with suppress(ProcessLookupError):
        if hasattr(os, "killpg"):
            os.killpg(pid, signal.SIGKILL)
        else:
            os.kill(pid, signal.SIGTERM)  # which ends it at once on Windows


def terminal() -> Any:
    """Returns the module termios. Raises OSError where the system has none."""
    if termios is None:
        raise OSError("this system's terminals give no single keys")
    return termios
