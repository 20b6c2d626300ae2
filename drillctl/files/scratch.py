"""Files and folders that live as long as the run that made them, and the removal of those that a killed run left.

Rule: a new file is made with O_EXCL and O_NOFOLLOW, so it is never somebody else's, nor the target of a link. It stays
locked (flock) while any process of its run lives. ``sweep`` and ``sweep_folders`` remove only what carries our mark,
belongs to this user, and is not locked.
"""

import os
import secrets
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from drillctl.files import system

MARK = ".drillctl-tmp"  # how the name of a file ends that is not yet whole
FOLDERS = "drillctl-run-"
KEPT_IN_FOLDERS = "status"  # what a run keeps in its folder, beside files with the mark
LONGEST_STEM = 100  # characters of the name that the file is made for
MOST_TRIES = 100
_NEW = system.flags("O_RDWR", "O_CREAT", "O_EXCL", "O_NOFOLLOW", "O_CLOEXEC")
_LOOK = system.flags("O_RDONLY", "O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC")


def make_file(place: Path) -> tuple[int, Path]:
    """Makes an empty file beside ``place``, for its owner alone; returns a locked descriptor and its path. Raises
    OSError.
    """
    for _ in range(MOST_TRIES):
        path = place.with_name(f".{place.name[:LONGEST_STEM]}.{secrets.token_hex(4)}{MARK}")
        with suppress(FileExistsError):
            handle = os.open(path, _NEW, 0o600)
            lock(handle)
            if os.fstat(handle).st_nlink:  # none: it was swept before it was locked
                return handle, path
            os.close(handle)
    raise FileExistsError(f"{place}: {MOST_TRIES} names beside it are taken")


def lock(handle: int) -> None:
    """Locks a file for as long as this description is open in any process. Does nothing on a file
    system without locks.
    """
    with suppress(OSError):
        system.lock(handle, wait=True)


def sweep(folder: Path, pattern: str = f".*{MARK}") -> None:
    """Removes the files of a folder that killed runs have left. Files that can't be opened or removed stay."""
    with suppress(OSError):
        for file in folder.glob(pattern):
            _remove_left(file)


class Folder:
    """A folder for one run, for its owner alone. ``close`` removes it with its files. Raises OSError."""

    def __init__(self) -> None:
        sweep_folders()
        for _ in range(MOST_TRIES):
            self.path = Path(tempfile.mkdtemp(prefix=FOLDERS))
            with suppress(FileNotFoundError):  # it was swept before it was locked
                self._handle = system.open_folder(self.path)
                if self._handle < 0:  # a system that opens no folders; nothing is swept there either
                    return
                lock(self._handle)
                if _is_at(self.path, os.fstat(self._handle)):
                    return
                os.close(self._handle)
        raise FileExistsError(f"{self.path}: no folder of that kind stays")

    def close(self) -> None:
        """Removes the folder. More than one call is allowed."""
        if self._handle >= 0:
            _remove_folder(self.path, self._handle)
            os.close(self._handle)
            self._handle = -1

    def __enter__(self) -> Path:
        return self.path

    def __exit__(self, *_: object) -> None:
        self.close()


def sweep_folders() -> None:
    """Removes the folders that killed runs have left where the system keeps temporary files."""
    for folder in Path(tempfile.gettempdir()).glob(f"{FOLDERS}*"):
        with suppress(OSError):
            handle = system.open_folder(folder)
            try:
                if handle >= 0 and _is_left(handle):
                    _remove_folder(folder, handle)
            finally:
                os.close(handle)


def _remove_left(file: Path) -> None:
    with suppress(OSError):
        handle = os.open(file, _LOOK)
        try:
            if stat.S_ISREG(os.fstat(handle).st_mode) and _is_left(handle) and _is_at(file, os.fstat(handle)):
                file.unlink()
        finally:
            os.close(handle)


def _is_left(handle: int) -> bool:
    """Returns whether the file is this user's and no process holds its lock; it is locked from here on, until the
    handle is closed.
    """
    if not system.HAS_LOCKS or not system.is_own(os.fstat(handle)):
        return False
    try:
        system.lock(handle)
    except OSError:  # held, or a file system that knows no locks: nobody can say that its run is over
        return False
    return True


def _is_at(path: Path, found: os.stat_result) -> bool:
    """Returns whether the path still leads to the file or folder with this ``stat``."""
    return os.path.samestat(path.lstat(), found)


def _remove_folder(folder: Path, handle: int) -> None:
    """Removes the files that a run keeps in its folder, and the folder unless anything else is in it."""
    with suppress(OSError):
        for name in os.listdir(handle):
            if name == KEPT_IN_FOLDERS or name.endswith(MARK):
                os.unlink(name, dir_fd=handle)
        folder.rmdir()
