"""The file of a store: a line with its checksum, then 8,192 cells as Intel HEX records.

    drillctl-store 1 crc32 1A2B3C4D
    :10000000FFFF...                  count, address, type 00, bytes, checksum of the line
    :00000001FF

Rule: the cells are read whole, or refused with line and column. The records without the first line are what programs
for EPROM programmers read and write.
"""

import re
import zlib
from collections.abc import Sequence

from drillctl.generation.boiler_drum.cells import STORE_CELLS
from drillctl.generation.errors import JobError
from drillctl.language import Counted, Message

_HEADER = re.compile(r"drillctl-store 1 crc32 ([0-9A-F]{8})\r?")
HEADER, CRC_COLUMN = "drillctl-store 1 crc32 ", 24
END_RECORD = ":00000001FF"
ROW_CELLS = 16
DATA = 0
FRAME = 5  # bytes of a record beside its data: count, two of address, type, checksum
_NO_HEX = re.compile(r"[^0-9A-F]")


def store_text(cells: bytes) -> str:
    """Returns the text of a store's file."""
    rows = [_record(start, cells[start : start + ROW_CELLS]) for start in range(0, STORE_CELLS, ROW_CELLS)]
    return "\n".join([f"{HEADER}{zlib.crc32(cells):08X}", *rows, END_RECORD, ""])


def parse_store(text: str, source: str) -> bytes:
    """Returns the cells. Raises JobError with line and column."""
    first, *others = text.rstrip().split("\n")
    header = _HEADER.fullmatch(first)
    if header is None:
        raise _refused(source, 1, 0, Message("no store of workpieces, which begins with {line}", line=HEADER))
    cells = _cells(others, source)
    if zlib.crc32(cells) != int(header[1], 16):
        found = f"{zlib.crc32(cells):08X}"
        raise _refused(source, 1, CRC_COLUMN - 1, Message("the cells have the checksum {found}: damaged", found=found))
    return cells


def _record(address: int, data: bytes) -> str:
    body = bytes([len(data), *address.to_bytes(2, "big"), DATA]) + data
    return f":{(body + bytes([-sum(body) & 0xFF])).hex().upper()}"


def _cells(lines: Sequence[str], source: str) -> bytes:
    """Returns the cells of all records up to the end record, behind which there must be nothing."""
    cells = bytearray()
    for number, line in enumerate(lines, start=2):
        text = line.removesuffix("\r")
        if text != END_RECORD:
            cells += _data(text, len(cells), source, number)
            continue
        if len(cells) != STORE_CELLS:
            short = Counted(
                "the end after {count} cell; a store has {cells}",
                "the end after {count} cells; a store has {cells}",
                len(cells),
                cells=STORE_CELLS,
            )
            raise _refused(source, number, 0, short)
        if len(lines) + 1 > number:
            raise _refused(source, number + 1, 0, Message("nothing may follow the end record"))
        return bytes(cells)
    raise _refused(source, len(lines) + 2, 0, Message("cut short: there is no end record {record}", record=END_RECORD))


def _data(text: str, address: int, source: str, line: int) -> bytes:
    """Returns the data of one record, which must go on at ``address``."""
    if not text.startswith(":"):
        raise _refused(source, line, 0, Message("a record begins with a colon"))
    if odd := _NO_HEX.search(text, 1):
        reason = Message("{text!r} is no digit of 0 to 9 and A to F", text=odd[0])
        raise _refused(source, line, odd.start(), reason)
    if len(text) % 2 == 0 or len(text) // 2 < FRAME or len(text) // 2 != FRAME + int(text[1:3], 16):
        reason = Counted(
            "{count} character; the record's count of bytes says otherwise",
            "{count} characters; the record's count of bytes says otherwise",
            len(text),
        )
        raise _refused(source, line, 1, reason)
    record = bytes.fromhex(text[1:])
    if sum(record) & 0xFF:
        raise _refused(source, line, len(text) - 2, Message("the record's checksum is wrong: damaged"))
    if record[3] != DATA:
        raise _refused(source, line, 7, Message("type {kind}; a store has records of type 00", kind=f"{record[3]:02X}"))
    if int.from_bytes(record[1:3], "big") != address or address + record[0] > STORE_CELLS:
        wanted = Message("not the next cells: those from {address} on are due", address=f"{address:04X}")
        raise _refused(source, line, 3, wanted)
    return record[4:-1]


def _refused(source: str, line: int, at: int, reason: Message) -> JobError:
    return JobError(reason.at(source, line, at + 1))
