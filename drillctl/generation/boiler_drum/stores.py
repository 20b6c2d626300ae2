"""The two stores of a machine: the EPROM of finished workpieces, read only, and the RAM that is kept across power loss.

Rule: a workpiece's number is looked up in the RAM first. A store that can't be read whole is refused; a change is
written whole before the call returns. A machine has stores where there is an EPROM for it: ``eprom/NAME.hex`` beside
its machines, or among the shipped tables.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from drillctl.files import kept
from drillctl.files.inputs import read_bytes
from drillctl.files.shipped import shipped
from drillctl.generation.boiler_drum import cells
from drillctl.generation.boiler_drum.store_file import parse_store, store_text
from drillctl.generation.boiler_drum.text import Part
from drillctl.generation.errors import JobError
from drillctl.language import Message, message_of
from drillctl.machine import Machine

EPROM, RAM = "EPROM", "RAM"
LARGEST_BYTES = 256 * 1024


@dataclass(frozen=True)
class Store:
    """One store as it was read: ``kind`` is EPROM or RAM."""

    kind: str
    file: Path
    cells: bytes

    def numbers(self) -> list[int]:
        """Returns the workpieces that it has."""
        return cells.numbers_in(self.cells)

    def part(self, number: int) -> Part | None:
        """Returns a workpiece's program, or None where there is none of this number. Raises JobError for a damaged
        one.
        """
        if cells.offset_of(self.cells, number) is None:
            return None
        found = cells.program_at(self.cells, number, str(self.file))
        return Part(
            f"{self.kind} {number:02}", tuple(one for _, one in found), tuple(cell for cell, _ in found), in_store=True
        )

    def damages(self) -> list[Message]:
        """Returns what is wrong with its workpieces, one message for each that is damaged."""
        found: list[Message] = []
        for number in self.numbers():
            try:
                self.part(number)
            except JobError as error:
                found += error.messages
        return found


def has_stores(machine: Machine) -> bool:
    """Returns whether there is an EPROM for this machine."""
    return _eprom_file(machine) is not None


def read_eprom(machine: Machine) -> Store:
    """Reads a machine's EPROM. Raises JobError, also for a machine that has none."""
    file = _eprom_file(machine)
    if file is None:
        raise JobError(Message("this machine has no stores of workpieces; boiler-drum has").at(machine.name))
    return Store(EPROM, file, _read(file))


def read_ram(machine: Machine, file: Path | None) -> Store:
    """Reads a machine's RAM: from ``file``, which must be there, or else from its own place, where it may still be
    empty. Raises JobError.
    """
    place = ram_file(machine) if file is None else file
    if file is None and not place.exists():
        return Store(RAM, place, cells.EMPTY_STORE)
    return Store(RAM, place, _read(place))


def ram_file(machine: Machine) -> Path:
    """Returns where a machine's RAM is kept: in the user's state folder."""
    from platformdirs import user_state_path

    return user_state_path("drillctl", appauthor=False) / "stores" / f"{machine.name}.hex"


def find_part(number: int, machine: Machine, ram: Path | None) -> Part:
    """Returns a workpiece of the RAM, else of the EPROM. Raises JobError."""
    stores = [read_ram(machine, ram), read_eprom(machine)]
    found = next((part for store in stores if (part := store.part(number)) is not None), None)
    if found is None:
        there = sorted({number for store in stores for number in store.numbers()})
        numbers = " ".join(f"{other:02}" for other in there) or "-"
        reason = Message("no workpiece of this number, in RAM or EPROM; there are {numbers}", numbers=numbers)
        raise JobError(reason.at(f"{number:02}"))
    if not found.sentences:
        raise JobError(Message("no sentence in it").at(found.source))
    return found


def change_ram(machine: Machine, file: Path | None, change: Callable[[bytes, str], bytes]) -> None:
    """Writes the RAM's cells as ``change(cells, name of the file)`` gives them; a file that isn't there is made.

    Raises JobError, OutputError; the last content then still stands.
    """
    read_eprom(machine)
    place = ram_file(machine) if file is None else file
    with kept.alone(place):
        before = _read(place) if place.exists() else cells.EMPTY_STORE
        kept.replace(place, store_text(change(before, str(place))))


def _eprom_file(machine: Machine) -> Path | None:
    beside = Path(machine.file).parent.parent
    folders = (beside, shipped("tables", "tables"))
    return next((file for folder in folders if (file := folder / "eprom" / f"{machine.name}.hex").is_file()), None)


def _read(file: Path) -> bytes:
    try:
        text = read_bytes(file, LARGEST_BYTES, Message("a store of workpieces")).decode("ascii")
    except OSError as error:
        raise JobError(Message("can't be read: {why}", why=message_of(error)).at(file)) from error
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        column = error.start - error.object.rfind(b"\n", 0, error.start)
        raise JobError(Message("not ASCII text, so no store of workpieces").at(file, line, column)) from error
    return parse_store(text, str(file))
