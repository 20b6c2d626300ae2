"""Files that a run will write. Reserved before anything moves, complete or absent afterwards.

Rule: a result is written to a temporary file beside its place and renamed when it is whole; a path that can't be
written refuses the run. Temporary files that killed runs have left in that folder are removed.
"""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from drillctl.files import scratch, system
from drillctl.language import Message, Refusal, message_of


class OutputError(Refusal):
    """A file that can't be written. ``str()`` is ``FILE: reason``."""

    kind = "output"


class Output:
    """One reserved file; ``write`` fills it and puts it in place, through a link where the path is one.

    durable  the content is on the disk before it is put in place, and its name before ``write`` returns
    """

    def __init__(self, path: Path, durable: bool = False):
        self.path, self.durable = path, durable
        self._place = Path(os.path.realpath(path))
        self._temporary: Path | None = None
        self._handle = -1
        try:
            if path.exists() and not path.is_file():
                path.open("a").close()  # a device or a pipe: written as it is; a folder raises
                return
            scratch.sweep(self._place.parent)
            self._handle, self._temporary = scratch.make_file(self._place)
        except OSError as error:
            raise OutputError(Message("can't be written: {why}", why=message_of(error)).at(path)) from error

    def write(self, fill: Callable[[TextIO], object]) -> None:
        """Calls ``fill`` with an open text file (LF ends). Raises OutputError; the old file then still stands."""
        target = os.dup(self._handle) if self._temporary else self.path
        try:
            with open(target, "w", encoding="utf-8", newline="\n") as file:
                fill(file)
                file.flush()
                if self.durable and self._temporary:
                    os.fsync(file.fileno())
            if self._temporary:
                system.give_usual_rights(self._handle)
                self._close_early()
                self._temporary.replace(self._place)
                if self.durable:
                    system.sync_folder(self._place.parent)
                self._temporary = None
                self.drop()
        except OSError as error:
            raise OutputError(Message("can't be written: {why}", why=message_of(error)).at(self.path)) from error

    def write_bytes(self, data: bytes) -> None:
        """Like ``write``, for a file that is no text."""
        self.write(lambda file: file.buffer.write(data))

    def drop(self) -> None:
        """Takes the reservation back and leaves nothing behind."""
        self._close_early()
        if self._temporary:
            self._temporary.unlink(missing_ok=True)
            self._temporary = None
        self._close()

    def _close_early(self) -> None:
        """Closes the file, and gives its lock up, before its name changes, on a system that wants it so."""
        if not system.RENAMES_OPEN_FILES:
            self._close()

    def _close(self) -> None:
        if self._handle >= 0:
            os.close(self._handle)
            self._handle = -1


@contextmanager
def reserved(paths: Sequence[Path | None], inputs: Sequence[Path | None]) -> Iterator[list[Output | None]]:
    """Reserves the paths given (None stays None). Raises OutputError, also where a path would overwrite an input."""
    taken = {os.path.realpath(path) for path in inputs if path is not None}
    for wanted in filter(None, paths):
        place = os.path.realpath(wanted)
        if place in taken:
            raise OutputError(Message("would overwrite a file that this run reads or writes").at(wanted))
        taken.add(place)
    outputs: list[Output | None] = []
    try:
        for path in paths:
            outputs.append(Output(path) if path is not None else None)
        yield outputs
    finally:
        for output in outputs:
            if output is not None:
                output.drop()


def unwritten(*writes: Callable[[], None]) -> list[Message]:
    """Writes each result of a run; returns the reasons of those that failed. The machine has moved, so nothing is
    refused.
    """
    problems: list[Message] = []
    for write in writes:
        try:
            write()
        except OutputError as error:
            problems += error.messages
    return problems


def write_text(path: Path, text: str) -> tuple[Message, ...]:
    """Writes a text to a path, whole or not at all, and makes its folder where it is missing; returns the reason where
    that fails.
    """
    output = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        output = Output(path)
        output.write(lambda file: print(text, end="", file=file))
    except OutputError as error:
        return error.messages
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        return (Message("can't be written: {why}", why=message_of(error)).at(path),)
    finally:
        if output is not None:
            output.drop()
    return ()
