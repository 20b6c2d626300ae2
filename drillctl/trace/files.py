"""Files of traces in either form, text (``.trace``) and segments (``.seg``).

Rule: when it is read, the form of a file is told by its first bytes; when it is written, by its name.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from drillctl.files.outputs import Output, OutputError
from drillctl.language import Message, message_of
from drillctl.trace import (
    Segments,
    Trace,
    TraceError,
    is_segments,
    is_trace,
    read_segments,
    read_text,
    segment_bytes,
    write_text,
)  # fmt: skip
from drillctl.trace.segments import MOST_CHANGES
from drillctl.trace.text_summary import TextSummary, read_summary

SEGMENTS = ".seg"
MOST_CARDS = 2  # 64 bits
Read = TypeVar("Read")


def read_record(file: Path, advance: Callable[[int, int], None] = lambda done, total: None) -> Trace | Segments:
    """The record in a file, in the form in which it is kept. ``advance`` is called with how many bytes of a text are
    read, and of how many. Raises TraceError, also where the file can't be read.
    """
    if _read(file, is_segments):
        return _read(file, read_segments)
    return _read(file, lambda path: read_text(path, advance=advance))


def is_text(file: Path) -> bool:
    """Whether a file begins as a text trace. Raises TraceError where it can't be read."""
    return _read(file, is_trace)


def summary_of(file: Path, advance: Callable[[int, int], None]) -> TextSummary:
    """The summary of a text trace, whose changes are not kept. ``advance``, errors: as ``read_record``."""
    return _read(file, lambda path: read_summary(path, advance))


def read_trace(file: Path, to_tick: int | None = None) -> Trace:
    """The record in a file as a trace; of segments only the first ``to_tick`` ticks, if that is given. Raises
    TraceError, also for segments that hold more changes than there is room for.
    """
    return shortened(read_record(file), file, to_tick)


def shortened(record: Trace | Segments, file: Path, to_tick: int | None = None) -> Trace:
    """As ``read_trace``, of a record that has been read."""
    if not isinstance(record, Segments):
        return record
    return whole_trace(record if to_tick is None else record.up_to(to_tick), file)


def whole_trace(segments: Segments, file: Path) -> Trace:
    """Segments as a trace. Raises TraceError, before any work, where it would have more than MOST_CHANGES changes."""
    if segments.change_count > MOST_CHANGES:
        part = segments.end * MOST_CHANGES // segments.change_count // 2
        reason = Message(
            "{changes} changes in {ticks} ticks; there is room for {room}; look at a part: drillctl convert {file} "
            "--to part.trace --to-tick {tick}",
            changes=segments.change_count,
            ticks=segments.end,
            room=MOST_CHANGES,
            file=file.name,
            tick=part,
        )
        raise TraceError(str(file), None, reason)
    return segments.trace()


def takes_segments(file: Path, cards: int) -> bool:
    """Whether a file of this name is written in the segment form. Raises OutputError where that has no room for the
    cards of the machine.
    """
    wanted = file.suffix.lower() == SEGMENTS
    if wanted and cards > MOST_CARDS:
        raise OutputError(
            Message("segments hold the outputs of {most} cards; keep a .trace of this machine", most=MOST_CARDS).at(
                file
            )
        )
    return wanted


def write_record(record: Trace | Segments, output: Output) -> None:
    """Writes a record in the form of the file's name. Raises OutputError."""
    if output.path.suffix.lower() == SEGMENTS:
        segments = record if isinstance(record, Segments) else Segments.of_trace(record)
        try:
            data = segment_bytes(segments)
        except ValueError as error:
            raise OutputError(message_of(error).at(output.path)) from error
        output.write_bytes(data)
    else:
        output.write(lambda file: write_text(record, file))


def _read(file: Path, reader: Callable[[Path], Read]) -> Read:
    try:
        return reader(file)
    except OSError as error:
        raise TraceError(str(file), None, Message("can't be read: {why}", why=message_of(error))) from error
