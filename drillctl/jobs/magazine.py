"""The magazine record of a machine, kept in the user's state folder: which tool is where, across power loss.

Rule: what a transfer makes unknown is on the disk before the first command of it is sent, and what became of it
afterwards. The file is one JSON object, replaced whole; whoever finds that another has changed it meanwhile stops.
"""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

from drillctl.files.inputs import json_of, read_bytes, real_path
from drillctl.files.kept import alone, replace
from drillctl.files.outputs import OutputError
from drillctl.generation.eight_axis.magazine import Magazine, full_magazine
from drillctl.language import Message, Refusal, json_text, message_of
from drillctl.machine import Machine

FORMAT = 1
LARGEST_BYTES = 1024 * 1024
THERE = {"full": True, "empty": False, "unknown": None}
WORDS = {there: word for word, there in THERE.items()}


class MagazineError(Refusal):
    """Raised for a record that can't be read or written. ``str()`` names the file and the reason."""

    kind = "magazine"


class _Bit(msgspec.Struct, forbid_unknown_fields=True):
    place: int
    spindle: int
    bit: str


class _Record(msgspec.Struct, forbid_unknown_fields=True, rename={"format": "drillctl-magazine"}):
    format: int
    machine: str
    chucks: dict[str, int | None]
    bits: list[_Bit]
    hits: dict[str, int]
    renewed: list[int]


class MagazineFile:
    """The record of one machine. ``magazine`` is what is known; ``keep`` changes it, on the disk first."""

    def __init__(self, file: Path, machine: Machine):
        self.file = file
        self._machine = machine
        self._text = _text_of(file)
        self.magazine = full_magazine(machine) if self._text is None else _parsed(self._text, file, machine)

    @property
    def is_new(self) -> bool:
        """Whether nothing was kept yet: all tools are taken to be in their places, and the chucks to be empty."""
        return self._text is None

    def keep(self, magazine: Magazine) -> None:
        """Writes the record, and has it from then on. Raises MagazineError; the record then stays as it was."""
        text = json_text(_plain(magazine, self._machine), 2) + "\n"
        try:
            with alone(self.file):
                if _text_of(self.file) != self._text:
                    raise MagazineError(Message("another run has changed it meanwhile").at(self.file))
                replace(self.file, text)
        except OutputError as error:
            raise MagazineError(error.message) from error
        self.magazine, self._text = magazine, text


def default_file(folder: Path, machine: Machine) -> Path:
    """Returns where the record of a machine is kept: one for each shipped machine, and for each file of a user's."""
    if machine.shipped:
        return folder / f"{machine.name}.magazine"
    place = hashlib.sha256(str(real_path(Path(machine.file))).encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return folder / f"{machine.name}-{place}.magazine"


def _text_of(file: Path) -> str | None:
    """The file's text, None where there is no file. Raises MagazineError."""
    try:
        return read_bytes(file, LARGEST_BYTES, Message("a magazine record")).decode()
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise MagazineError(Message("can't be read: {why}", why=message_of(error)).at(file)) from error


def _parsed(text: str, file: Path, machine: Machine) -> Magazine:
    try:
        record = msgspec.convert(json_of(text), _Record)
        if record.format != FORMAT:
            raise ValueError(Message("it was written by another version of this program"))
        chucks = {int(spindle): tool for spindle, tool in record.chucks.items()}
        bits = {(bit.place, bit.spindle): THERE[bit.bit] for bit in record.bits}
        hits = {int(tool): count for tool, count in record.hits.items()}
    except (msgspec.ValidationError, json.JSONDecodeError, RecursionError, ValueError, KeyError) as error:
        reason = Message(
            "is no magazine record: {why}; take it away, look at the machine, say what is there (drillctl magazine)",
            why=message_of(error),
        )
        raise MagazineError(reason.at(file)) from error
    known = full_magazine(machine)
    unknown = dict.fromkeys(known.bits)  # a place that was entered since: nobody has looked
    return Magazine(
        {spindle: chucks.get(spindle) for spindle in known.chucks},
        {bit: bits.get(bit) for bit in unknown},
        hits,
        frozenset(record.renewed),
    )


def _plain(magazine: Magazine, machine: Machine) -> Mapping[str, Any]:
    """The record as JSON has it."""
    bits = [
        {"place": place, "spindle": spindle, "bit": WORDS[there]}
        for (place, spindle), there in sorted(magazine.bits.items())
    ]
    return {
        "drillctl-magazine": FORMAT,
        "machine": machine.name,
        "chucks": {str(spindle): tool for spindle, tool in sorted(magazine.chucks.items())},
        "bits": bits,
        "hits": {str(tool): count for tool, count in sorted(magazine.hits.items())},
        "renewed": sorted(magazine.renewed),
    }
