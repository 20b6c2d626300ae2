"""Messages on their way from the ticker's process to the desk: one line of JSON each.

Rule: a line is never longer than the reader allows. A message that would be longer loses its template and fields, and
the end of its text.
"""

from drillctl.files.inputs import json_of
from drillctl.language import Message, json_text, verbatim
from drillctl.language.messages import message_from, packed

LONGEST_BYTES = 4000  # below PIPE_BUF, so that a pipe takes a line whole
LONGEST_TEXT = 300  # characters of a message that is cut: JSON may need twelve bytes for one


def message_text(message: Message) -> str:
    """Returns a message as one line of ASCII, at most LONGEST_BYTES long."""
    line = json_text(packed(message))
    return line if len(line) <= LONGEST_BYTES else json_text(packed(verbatim(message[:LONGEST_TEXT])))


def message_read(line: str | bytes) -> Message:
    """Returns the message of a line that ``message_text`` made."""
    return message_from(json_of(line))
