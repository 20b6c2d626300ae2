"""The standard streams, whatever the caller made of them: closed, full, a pipe that nobody reads, a terminal gone.

Rule: what can't be told on standard error stops nothing, since a machine may be moving; what can't be told on standard
output is no success. Whatever is written, the reader's terminal only prints it: every character that it would obey is
escaped here, once, for all verbs (``drillctl.language``). Used by the command line and by the verbs that run a machine.
"""

import io
import os
import sys
from typing import TYPE_CHECKING, TextIO, cast

from drillctl.language import LINES, visible

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

UNTOLD = 1
STANDARD_ERROR = 2
RETURN = "\r"  # a bar of tqdm begins its line anew with it


class _Heedless(io.FileIO):
    """A stream that takes everything; what it can't hand on is lost."""

    def write(self, data: "ReadableBuffer", /) -> int:
        """Never raises."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


class Printed(io.TextIOWrapper):
    """A text stream that escapes what is no printed character, a line end or a tab; and what its encoding has not."""

    def write(self, text: str, /) -> int:
        """Escaped; returns how many characters were handed in."""
        super().write(visible(text, LINES))
        return len(text)

    def write_as_it_is(self, text: str) -> None:
        """Not escaped: for what this program made of control characters itself, and of escaped words."""
        super().write(text)


class _Bar:
    """What tqdm needs of a stream; it may begin its line anew."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self.encoding, self.fileno = stream.encoding, stream.fileno
        self.isatty, self.flush = stream.isatty, stream.flush

    def write(self, text: str) -> None:
        as_it_is(self._stream, visible(text, LINES + RETURN))


def prepare() -> None:
    """A stream that was closed is nowhere: else the next file opened got its number. Standard error grows heedless."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - open as long as we are
    standard = sys.__stderr__
    if standard is not None and sys.stderr is standard:
        raw = _Heedless(STANDARD_ERROR, "w", closefd=False)
        sys.stderr = Printed(raw, standard.encoding, "backslashreplace", line_buffering=True, write_through=True)
    standard = sys.__stdout__
    if standard is not None and sys.stdout is standard:
        to_the_end = open(standard.fileno(), "wb", closefd=False)  # noqa: SIM115 - open as long as we are
        sys.stdout = Printed(to_the_end, standard.encoding, "backslashreplace", line_buffering=standard.line_buffering)


def bar(stream: TextIO) -> TextIO:
    """The stream as a progress bar may have it: it may return to the start of its line.

    A bar has no foreign words in it.
    """
    return cast(TextIO, _Bar(stream))


def as_it_is(stream: TextIO, text: str) -> None:
    """Writes what holds control characters of this program's own: colours of a chart, a bar."""
    if isinstance(stream, Printed):
        stream.write_as_it_is(text)
    else:
        stream.write(text)


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
