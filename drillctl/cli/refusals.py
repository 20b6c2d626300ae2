"""Prints what the operator got wrong: lines on standard error, and with --json an object on standard output.

Rule: the object has the same keys whatever was refused: ``{"error": {"code", "line", "text", "reason"}}``. An exception
that is no refusal is raised on, as a fault of this program.
"""

from typing import Any

from drillctl.cli import streams
from drillctl.language import Message, Refusal, json_text, message_of
from drillctl.language.messages import shown_of

REFUSED = 2
# Errors that no reader turns into one of its own.
_OTHERS = (
    (MemoryError, "memory", Message("not enough memory for what was asked; give it a smaller file, or a part of it")),
    (RecursionError, "nesting", Message("what was given is nested too deeply")),
)


class UsageRefused(Refusal):
    """A command line that can't be understood."""

    kind = "usage"


def refuse(error: Exception, as_json: bool) -> int:
    """Prints a refusal; returns the exit code. Raises ``error`` where it is no refusal."""
    found = _refused(error)
    if found is None and isinstance(error, OSError):
        return streams.undelivered(error)
    if found is None:
        raise error
    kind, messages = found
    if as_json:
        print(json_text(_object(error, kind, messages)))
    for message in shown_of(messages):
        streams.tell(message)
    return streams.delivered(REFUSED)


def _refused(error: Exception) -> tuple[str, tuple[Message, ...]] | None:
    """Returns the kind and the messages of what was refused; None for an exception that is no refusal."""
    if isinstance(error, Refusal):
        return error.kind, error.messages
    if isinstance(error, OSError) and error.filename is not None:
        return "unreadable", (message_of(error).at(_name(error.filename)),)
    return next(((kind, (message,)) for other, kind, message in _OTHERS if isinstance(error, other)), None)


def _object(error: Exception, kind: str, messages: tuple[Message, ...]) -> dict[str, Any]:
    """Returns the JSON object. A drill file's error has its own; otherwise the line is that of the first message."""
    from drillctl.generation.drillfile import DrillFileError

    inner = error if isinstance(error, DrillFileError) else error.__cause__
    if isinstance(inner, DrillFileError):
        return dict(inner.as_dict())
    if isinstance(error, OSError) and kind == "unreadable":
        return _error(kind, None, Message("can't be read: {why}", why=message_of(error)))
    text = str(error) if isinstance(error, Refusal) else messages[0]
    return _error(kind, messages[0].line, text)


def _error(kind: str, line: int | None, reason: str) -> dict[str, Any]:
    return {"error": {"code": kind, "line": line, "text": "", "reason": reason}}


def _name(file: object) -> str:
    """Returns a file's name as text, from text or bytes."""
    return file.decode("utf-8", "surrogateescape") if isinstance(file, bytes) else str(file)
