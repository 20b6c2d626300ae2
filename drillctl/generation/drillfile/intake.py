"""From bytes to lines of text. Rule: bounded memory, and an end to reading, whatever is thrown at it; nothing is
interpreted.

A line is cut just past LINE_LIMIT while it is read, so a file that is one line of 100 MB costs no more than any other;
and no more than READ_LIMIT is read, since a line from a pipe may have no end. `reader` calls `condense` and then
`to_text`.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from typing import BinaryIO, NamedTuple

from . import eia, sniff
from .errors import Complaint, Remark
from .lexer import TORN_NUMBER

LINE_LIMIT = 4096
FILE_LIMIT = 16_000_000  # eight times the largest number of holes in the widest format
READ_LIMIT = 128_000_000  # the largest file in UTF-16, four times: what is cut off long lines counts too
CHUNK_BYTES = 1 << 20
TAPE_LEADER = bytes([eia.LEADER, eia.RUBOUT])
DOS_END = b"\x1a"
BLOCK_COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)", re.S)  # HiWIRE writes its tool table in one
# Lines of nothing but tool and coordinate words that hold a space or a comma; possessive, so never slow.
UNTIDY_LINE = re.compile(r"^(?:[ \t]++[XYT]|[XYT][-+.\dXYTCFSG]*+[ \t,])[-+.,\dXYTCFSG \t]*+$", re.M)
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
UTF8_MARK = b"\xef\xbb\xbf"
UTF16_MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}
UTF16_HEADS = {b"M\x00": "utf-16-le", b"%\x00": "utf-16-le", b"\x00M": "utf-16-be", b"\x00%": "utf-16-be"}


class Condensed(NamedTuple):
    """Bytes of ASCII or Latin-1 with every line cut at LINE_LIMIT + 1, and the code they were written in."""

    data: bytes
    tape_code: bool = False
    utf_16: bool = False


def condense(stream: BinaryIO) -> Condensed:
    """The stream's bytes, tape code and UTF-16 decoded. Refuses binary heads and huge files."""
    kept = bytearray()
    room = LINE_LIMIT + 1
    head = stream.read(CHUNK_BYTES)
    sniff.check_bytes(head)
    tape_code = eia.is_eia(head)
    utf_16 = "" if tape_code else (UTF16_MARKS | UTF16_HEADS).get(head[:2], "")
    chunks = _chunks(head, stream)
    for chunk in map(eia.decode, chunks) if tape_code else _narrowed(chunks, utf_16) if utf_16 else chunks:
        room = _append_cut(kept, chunk, room)
        if len(kept) > FILE_LIMIT:
            raise Complaint("file-too-large")
    return Condensed(bytes(kept), tape_code, bool(utf_16))


def _chunks(head: bytes, stream: BinaryIO) -> Iterator[bytes]:
    """What the stream holds, a chunk at a time. Refuses a stream of more than READ_LIMIT bytes."""
    left = READ_LIMIT
    while head:
        left -= len(head)
        if left < 0:
            raise Complaint("file-too-large", f"more than {READ_LIMIT // 1_000_000} MB")
        yield head
        head = stream.read(CHUNK_BYTES)


def _narrowed(chunks: Iterator[bytes], encoding: str) -> Iterator[bytes]:
    """UTF-16 as Latin-1; what Latin-1 has no letter for becomes a question mark, which no command holds."""
    decoder = codecs.getincrementaldecoder(encoding)(errors="replace")
    for chunk in chunks:
        yield decoder.decode(chunk).encode("latin-1", errors="replace")
    yield decoder.decode(b"", final=True).encode("latin-1", errors="replace")


def _append_cut(kept: bytearray, chunk: bytes, room: int) -> int:
    """Append the chunk's lines; room is what the line begun in the last chunk may still grow."""
    if room > LINE_LIMIT and not _maybe_long(chunk):
        kept += chunk
        return LINE_LIMIT + 1 - len(chunk) + 1 + max(chunk.rfind(b"\n"), chunk.rfind(b"\r"))
    for line in chunk.splitlines(keepends=True):
        if len(line) <= room:
            kept += line
            room = LINE_LIMIT + 1 if line[-1] in b"\r\n" else room - len(line)
            continue
        body = line.rstrip(b"\r\n")
        kept += body[:room] + line[len(body) :]
        room = LINE_LIMIT + 1 if len(body) < len(line) else 0
    return room


def _maybe_long(chunk: bytes) -> bool:
    """Whether a line may be longer than LINE_LIMIT: it would fill one of these windows."""
    half = LINE_LIMIT // 2
    windows = (chunk[at : at + half] for at in range(0, len(chunk) - half, half))
    return any(b"\n" not in window and b"\r" not in window for window in windows)


def to_text(condensed: Condensed) -> tuple[str, list[Remark]]:
    """The file as text with plain line ends, no block comments and no spaces in coordinate lines.

    The remarks say what was odd about it.
    """
    remarks = [Remark("eia-rs244-tape-code", 1)] if condensed.tape_code else []
    remarks += [Remark("utf-16", 1)] if condensed.utf_16 else []
    text = _plain_text(condensed.data)
    text = text.replace("\r\r\n", "\n").replace("\r\n", "\n").replace("\n\r", "\n").replace("\r", "\n")
    if not text.strip():
        raise Complaint("empty-file")
    sniff.check_language(text[: sniff.HEAD_BYTES])
    if "/*" in text:
        text = BLOCK_COMMENT.sub(lambda block: ";" + block[0].replace("\n", "\n;"), text)
    return _tidy(text, remarks), remarks


def _tidy(text: str, remarks: list[Remark]) -> str:
    """Spaces inside coordinates mean nothing, commas are points: once for all lines, as files do it everywhere."""
    first = UNTIDY_LINE.search(text)
    if not first:
        return text
    line = text.count("\n", 0, first.start()) + 1
    if re.search(r"\S[ \t]", first[0].rstrip()):
        remarks.append(Remark("inner-spaces", line))
    if DECIMAL_COMMA.search(first[0]):
        remarks.append(Remark("comma-decimal", line))
    return UNTIDY_LINE.sub(_tidy_line, text)


def _tidy_line(found: re.Match[str]) -> str:
    """The line without spaces; one that was cut, or that has two numbers with a space between, stays as it is."""
    line = found[0]
    if len(line) > LINE_LIMIT or TORN_NUMBER.search(line):
        return line
    return DECIMAL_COMMA.sub(".", "".join(line.split()))


def _plain_text(data: bytes) -> str:
    """ASCII with Latin-1 comments, without tape leader and what DOS left behind its end mark."""
    text = data.removeprefix(UTF8_MARK).strip(TAPE_LEADER).partition(DOS_END)[0].strip(TAPE_LEADER)
    sniff.check_controls(text)
    return text.decode("latin-1")
