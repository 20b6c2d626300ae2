"""Segments as a file, and the reader of such files. The format is in docs/TRACES.md.

Rule: the same segments give the same bytes. Columns are stored as indexes into the few different values that they have,
low bytes apart from high ones: a job repeats itself, and zlib finds that more easily then.
"""

import os
import struct
import zlib
from dataclasses import replace
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drillctl.files.inputs import read_bytes, read_start
from drillctl.language import Message, message_of
from drillctl.trace.reader import read_text
from drillctl.trace.record import Trace
from drillctl.trace.segments import MOST_TICKS, OUTPUT, Segments
from drillctl.trace.tapes import Images, Tape
from drillctl.trace.text import COMMAND, write_text
from drillctl.trace.text_lines import TraceError
from drillctl.trace.values import Values

MAGIC = b"drillctl-segments 1\n"
LEVEL = 6
LARGEST_FILE_BYTES = 1 << 28
ROOM_BYTES, ROOM_TIMES = 26_000_000, 5  # in memory: so much, and so many times the file's size
VALUE_BYTES, CHANGE_BYTES = 8, 40  # of a row of a tape's column; of a signal's column, which is sorted among the others
COUNT = struct.Struct("<Q")
SUMS = struct.Struct("<QIBBB")  # ticks, CRC-32 of the images, bits of an image, tapes, 1: commands without numbers
INDEXES = (np.dtype("<u1"), np.dtype("<u2"), np.dtype("<u4"))
BITS = (32, 64)
Pairs = tuple[tuple[str, str], ...]


def is_segments(path: str | os.PathLike[str]) -> bool:
    """Returns whether the file begins as segments. Raises OSError as `open`."""
    return read_start(path, len(MAGIC)) == MAGIC


def segment_bytes(segments: Segments) -> bytes:
    """Returns the whole file. Raises ValueError for a run that ``read_segments`` would find too large."""
    bits = segments.pool.dtype.itemsize * 8
    bare = _bare(segments.header)
    sums = SUMS.pack(segments.end, segments.checksum, bits, len(segments.tapes), bare is not None)
    words = "\n".join(" ".join(signal.names) for signal in segments.signals)
    blocks = [sums, _head_text(segments, bare or segments.header).encode(), words.encode(), _planes(segments.pool)]
    for tape in segments.tapes:
        blocks += [_column(tape.start), _column(tape.ticks)]
    for signal in segments.rest.signals:
        blocks += [_column(np.diff(column, prepend=0)) for column in segments.rest.changes_of(signal.name)]
    packed = b"".join(COUNT.pack(len(block)) + block for block in blocks)
    file = MAGIC + zlib.compress(packed, LEVEL)
    if bytes_in_memory(segments) > room_bytes(len(file)) or segments.end > MOST_TICKS:
        raise ValueError(
            Message("{end} ticks are more than segments hold; keep a part of the run, or a .trace", end=segments.end)
        )
    return file


def read_segments(path: str | os.PathLike[str]) -> Segments:
    """Returns the segments in a file. Raises TraceError for a file that is not whole, OSError as `open`."""
    data = read_bytes(path, LARGEST_FILE_BYTES, Message("a trace"))
    if not data.startswith(MAGIC):
        raise TraceError(
            str(path), None, Message("not segments: the first line must be {magic!r}", magic=MAGIC.decode().strip())
        )
    try:
        return _unpacked(_Blocks(data))
    except (zlib.error, struct.error, ValueError, IndexError, TypeError, OverflowError, TraceError) as error:
        raise TraceError(
            str(path), None, Message("damaged ({why}); record it again", why=message_of(error))
        ) from error


class _Blocks:
    """The blocks of a file, unpacked one after the other. Raises ValueError where there is none, or no room for it."""

    def __init__(self, data: bytes):
        self._unpacker, self._packed = zlib.decompressobj(), data[len(MAGIC) :]
        self._room_left = room_bytes(len(data))

    def __next__(self) -> bytes:
        size = self._size()
        self._take(size)
        return self._read(size)

    def column(self, row_bytes: int = VALUE_BYTES) -> Values:
        """Reads the next block as a column, whose rows take so much memory each."""
        block = self._read(self._size())
        self._take(COUNT.unpack_from(block)[0] * row_bytes)
        return _uncolumn(block)

    def images(self, dtype: np.dtype[np.unsignedinteger]) -> Images:
        """Reads the next block as images, a plane at a time: it is the largest."""
        size = self._size()
        self._take(size)
        count, rest = divmod(size, dtype.itemsize)
        if rest:
            raise ValueError(Message("cut short"))
        found = np.empty((count, dtype.itemsize), np.uint8)
        for place in range(dtype.itemsize):
            found[:, place] = np.frombuffer(self._read(count), np.uint8)
        return found.view(dtype).ravel()

    def _size(self) -> int:
        """Reads how many bytes the next block has. Raises ValueError where there is no room for them."""
        size: int = COUNT.unpack(self._read(COUNT.size))[0]
        if size > self._room_left:
            raise ValueError(Message("more than a file of its size has"))
        return size

    def _take(self, size: int) -> None:
        self._room_left -= size
        if self._room_left < 0:
            raise ValueError(Message("more than a file of its size has"))

    def _read(self, size: int) -> bytes:
        found = self._unpacker.decompress(self._packed, size) if size else b""
        self._packed = self._unpacker.unconsumed_tail
        if len(found) < size:
            raise ValueError(Message("cut short"))
        return found

    def close(self) -> None:
        """Raises ValueError where the file does not end here."""
        if self._unpacker.decompress(self._packed, 1) or not self._unpacker.eof:
            raise ValueError(Message("cut short, or more than a file of its size has"))


