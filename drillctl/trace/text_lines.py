"""The lines of a trace in text form, read a page at a time, counted and bounded.

Rule: every refusal of a file names the line it was met in.
"""

import os
from collections.abc import Callable, Iterator
from typing import NoReturn, TextIO

from drillctl.language import Message, Refusal
from drillctl.trace.text import LINE_LIMIT

PAGE_CHARACTERS = 1 << 18


class TraceError(Refusal):
    """A trace file that can't be read or run. `line` counts from 1, None where the whole file is meant."""

    kind = "trace"

    def __init__(self, file: str, line: int | None, reason: Message) -> None:
        super().__init__(reason.at(file, line))
        self.file, self.line, self.reason = file, line, reason

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return self.reason.at(place)


class Lines:
    """The lines of one file without their ends. `number` counts those that were given out, from 1.

    `tell` is called after each full page that is read from the file.
    """

    def __init__(self, file: TextIO, name: str, tell: Callable[[], None]) -> None:
        self._file, self._name, self._tell, self.number = file, name, tell, 0
        self._page: list[str] = []  # lines that were read, those given out too
        self._given = 0  # of the page
        self._cut = ""  # the beginning of the line that follows the page
        self._unended = False  # the page is one line without its end

    def __iter__(self) -> Iterator[str]:
        while self._given < len(self._page) or self._read_page():
            line = self._page[self._given]
            self._given += 1
            self.number += 1
            if len(line) >= LINE_LIMIT:
                self.refuse(Message("the line is longer than {count} characters", count=LINE_LIMIT))
            if self._unended:
                self.refuse(Message("the line is not ended: the file was cut short; record it again"))
            yield line

    def page(self) -> list[str]:
        """Returns the whole lines that follow, as many as are read at once, without giving them out; none at the end
        of the file, or where the next line can't be read.
        """
        if self._given == len(self._page):
            self._read_page()
        page = self._page[self._given :]
        bad = self._unended or max(map(len, page), default=0) >= LINE_LIMIT
        return [] if bad else page

    def skip(self, count: int) -> None:
        """Gives out so many lines of the page at once."""
        self._given += count
        self.number += count

    def refuse(self, reason: Message) -> NoReturn:
        """Raises TraceError for the line that was given out last."""
        raise TraceError(self._name, max(self.number, 1), reason)

    def _read_page(self) -> bool:
        """Reads the next lines; returns whether there are any."""
        read = page = None
        while not page and read != "" and len(self._cut) < LINE_LIMIT:
            read = self._file.read(PAGE_CHARACTERS)
            *page, self._cut = (self._cut + read).split("\n")
        if read and len(read) == PAGE_CHARACTERS:
            self._tell()
        if not page and self._cut:
            page, self._cut, self._unended = [self._cut], "", True
        self._page, self._given = page or [], 0
        return bool(page)


def bytes_read(file: TextIO, advance: Callable[[int, int], None]) -> Callable[[], None]:
    """Returns what tells how much of a file is read; one that grows meanwhile is never more than read."""
    size = os.fstat(file.fileno()).st_size
    return lambda: advance(min(file.buffer.tell(), size), size)
