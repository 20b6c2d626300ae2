"""Wiring: files of traces in either form, text (``.trace``) and segments (``.seg``).

Rule: a file is known by how it begins when it is read, and by its name when it is written. Called by the verbs, by
replay and by the scope.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from drillctl.machine import Machine
from drillctl.trace import Segments, Trace, TraceError, is_segments, read_segments, read_text, segment_bytes, write_text
from drillctl.trace.values import is_plain
from drillctl.wiring.outputs import Output, OutputError

SEGMENTS = ".seg"
MOST_CARDS = 2  # 64 bits
Read = TypeVar("Read")


def read_record(file: Path) -> Trace | Segments:
    """What a file keeps of a run. Raises TraceError, too where the file can't be read."""
    return _read(file, read_segments) if _read(file, is_segments) else _read(file, read_text)


def read_trace(file: Path) -> Trace:
    """The same with every change. Raises as ``read_record``."""
    record = read_record(file)
    return record.trace() if isinstance(record, Segments) else record


def takes_segments(file: Path, cards: int) -> bool:
    """Whether a file of this name is to be written in the segment form. Raises OutputError where a machine has too
    many cards for it.
    """
    wanted = file.suffix.lower() == SEGMENTS
    if wanted and cards > MOST_CARDS:
        raise OutputError(f"{file}: segments hold the outputs of {MOST_CARDS} cards; keep a .trace of this machine")
    return wanted


def machine_named(machine: Machine, file: Path) -> str:
    """What a trace of this name calls its machine. Raises OutputError for a machine's file that no trace can name."""
    named = machine.reference_from(file.parent)
    if not is_plain(named):
        reason = f"a trace can't name {machine.file}; give the machine's file and its folders plain names"
        raise OutputError(f"{file}: {reason}")
    return named


def write_record(record: Trace | Segments, output: Output) -> None:
    """In the form that the file's name asks for. Raises OutputError."""
    if output.path.suffix.lower() == SEGMENTS:
        segments = record if isinstance(record, Segments) else Segments.of_trace(record)
        output.write_bytes(segment_bytes(segments))
    else:
        trace = record.trace() if isinstance(record, Segments) else record
        output.write(lambda file: write_text(trace, file))


def _read(file: Path, reader: Callable[[Path], Read]) -> Read:
    try:
        return reader(file)
    except OSError as error:
        raise TraceError(str(file), None, f"can't be read: {error.strerror}") from error
