"""The 8,192 cells of a store of workpieces, as the 8031 reads them.

0000-00C5  directory: for each of the workpieces 01 to 99 the address of its program, high byte first; FFFF: none
00C6-1FFF  programs: three cells a sentence, then one FF

Rule: pure functions of the cells; whole programs are packed from 00C6 on, single cells written where they are. A store
is never changed in place: each change gives new cells, or an error and nothing.
"""

from collections.abc import Iterator, Mapping, Sequence

from drillctl.generation.boiler_drum.sentence import CELLS, Sentence, fault, sentence_of
from drillctl.generation.errors import JobError
from drillctl.language import Message

STORE_CELLS = 8192
NUMBERS = range(1, 100)
OFFSET_CELLS = 2
FIRST_CELL = OFFSET_CELLS * len(NUMBERS)
EMPTY = 0xFF  # an erased EPROM
NO_PROGRAM = 0xFFFF
END = 0xFF
EMPTY_STORE = bytes([EMPTY]) * STORE_CELLS


def offset_of(cells: bytes, number: int) -> int | None:
    """Returns the address that the directory has for a workpiece; None where it has none."""
    at = OFFSET_CELLS * (number - 1)
    found = int.from_bytes(cells[at : at + OFFSET_CELLS], "big")
    return None if found == NO_PROGRAM else found


def numbers_in(cells: bytes) -> list[int]:
    """Returns the workpieces that the directory has."""
    return [number for number in NUMBERS if offset_of(cells, number) is not None]


def program_at(cells: bytes, number: int, source: str) -> list[tuple[int, Sentence]]:
    """Returns a workpiece's sentences with their first cells; none where the directory has none. Raises JobError with
    the cell for what is no program.
    """
    start = offset_of(cells, number)
    return [] if start is None else list(_sentences(cells, number, start, source))


def with_program(cells: bytes, number: int, sentences: Sequence[Sentence], source: str) -> bytes:
    """Returns the cells with a workpiece added or replaced. Raises JobError where there is no room for it, or where
    another workpiece is damaged.
    """
    programs = _programs(cells, number, source)
    programs[number] = [*sentences]
    return _packed(programs, source)


def without_program(cells: bytes, number: int) -> bytes:
    """Returns the cells with a workpiece taken out of the directory; its cells are room for the next one."""
    at = OFFSET_CELLS * (number - 1)
    return cells[:at] + bytes([EMPTY]) * OFFSET_CELLS + cells[at + OFFSET_CELLS :]


def with_cell(cells: bytes, address: int, content: int) -> bytes:
    """Returns the cells with one byte written at an address, as the monitor program writes it: nothing is checked."""
    return cells[:address] + bytes([content]) + cells[address + 1 :]


def free_cells(cells: bytes, source: str) -> int:
    """Returns how many cells a new program may take, its end among them. Raises JobError for damaged workpieces."""
    return STORE_CELLS - FIRST_CELL - sum(map(_size, _programs(cells, None, source).values()))


def cell_lines(cells: bytes, first: int, last: int) -> Iterator[str]:
    """Yields cells as a monitor program shows them: an address and sixteen bytes a line; lines of FF alone are left
    out.
    """
    for start in range(first - first % 16, last + 1, 16):
        row = cells[start : start + 16]
        if set(row) != {EMPTY}:
            yield f"{start:04X}  {row.hex(' ').upper()}"


def _sentences(cells: bytes, number: int, start: int, source: str) -> Iterator[tuple[int, Sentence]]:
    if not FIRST_CELL <= start < STORE_CELLS:
        entry = OFFSET_CELLS * (number - 1)
        reason = Message("begins at {start}, which is not from {first} to {last}", start=f"{start:04X}",
                         first=f"{FIRST_CELL:04X}", last=f"{STORE_CELLS - 1:04X}")  # fmt: skip
        raise _damaged(source, number, entry, reason)
    at = start
    while at + CELLS <= STORE_CELLS and cells[at] != END:
        text = cells[at : at + CELLS].hex().upper()
        if wrong := fault(text):
            reason = Message("{text!r} is no sentence: {reason}", text=text, reason=wrong.reason)
            raise _damaged(source, number, at + wrong.at // 2, reason)
        yield at, sentence_of(text)
        at += CELLS
    if at >= STORE_CELLS or cells[at] != END:
        raise _damaged(source, number, STORE_CELLS - 1, Message("has no end: no FF behind its last sentence"))


def _damaged(source: str, number: int, cell: int, reason: Message) -> JobError:
    place = Message(
        "workpiece {number}, cell {cell}: {reason}", number=f"{number:02}", cell=f"{cell:04X}", reason=reason
    )
    return JobError(place.at(source))


def _programs(cells: bytes, besides: int | None, source: str) -> dict[int, list[Sentence]]:
    """Returns all programs but one, by number."""
    found = [number for number in numbers_in(cells) if number != besides]
    return {number: [sentence for _, sentence in program_at(cells, number, source)] for number in found}


def _size(sentences: Sequence[Sentence]) -> int:
    return CELLS * len(sentences) + 1


def _packed(programs: Mapping[int, Sequence[Sentence]], source: str) -> bytes:
    directory = bytearray([EMPTY]) * FIRST_CELL
    body = bytearray()
    for number in sorted(programs):
        at = OFFSET_CELLS * (number - 1)
        directory[at : at + OFFSET_CELLS] = (FIRST_CELL + len(body)).to_bytes(OFFSET_CELLS, "big")
        body += b"".join(sentence.cells() for sentence in programs[number]) + bytes([END])
    room = STORE_CELLS - FIRST_CELL
    if len(body) > room:
        reason = Message(
            "full: its programs would take {wanted} cells, and there are {room}", wanted=len(body), room=room
        )
        raise JobError(reason.at(source))
    return bytes(directory + body).ljust(STORE_CELLS, bytes([EMPTY]))
