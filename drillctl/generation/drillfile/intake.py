"""From bytes to lines of text. Rule: bounded memory, whatever is thrown at it; nothing is interpreted.

A line is cut just past LINE_LIMIT while it is read, so a file that is one line of 100 MB costs no more
than any other. `reader` calls `condense` and then `to_text`.
"""

from __future__ import annotations

import re
from typing import BinaryIO

from . import eia, sniff
from .errors import Refusal, Remark

LINE_LIMIT = 4096
FILE_LIMIT = 16_000_000  # eight times the largest number of holes in the widest format
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


def condense(stream: BinaryIO) -> tuple[bytes, bool]:
    """The stream's bytes with every line cut at LINE_LIMIT + 1, and whether it was tape code.

    Tape code comes back as ASCII. Refuses binary heads and huge files.
    """
    kept = bytearray()
    room, tape_code = LINE_LIMIT + 1, False
    while chunk := stream.read(CHUNK_BYTES):
        if not kept:
            sniff.check_bytes(chunk)
            tape_code = eia.is_eia(chunk)
        room = _append_cut(kept, eia.decode(chunk) if tape_code else chunk, room)
        if len(kept) > FILE_LIMIT:
            raise Refusal("file-too-large")
    return bytes(kept), tape_code


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


def to_text(data: bytes, *, tape_code: bool = False) -> tuple[str, list[Remark]]:
    """The file as text with plain line ends, no block comments and no spaces in coordinate lines.

    The remarks say what was odd about it.
    """
    remarks = [Remark("eia-rs244-tape-code", 1)] if tape_code else []
    if encoding := (UTF16_MARKS | UTF16_HEADS).get(data[:2]):
        text = data.decode(encoding, errors="replace")
        remarks.append(Remark("utf-16", 1))
    else:
        text = _plain_text(data)
    text = text.replace("\r\n", "\n").replace("\n\r", "\n").replace("\r", "\n")
    if not text.strip():
        raise Refusal("empty-file")
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
    return UNTIDY_LINE.sub(lambda found: DECIMAL_COMMA.sub(".", "".join(found[0].split())), text)


def _plain_text(data: bytes) -> str:
    """ASCII with Latin-1 comments, without tape leader and what DOS left behind its end mark."""
    text = data.removeprefix(UTF8_MARK).strip(TAPE_LEADER).partition(DOS_END)[0].strip(TAPE_LEADER)
    sniff.check_controls(text)
    return text.decode("latin-1")
