"""Messages for the operator: a template with named fields, and the one exception that carries them.

Rule: a message is formatted once, in English, where it is made. It keeps its template and its fields, so that a screen
can look the template up in the operator's catalogue (words.translated). A field that is a Message itself is translated
too; any other field is data (a name, a number, a line of a file) and is never translated.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, ClassVar

from drillctl.language.visible import one_line

MOST_SHOWN = 50  # messages of one refusal that are written out
_PLACES = ("{file}: {reason}", "{file}:{line}: {reason}", "{file}:{line}:{column}: {reason}")


class Message(str):
    """The English text of a template and its fields: ``Message("tool T{number} has no diameter", number=3)``.

    It is a ``str``, equal to any other of the same text. Raises KeyError for a template with a field that isn't given.
    """

    template: str
    fields: Mapping[str, Any]

    def __new__(cls, template: str, /, **fields: Any) -> "Message":
        """Formats the template, as ``str.format`` does."""
        message = super().__new__(cls, template.format(**fields))
        message.template, message.fields = template, fields
        return message

    def __reduce__(self) -> tuple[Any, ...]:
        """Keeps template and fields in a pickle or a copy."""
        return _formatted, (self.template, dict(self.fields))

    def at(self, file: object, line: int | None = None, column: int | None = None) -> "Message":
        """Returns the message with its place before it: ``FILE:LINE:COLUMN: ``, as much of it as is given."""
        place = [part for part in (line, column) if part is not None]
        fields: dict[str, Any] = dict(zip(("line", "column"), place, strict=False))
        fields["file"] = file if isinstance(file, Message) else str(file)
        return Message(_PLACES[len(place)], **fields, reason=self)

    @property
    def line(self) -> int | None:
        """The line of the message's place, or of that of a message in it; None where there is none."""
        if self.template in _PLACES and "line" in self.fields:
            return int(self.fields["line"])
        inner = (field.line for field in self.fields.values() if isinstance(field, Message))
        return next((line for line in inner if line is not None), None)


class Counted(Message):
    """A message in which a number decides the form of the words: ``Counted("{count} hole", "{count} holes", 3)``.

    ``template`` is the form for one, ``plural`` that for any other number; ``number`` is the number, which both forms
    have as the field ``count``.
    """

    plural: str
    number: int

    def __new__(cls, one: str, many: str, count: int, /, **fields: Any) -> "Counted":
        """Formats the one of the two forms that English has for this number."""
        fields["count"] = count
        message = str.__new__(cls, (one if abs(count) == 1 else many).format(**fields))
        message.template, message.plural, message.number, message.fields = one, many, count, fields
        return message

    def __reduce__(self) -> tuple[Any, ...]:
        """Keeps both forms and the fields in a pickle or a copy."""
        return _counted, (self.template, self.plural, dict(self.fields))


def _counted(one: str, many: str, fields: dict[str, Any]) -> Counted:
    return Counted(one, many, fields.pop("count"), **fields)


def _formatted(template: str, fields: Mapping[str, Any]) -> Message:
    return Message(template, **fields)


def verbatim(text: str) -> Message:
    """Returns a text that is data as a message; a Message is returned as it is."""
    return text if isinstance(text, Message) else Message("{text}", text=text)


def joined(separator: str, messages: Iterable[str]) -> Message:
    """Returns messages and texts, one behind the other, as one message."""
    fields = {f"part{number}": message for number, message in enumerate(messages)}
    return Message(separator.join(f"{{{name}}}" for name in fields), **fields)


def listed(messages: Sequence[Message]) -> Message:
    """Returns one or more messages with ``and`` between them: ``origin and mirror``."""
    first, *others = messages
    return Message("{first} and {second}", first=first, second=listed(others)) if others else first


def packed(message: Message) -> list[Any]:
    """Returns a message as plain lists, texts and numbers, for JSON; ``message_from`` reads them. A field that is
    neither text nor number (a path) becomes its text.
    """
    forms = [message.template, message.plural] if isinstance(message, Counted) else [message.template]
    return [{name: _packed_field(field) for name, field in message.fields.items()}, *forms]


def _packed_field(field: Any) -> dict[str, Any]:
    if isinstance(field, Message):
        return {"message": packed(field)}
    return {"data": field if isinstance(field, str | int | float) else str(field)}


def message_from(plain: Sequence[Any]) -> Message:
    """Returns the message of which ``packed`` gave this."""
    kept_fields, template, *plural = plain
    fields = {
        name: message_from(kept["message"]) if "message" in kept else kept["data"] for name, kept in kept_fields.items()
    }
    return _counted(template, plural[0], fields) if plural else Message(template, **fields)


class Refusal(Exception):
    """The root of everything that is refused: the operator's input, and what can't be done with it.

    ``messages`` has one for each problem. ``str()`` is a line for each of the first MOST_SHOWN; line ends within one of
    them are escaped. ``kind``: what is refused, as ``--json`` names it; a subclass for each.
    """

    kind: ClassVar[str] = "refused"

    def __init__(self, *messages: Message):
        self.messages = messages
        super().__init__(*messages)

    def __reduce__(self) -> tuple[Any, ...]:
        """Keeps the messages and a subclass's own attributes in a pickle, whatever its constructor takes."""
        return _restored, (type(self), self.messages), vars(self)

    def __str__(self) -> str:
        return "\n".join(map(one_line, shown_of(self.messages)))

    @property
    def message(self) -> Message:
        """The problems as one message, a line for each."""
        return self.messages[0] if len(self.messages) == 1 else joined("\n", shown_of(self.messages))


def _restored(kind: type[Refusal], messages: Sequence[Message]) -> Refusal:
    return kind.__new__(kind, *messages)


def shown_of(messages: Sequence[Message]) -> list[Message]:
    """Returns the first MOST_SHOWN messages, and how many more there are."""
    more = len(messages) - MOST_SHOWN
    return [*messages[:MOST_SHOWN], *([Message("and {count} more", count=more)] if more > 0 else [])]


def message_of(error: Exception) -> Message:
    """Returns what an exception says: its Message where it has one, the text of any other as data.

    Of an OSError with a file it is the reason alone (``strerror``).
    """
    if isinstance(error, Refusal):
        return error.message
    if isinstance(error, OSError) and error.strerror is not None:
        return verbatim(error.strerror)
    return verbatim(error.args[0] if error.args and isinstance(error.args[0], Message) else str(error))
