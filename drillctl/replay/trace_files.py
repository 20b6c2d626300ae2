"""Files of traces in either form, text (``.trace``) and segments (``.seg``).

Rule: a file is known by how it begins when it is read, and by its name when it is written. Called by the verbs, by
replay and by the scope.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from drillctl.files.outputs import Output, OutputError
from drillctl.machine import Machine
from drillctl.trace import Segments, Trace, TraceError, is_segments, read_segments, read_text, segment_bytes, write_text
from drillctl.trace.segments import MOST_CHANGES
from drillctl.trace.values import is_plain

SEGMENTS = ".seg"
MOST_CARDS = 2  # 64 bits
Read = TypeVar("Read")


def read_record(file: Path) -> Trace | Segments:
    """What a file keeps of a run. Raises TraceError, too where the file can't be read."""
    return _read(file, read_segments) if _read(file, is_segments) else _read(file, read_text)


def read_trace(file: Path, to_tick: int | None = None) -> Trace:
    """The same with every change; of segments the first ``to_tick`` ticks alone, where that is said. Raises as
    ``read_record``, and for segments that hold more changes than there is room for.
    """
    record = read_record(file)
    if not isinstance(record, Segments):
        return record
    return whole_trace(record if to_tick is None else record.up_to(to_tick), file)


def whole_trace(segments: Segments, file: Path) -> Trace:
    """Every change. Raises TraceError where these are more than MOST_CHANGES, which is known before they are made."""
    if segments.change_count > MOST_CHANGES:
        part = segments.end * MOST_CHANGES // segments.change_count // 2
        reason = f"{segments.change_count} changes in {segments.end} ticks; there is room for {MOST_CHANGES}"
        hint = f"look at a part: drillctl convert {file.name} --to part.trace --to-tick {part}"
        raise TraceError(str(file), None, f"{reason}; {hint}")
    return segments.trace()


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
        try:
            data = segment_bytes(segments)
        except ValueError as error:
            raise OutputError(f"{output.path}: {error}") from error
        output.write_bytes(data)
    else:
        trace = whole_trace(record, output.path) if isinstance(record, Segments) else record
        output.write(lambda file: write_text(trace, file))


def _read(file: Path, reader: Callable[[Path], Read]) -> Read:
    try:
        return reader(file)
    except OSError as error:
        raise TraceError(str(file), None, f"can't be read: {error.strerror}") from error
