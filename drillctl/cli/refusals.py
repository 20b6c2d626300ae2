"""Prints what the operator got wrong: lines on standard error, and with --json an object on standard output.

Rule: the object has the same keys whatever was refused: ``{"error": {"code", "line", "text", "reason"}}``. An exception
that is no refusal is raised on, as a fault of this program.
"""

import re
from typing import Any

from drillctl.cli import streams
from drillctl.language import json_text

REFUSED = 2
# Errors that no reader turns into one of its own.
_WORDS = (
    (MemoryError, "not enough memory for what was asked; give it a smaller file, or a part of it"),
    (RecursionError, "what was given is nested too deeply"),
)
_PLACE = re.compile(r".*?:(\d+)(?::\d+)?: ")  # FILE:LINE: or FILE:LINE:COLUMN:


class UsageRefused(Exception):
    """A command line that can't be understood."""


def refuse(error: Exception, as_json: bool) -> int:
    """Prints a refusal; returns the exit code. Raises ``error`` where it is no refusal."""
    code = _code(error)
    if code is None and isinstance(error, OSError) and error.filename is None:
        return streams.undelivered(error)
    if code is None:
        raise error
    from drillctl.generation.errors import JobError

    record = _object(error, code)
    if as_json:
        print(json_text(record))
    for line in _text(error).split("\n") if isinstance(error, JobError) else [_text(error)]:
        streams.tell(line)
    return streams.delivered(REFUSED)


def _code(error: Exception) -> str | None:
    """Returns the code of what was refused; None for an exception that is no refusal."""
    if isinstance(error, OSError) and error.filename is not None:
        return "unreadable"
    return next((code for kind, code in _codes() if isinstance(error, kind)), None)


def _codes() -> list[tuple[type[Exception], str]]:
    from drillctl.cli.screen import ScreenError
    from drillctl.files.outputs import OutputError
    from drillctl.generation.drillfile import DrillFileError
    from drillctl.generation.errors import JobError
    from drillctl.generation.measured import AlignmentError
    from drillctl.generation.placing import PlacingError
    from drillctl.jobs.journal import JournalError
    from drillctl.lab.errors import LabError
    from drillctl.lab.latency import LatencyError
    from drillctl.machine import TableError
    from drillctl.ports import PortError
    from drillctl.trace import TraceError
    from drillctl.ui.terminal.image_file import PictureRefused

    return [
        (UsageRefused, "usage"), (JobError, "job"), (TableError, "table"), (TraceError, "trace"),
        (OutputError, "output"), (DrillFileError, "drill-file"), (PlacingError, "placing"),
        (AlignmentError, "alignment"), (PortError, "port"), (JournalError, "journal"), (LatencyError, "latency"),
        (LabError, "lab"), (PictureRefused, "picture"), (ScreenError, "screen"),
        (MemoryError, "memory"), (RecursionError, "nesting"),
    ]  # fmt: skip


def _text(error: Exception) -> str:
    """Returns the message, a line for each problem."""
    if isinstance(error, OSError) and error.filename is not None:
        return f"{_name(error.filename)}: {error.strerror}"
    return next((words for kind, words in _WORDS if isinstance(error, kind)), str(error))


def _object(error: Exception, code: str) -> dict[str, Any]:
    """Returns the JSON object. A drill file's error has its own; otherwise the line is the one that the message begins
    with.
    """
    from drillctl.generation.drillfile import DrillFileError

    inner = error if isinstance(error, DrillFileError) else error.__cause__
    if isinstance(inner, DrillFileError):
        return dict(inner.as_dict())
    if isinstance(error, OSError) and code == "unreadable":
        return {"error": {"code": code, "line": None, "text": "", "reason": f"can't be read: {error.strerror}"}}
    text = _text(error)
    place = _PLACE.match(text)
    return {"error": {"code": code, "line": int(place[1]) if place else None, "text": "", "reason": text}}


def _name(file: object) -> str:
    """Returns a file's name as text, from text or bytes."""
    return file.decode("utf-8", "surrogateescape") if isinstance(file, bytes) else str(file)
