"""Opens every file that the program reads, and parses TOML and JSON.

Rule: opening never waits; only regular files are opened (and standard input, whatever it is); a read counts its bytes
and stops at its limit, whatever size the file system gives. A refusal is an OSError, as for any file that can't be
read; its ``strerror`` gives the reason.
"""

import errno
import io
import json
import os
import re
import stat
import tomllib
from pathlib import Path
from typing import Any

from drillctl.files import system
from drillctl.language import Message

Named = str | os.PathLike[str]
STANDARD_INPUT = 0  # its descriptor
KIB = 1024
CHUNK_BYTES = 1 << 20
MOST_KEY_PARTS = 32  # of a dotted TOML key: the parser takes the square of their number in time
_PART = r"""(?:[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*')"""
_LONG_KEY = re.compile(rf"(?:^|[\[{{,])[ \t]*(?:{_PART}[ \t]*\.[ \t]*){{{MOST_KEY_PARTS}}}", re.M)

_LONG_NUMBER = re.compile(r"0[xob][0-9A-Fa-f_]{1000}")  # Python reads these, but can't write them as decimal


def opened(file: Named, limit: int | None = None) -> io.BufferedReader:
    """Returns the file, open for reading; the caller closes it. With a ``limit`` in bytes, reading beyond it is an
    error.

    Raises OSError: EINVAL for a pipe, a device, a socket or an impossible name; EFBIG when the limit is passed; EISDIR
    for a folder; any other as ``open`` does.
    """
    try:
        check_kind(os.stat(file), file)  # a device may not even be touched; what is opened is looked at again
        handle = os.open(file, system.flags("O_RDONLY", "O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC"))
    except ValueError as error:  # a null character, or half of a surrogate pair
        raise OSError(errno.EINVAL, Message("no name that a file can have"), os.fspath(file)) from error
    try:
        check_kind(os.fstat(handle), file)
        system.unblocked(handle)
    except OSError:
        os.close(handle)
        raise
    plain = os.fdopen(handle, "rb", buffering=0)
    return io.BufferedReader(plain if limit is None else _Limited(plain, limit, os.fspath(file)))


def read_bytes(file: Named, limit: int, what: Message) -> bytes:
    """Returns all of a file. Raises OSError as ``opened``; a file of more than ``limit`` bytes is refused as not being
    ``what`` ("a table"), and no more than that is read.
    """
    data = bytearray()
    with opened(file) as stream:
        while len(data) <= limit and (chunk := stream.read(min(CHUNK_BYTES, limit + 1 - len(data)))):
            data += chunk
    if len(data) > limit:
        raise OSError(
            errno.EFBIG, Message("larger than {size}: not {what}", size=size_words(limit), what=what), os.fspath(file)
        )
    return bytes(data)


def read_start(file: Named, count: int) -> bytes:
    """Returns the first ``count`` bytes of a file, or fewer where it is shorter. Raises OSError as ``opened``."""
    with opened(file) as stream:
        return stream.read(count)


def toml_of(text: str) -> dict[str, Any]:
    """Returns a TOML text as plain tables, lists and values. Raises ValueError; for a fault of syntax
    ``tomllib.TOMLDecodeError``.
    """
    if found := _LONG_KEY.search(text):
        line = text.count("\n", 0, found.start()) + 1
        raise ValueError(Message("a key of more than {parts} parts in line {line}", parts=MOST_KEY_PARTS, line=line))
    if _LONG_NUMBER.search(text):
        raise ValueError(Message("a number of thousands of digits"))
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise ValueError(Message("nested too deeply")) from error
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:  # int() takes no more than a few thousand digits
        raise ValueError(Message("a number of thousands of digits")) from error


def json_of(text: str | bytes) -> Any:
    """Returns a JSON text as plain values. Raises ValueError, also for a text that is nested too deeply."""
    try:
        return json.loads(text)
    except RecursionError as error:
        raise ValueError(Message("nested too deeply")) from error


def check_kind(found: os.stat_result, file: Named) -> None:
    """Raises OSError for anything but a regular file or standard input."""
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), os.fspath(file))
    if not stat.S_ISREG(found.st_mode) and not _is_standard_input(found):
        raise OSError(errno.EINVAL, Message("a pipe or a device, not a file"), os.fspath(file))


def real_path(path: Named) -> Path:
    """Returns the path without links and dots. A loop of links and a name that can't be are returned as they are, so
    that opening them gives the error.
    """
    try:
        return Path(os.path.realpath(path))
    except ValueError:  # a null character, or half of a surrogate pair
        return Path(path)


def size_words(size_bytes: int) -> str:
    """Returns a size as people write it: 64 KiB, 256 MiB."""
    large = size_bytes >= KIB * KIB
    return f"{size_bytes // (KIB * KIB)} MiB" if large else f"{max(size_bytes // KIB, 1)} KiB"


class _Limited(io.RawIOBase):
    """A stream that raises an error where more than ``limit`` bytes come."""

    def __init__(self, plain: io.RawIOBase | io.FileIO, limit: int, name: str):
        self._plain, self._left, self._limit, self.name = plain, limit, limit, name

    def readable(self) -> bool:
        """Returns True, as io.RawIOBase wants of a stream that can be read."""
        return True

    def readinto(self, buffer: Any, /) -> int:
        """Reads as any raw stream; raises OSError when the limit is passed."""
        count = self._plain.readinto(buffer) or 0
        self._left -= count
        if self._left < 0:
            raise OSError(errno.EFBIG, Message("larger than {size}", size=size_words(self._limit)), self.name)
        return count

    def close(self) -> None:
        """Closes the file beneath it too."""
        self._plain.close()
        super().close()


def _is_standard_input(found: os.stat_result) -> bool:
    """Returns whether the file is standard input, by whatever name it was opened."""
    try:
        mine = os.fstat(STANDARD_INPUT)
    except OSError:  # closed
        return False
    return (found.st_dev, found.st_ino) == (mine.st_dev, mine.st_ino)
