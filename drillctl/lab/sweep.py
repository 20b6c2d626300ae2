"""A sweep: the machines of a question tried one after the other, their rows appended to a results file.

Rule: rows come in the order of the machines and depend on the question alone. Its digest is the last value of every
row, so that rows of two questions are never mixed, and the file is a plain table. A torn last line is taken off; any
other damage refuses the file. While a sweep writes, the file is locked.
"""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from drillctl.files import system
from drillctl.files.inputs import check_kind
from drillctl.lab.answers import FIXED_HEAD, MARK, QUESTION, chunks, head, mark
from drillctl.lab.errors import LabError
from drillctl.lab.question import Question
from drillctl.lab.workers import on_cluster, on_cores
from drillctl.language import Message

OLD_MAGIC = b"# drillctl-sweep 1"  # began the files of earlier versions, before the names of the columns
LONGEST_ROW_BYTES = 4096
FIRST_NAMES, LAST_NAME = ",".join(FIXED_HEAD).encode(), f",{QUESTION}".encode()
ANOTHER = "holds the answer to another question (or of another version of the plant)"


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
        limit = (question.machines + 1) * LONGEST_ROW_BYTES
        data = self._file.read(limit + 1)
        if len(data) > limit:
            raise LabError(
                Message("larger than any answer to this question; give the new one another file").at(self.path)
            )
        *whole, torn = data.split(b"\n")
        names, value = head(question).encode(), mark(question).encode()
        if other := _what_else(whole, torn, names, value):
            raise LabError(Message("{what_else}; give the new one another file", what_else=other).at(self.path))
        _check_rows(whole[1:], names, value, question, self.path)
        self._file.seek(-len(torn), os.SEEK_END)
        self._file.truncate()
        if not whole:
            self._file.write(names + b"\n")
        self._file.flush()
        return max(len(whole) - 1, 0)


def _what_else(whole: list[bytes], torn: bytes, names: bytes, value: bytes) -> str:
    """What a file holds that is no part of this answer, as its first lines tell; "" for one that is, or is empty."""
    first = whole[0] if whole else torn
    if first.startswith(OLD_MAGIC):
        return "is of an earlier version, whose first line was no table; it is a table without that line"
    if first != names and (whole or not names.startswith(first)):
        a_sweep = first.startswith(FIRST_NAMES) and first.endswith(LAST_NAME)
        return ANOTHER if a_sweep else "is no results file of a sweep"
    if len(whole) > 1 and _value(whole[1]) != value and _value(whole[1]).startswith(MARK.encode()):
        return ANOTHER
    return ""


def _value(row: bytes) -> bytes:
    """The last value of a row."""
    return row.rpartition(b",")[2]


def _opened(path: Path) -> BinaryIO:
    """Opens the file for reading and writing, or makes it. Raises OSError, also for a device or a folder."""
    handle = os.open(path, system.flags("O_RDWR", "O_CREAT", "O_NONBLOCK"), 0o666)
    try:
        check_kind(os.fstat(handle), path)
        return os.fdopen(handle, "r+b")
    except OSError:
        os.close(handle)
        raise


def _check_rows(rows: list[bytes], names: bytes, value: bytes, question: Question, path: Path) -> None:
    """Raises LabError for more rows than machines, or one without a value for every column, or of another question."""
    if len(rows) > question.machines:
        raise LabError(
            Message(
                "has {count} rows, and the question {machines} machines", count=len(rows), machines=question.machines
            ).at(path)
        )
    commas = names.count(b",")
    for number, row in enumerate(rows):
        if row.count(b",") != commas or _value(row) != value:
            raise LabError(
                Message("not a row of this table; take away this line and all below it").at(path, number + 2)
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
