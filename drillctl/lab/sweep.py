"""A sweep: the machines of a question tried one after the other, their rows appended to a results file.

Rule: rows come in the order of the machines and depend on the question alone. Its digest is in the file's first line,
so that rows of two questions are never mixed. A torn last line is taken off; any other damage refuses the file. While
a sweep writes, the file is locked.
"""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from drillctl.files import system
from drillctl.files.inputs import check_kind
from drillctl.lab.answers import chunks, head
from drillctl.lab.errors import LabError
from drillctl.lab.question import Question
from drillctl.lab.workers import on_cluster, on_cores
from drillctl.language import Message

MAGIC = "# drillctl-sweep 1"
LONGEST_ROW_BYTES = 4096


class Results:
    """An open results file, a context manager. ``rows``: how many it has so far. Raises LabError, OSError."""

    def __init__(self, path: Path, question: Question):
        self.path = path
        self._file: BinaryIO = _opened(path)
        try:
            _lock(self._file, path)
            self.rows = self._begun(question)
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> "Results":
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def append(self, rows: Sequence[str]) -> None:
        """Appends rows; the operating system has them when this returns."""
        self._file.write("".join(f"{row}\n" for row in rows).encode())
        self._file.flush()
        self.rows += len(rows)

    def _begun(self, question: Question) -> int:
        """Checks what the file holds and makes it ready for the next row; returns how many rows it has."""
        limit = (question.machines + len(_first_lines(question))) * LONGEST_ROW_BYTES
        data = self._file.read(limit + 1)
        if len(data) > limit:
            raise LabError(
                Message("larger than any answer to this question; give the new one another file").at(self.path)
            )
        *whole, torn = data.split(b"\n")
        wanted = _first_lines(question)
        begun = wanted[0].startswith(torn) if not whole else whole[:2] == wanted[: len(whole)]
        if not begun:
            raise LabError(
                Message("{what_else}; give the new one another file", what_else=_what_else(whole)).at(self.path)
            )
        _check_rows(whole[2:], wanted[1], question, self.path)
        self._file.seek(-len(torn), os.SEEK_END)
        self._file.truncate()
        self._file.write(b"".join(line + b"\n" for line in wanted[len(whole) :]))
        self._file.flush()
        return max(len(whole) - len(wanted), 0)


def _first_lines(question: Question) -> list[bytes]:
    """The two lines that the file begins with: magic and digest, then the names of the columns."""
    return [f"{MAGIC} {question.digest}".encode(), head(question).encode()]


def _opened(path: Path) -> BinaryIO:
    """Opens the file for reading and writing, or makes it. Raises OSError, also for a device or a folder."""
    handle = os.open(path, system.flags("O_RDWR", "O_CREAT", "O_NONBLOCK"), 0o666)
    try:
        check_kind(os.fstat(handle), path)
        return os.fdopen(handle, "r+b")
    except OSError:
        os.close(handle)
        raise


def _what_else(whole: list[bytes]) -> str:
    if whole and whole[0].startswith(MAGIC.encode()):
        return "holds the answer to another question (or of another version of the plant)"
    return "is no results file of a sweep"


def _check_rows(rows: list[bytes], names: bytes, question: Question, path: Path) -> None:
    """Raises LabError for more rows than machines, or one without a value for every column."""
    if len(rows) > question.machines:
        raise LabError(
            Message(
                "has {count} rows, and the question {machines} machines", count=len(rows), machines=question.machines
            ).at(path)
        )
    values = names.count(b",")
    for number, row in enumerate(rows):
        if row.count(b",") != values:
            raise LabError(
                Message("not a row of this table; take away this line and all below it").at(path, number + 3)
            )


def _lock(file: BinaryIO, path: Path) -> None:
    try:
        system.lock(file.fileno())
    except BlockingIOError as error:
        raise LabError(Message("another sweep is writing it").at(path)) from error


@dataclass(frozen=True, slots=True)
class WorkerPool:
    """Where the rows are worked out: in so many processes here, or by the dask scheduler at an address."""

    workers: int = 1
    cluster: str | None = None


def sweep(question: Question, results: Results, pool: WorkerPool) -> Iterator[int]:
    """Works out the rows that are missing; yields how many the file has after each chunk. Raises LabError."""
    todo = chunks(question, results.rows)
    answers = on_cluster(question, todo, pool.cluster) if pool.cluster else on_cores(question, todo, pool.workers)
    for chunk, rows in zip(todo, answers, strict=True):
        results.append(rows[max(results.rows - chunk.start, 0) :])
        yield results.rows