def room_bytes(file_bytes: int) -> int:
    """Returns how much memory the segments in a file of this size may take."""
    return ROOM_BYTES + ROOM_TIMES * file_bytes


def bytes_in_memory(segments: Segments) -> int:
    """Returns how much memory segments take, as the reader counts it."""
    rows = VALUE_BYTES * sum(len(tape.start) + len(tape.ticks) for tape in segments.tapes)
    return segments.pool.nbytes + rows + 2 * CHANGE_BYTES * len(segments.rest.ticks)


def _unpacked(blocks: _Blocks) -> Segments:
    end, checksum, bits, tape_count, bare = SUMS.unpack(next(blocks))
    if end > MOST_TICKS:
        raise ValueError(
            Message("{end} ticks; a trace in segments has at most {most}", end=end, most=MOST_TICKS)
        )
    if bits not in BITS or not tape_count:
        raise ValueError(Message("its images are not of 32 or 64 bits"))
    head = _head(next(blocks).decode(), next(blocks).decode(), bool(bare))
    pool = blocks.images(np.dtype(f"<u{bits // 8}"))
    tapes = [Tape(blocks.column(), blocks.column()) for _ in range(tape_count)]
    others = [signal for signal in head.signals if not OUTPUT.fullmatch(signal.name)]
    changes = [(blocks.column(CHANGE_BYTES).cumsum(), blocks.column(CHANGE_BYTES).cumsum()) for _ in others]
    blocks.close()
    rows = [np.full(len(ticks), number) for number, (ticks, _) in enumerate(changes)]
    none = np.zeros(0, np.int64)
    parts = [t for t, _ in changes], rows, [v for _, v in changes]
    columns = [np.concatenate([none, *part]) for part in parts]
    rest = Trace.of_changes(head.header, others, columns[0], columns[1], columns[2], end, head.trailer)
    for tape in tapes:
        _check(tape, end, len(pool))
    segments = Segments(rest, head.signals, pool, tuple(tapes))
    if segments.checksum != checksum:
        raise ValueError(Message("the checksum of its images is another"))
    return segments


def _check(tape: Tape, end: int, words: int) -> None:
    inside = (tape.start >= 0) & (tape.start <= words) & (tape.ticks > 0) & (tape.ticks <= words - tape.start)
    same_length = len(tape.start) == len(tape.ticks)
    if not same_length or not inside.all() or int(tape.ticks.sum()) != end:
        raise ValueError(Message("a tape reaches beyond its image pool"))


def _bare(header: Pairs) -> Pairs | None:
    """Returns the header with commands without their numbers, where these count from 1; else None."""
    found, number = [], 0
    for key, value in header:
        number += key == COMMAND
        counted, _, bare = value.partition(" ")
        if key == COMMAND and counted != str(number):
            return None
        found.append((key, bare if key == COMMAND else value))
    return tuple(found)


def _numbered(header: Pairs) -> Pairs:
    """The inverse of ``_bare``: adds the commands' numbers."""
    found, number = [], 0
    for key, value in header:
        number += key == COMMAND
        found.append((key, f"{number} {value}" if key == COMMAND else value))
    return tuple(found)


def _head_text(segments: Segments, header: Pairs) -> str:
    """Returns header, signals and trailer as a text trace of no ticks has them."""
    file, empty = StringIO(), np.zeros(0, np.int64)
    plain = Trace(header, segments.signals, empty, empty.astype(np.int32), empty, 0, segments.rest.trailer)
    write_text(plain, file, derived=True)
    return file.getvalue()


def _head(text: str, words: str, bare: bool) -> Trace:
    """The inverse of ``_head_text``, with the signals' words."""
    plain = read_text(StringIO(text))
    named = zip(plain.signals, words.split("\n"), strict=True)
    signals = tuple(replace(signal, names=tuple(names.split())) for signal, names in named)
    return replace(plain, header=_numbered(plain.header) if bare else plain.header, signals=signals)


def _column(values: Values) -> bytes:
    """Packs a column: how many values, how many different ones, these, and each value's index as narrow as it fits."""
    different, index = np.unique(values, return_inverse=True)
    width = next(dtype for dtype in INDEXES if len(different) <= 1 << 8 * dtype.itemsize)
    head = COUNT.pack(len(values)) + COUNT.pack(len(different))
    return head + _planes(np.diff(different, prepend=0)) + _planes(index.astype(width))


def _uncolumn(block: bytes) -> Values:
    count, kinds = (COUNT.unpack_from(block, at)[0] for at in (0, COUNT.size))
    begin = 2 * COUNT.size
    different = _unplaned(block[begin : begin + 8 * kinds], np.dtype("<i8")).cumsum()
    if kinds > count:
        raise ValueError(Message("a column has more different values than rows"))
    width = next(dtype for dtype in INDEXES if kinds <= 1 << 8 * dtype.itemsize)
    index = _unplaned(block[begin + 8 * kinds :], width)
    if len(index) != count:
        raise ValueError(Message("a column is cut short"))
    return different[index]


def _planes(values: NDArray[np.generic]) -> bytes:
    """Returns all lowest bytes first, then the next ones."""
    little = np.ascontiguousarray(values.astype(values.dtype.newbyteorder("<"), copy=False))
    return np.ascontiguousarray(little.view(np.uint8).reshape(len(little), -1).T).tobytes()


def _unplaned(block: bytes, dtype: np.dtype[Any]) -> NDArray[Any]:
    planes = np.frombuffer(block, np.uint8).reshape(dtype.itemsize, -1)
    return np.ascontiguousarray(planes.T).view(dtype).ravel()
