"""The standard streams, whatever the caller made of them: closed, full, a pipe that nobody reads, a terminal gone.

Rule: what can't be told on standard error stops nothing, since a machine may be moving; what can't be told on standard
output is no success. Used by the command line and by the verbs that run a machine.
"""

import io
import os
import sys
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

UNTOLD = 1
STANDARD_ERROR = 2


class _Heedless(io.FileIO):
    """A stream that takes everything; what it can't hand on is lost."""

    def write(self, data: "ReadableBuffer", /) -> int:
        """Never raises."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


def prepare() -> None:
    """A stream that was closed is nowhere: else the next file opened got its number. Standard error grows heedless."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - open as long as we are
    standard = sys.__stderr__
    if standard is not None and sys.stderr is standard:
        raw = _Heedless(STANDARD_ERROR, "w", closefd=False)
        sys.stderr = io.TextIOWrapper(raw, standard.encoding, standard.errors, line_buffering=True, write_through=True)


def silence(*streams: TextIO) -> None:
    """What is still to be written, at exit too, goes nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in streams:
        os.dup2(nowhere, stream.fileno())


def delivered(code: int, text: str = "") -> int:
    """The exit code, once this and all before it is out: whether it can be shows now, not at exit.

    Raises BrokenPipeError.
    """
    try:
        print(text, end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        return untold(error, code)
    return code


def untold(error: OSError, code: int = 0) -> int:
    """The exit code of what was done and can't be told."""
    silence(sys.stdout)
    print(f"drillctl: standard output: {error.strerror}", file=sys.stderr)
    return code or UNTOLD
