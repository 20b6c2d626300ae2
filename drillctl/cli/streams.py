"""The standard streams, in whatever state they are: closed, full, a pipe that nobody reads, a terminal that is gone.

Rule: a failure to write to standard error stops nothing, since a machine may be moving; a failure to write to standard
output is a failure of the verb. Every character that a terminal would obey is escaped here, once, for all verbs
(``drillctl.language``).
"""

import io
import os
import sys
from typing import TYPE_CHECKING, TextIO, cast

from drillctl.language import LINES, one_line, visible

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

UNDELIVERED = 1
STANDARD_ERROR = 2
RETURN = "\r"  # a bar of tqdm begins its line anew with it

_is_quiet = False


class _Heedless(io.FileIO):
    """A stream that accepts everything and drops what it can't write."""

    def write(self, data: "ReadableBuffer", /) -> int:
        """Writes the data; drops it where that fails. Never raises."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


class Printed(io.TextIOWrapper):
    """A text stream that escapes everything but printed characters, line ends and tabs, and what its encoding doesn't
    have.
    """

    def write(self, text: str, /) -> int:
        """Writes the text escaped; returns how many characters it was given."""
        super().write(visible(text, LINES))
        return len(text)

    def write_as_it_is(self, text: str) -> None:
        """Writes text unescaped: for control characters that this program makes itself."""
        super().write(text)


class _Bar:
    """The part of a stream that tqdm needs; it may return to the start of its line."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self.encoding, self.fileno = stream.encoding, stream.fileno
        self.flush = stream.flush
        self.isatty = (lambda: False) if _is_quiet else stream.isatty

    def write(self, text: str) -> None:
        as_it_is(self._stream, visible(text, LINES + RETURN))


def tell(line: str) -> None:
    """One line on standard error. Line ends within it, as a file's name may have, are escaped too."""
    print(f"drillctl: {one_line(line)}", file=sys.stderr)


def speak(language: str | None, plain: bool = False) -> None:
    """Sets the language of the words, that of the environment for None; tells what is wrong with its catalogue.

    plain  without accents
    """
    from drillctl.language import words

    if problem := words.use(language or words.language_of(), plain):
        tell(problem)


def quiet(wanted: bool) -> None:
    """Leaves notices and progress out from now on, or says them again."""
    global _is_quiet  # noqa: PLW0603  one for the process, as the streams are
    _is_quiet = wanted


def note(line: str) -> None:
    """One line on standard error that nobody has to read: not said where ``quiet`` was asked for."""
    if not _is_quiet:
        tell(line)


def prepare() -> None:
    """Replaces closed streams by the null device, so that no file gets their numbers, and standard error by one that
    never raises.
    """
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
    """Returns the stream for a progress bar, which may return to the start of its line.

    A bar has no foreign words in it.
    """
    return cast(TextIO, _Bar(stream))


def as_it_is(stream: TextIO, text: str) -> None:
    """Writes text that has control characters of this program's own: colours of a chart, a bar."""
    if isinstance(stream, Printed):
        stream.write_as_it_is(text)
    else:
        stream.write(text)


def silence(*streams: TextIO) -> None:
    """Redirects what is still to be written to these streams, at exit too, to the null device."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in streams:
        os.dup2(nowhere, stream.fileno())


def delivered(code: int, text: str = "") -> int:
    """Writes the text and everything before it, and returns the exit code: a failure shows now, not at exit.

    Raises BrokenPipeError.
    """
    try:
        print(text, end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        return undelivered(error, code)
    return code


def undelivered(error: OSError, code: int = 0) -> int:
    """Returns the exit code of a verb whose output could not be written."""
    silence(sys.stdout)
    tell(f"standard output: {error.strerror}")
    return code or UNDELIVERED
