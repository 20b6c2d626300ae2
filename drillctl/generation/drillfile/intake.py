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
FILE_LIMIT = 32_000_000
CHUNK_BYTES = 1 << 20
TAPE_LEADER = bytes([eia.LEADER, eia.RUBOUT])
DOS_END = b"\x1a"
BLOCK_COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)", re.S)  # HiWIRE writes its tool table in one
UTF8_MARK, UTF16_MARKS = b"\xef\xbb\xbf", (b"\xff\xfe", b"\xfe\xff")


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
    for line in chunk.splitlines(keepends=True):
        if len(line) <= room:
            kept += line
            room = LINE_LIMIT + 1 if line[-1] in b"\r\n" else room - len(line)
            continue
        body = line.rstrip(b"\r\n")
        kept += body[:room] + line[len(body) :]
        room = LINE_LIMIT + 1 if len(body) < len(line) else 0
    return room


def to_text(data: bytes, *, tape_code: bool = False) -> tuple[str, list[Remark]]:
    """The file as text with plain line ends and no block comments, and what was odd about it."""
    remarks = [Remark("eia-rs244-tape-code", 1)] if tape_code else []
    if data[:2] in UTF16_MARKS:
        text = data.decode("utf-16", errors="replace")
        remarks.append(Remark("utf-16", 1))
    else:
        text = _plain_text(data)
    text = text.replace("\r\n", "\n").replace("\n\r", "\n").replace("\r", "\n")
    if not text.strip():
        raise Refusal("empty-file")
    sniff.check_language(text[: sniff.HEAD_BYTES])
    if "/*" in text:
        text = BLOCK_COMMENT.sub(lambda block: ";" + block[0].replace("\n", "\n;"), text)
    return text, remarks


def _plain_text(data: bytes) -> str:
    """ASCII with Latin-1 comments, without tape leader and what DOS left behind its end mark."""
    text = data.removeprefix(UTF8_MARK).strip(TAPE_LEADER).partition(DOS_END)[0].strip(TAPE_LEADER)
    sniff.check_controls(text)
    return text.decode("latin-1")
