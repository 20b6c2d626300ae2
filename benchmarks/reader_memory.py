"""Peak memory of every reader over inputs made to take as much as they can: at most 10 times the input and 100 MB.

    python -m benchmarks.reader_memory [--bytes N] [--input NAME]...      about 5 MB an input by default

Each input is read in a process of its own, forked after the imports; what counts is the highest resident size of that
process, the interpreter and its libraries included. Prints, for each input, its size, the peak and what is allowed,
and ends with 1 where that was passed. Linux only: it reads /proc.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import struct
import tempfile
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

from benchmarks.fuzz_readers import Reader, readers
from drillctl.trace.segment_file import CHANGE_BYTES, MAGIC, room_bytes

TIMES, ROOM_BYTES = 10, 100_000_000
SIZE_BYTES = 5_000_000
PEAK = re.compile(r"VmHWM:\s+(\d+) kB")
TRACE_HEAD = b"drillctl-trace 1\nmachine pcb-drill\ntick_hz 500\n"


def repeated(piece: bytes, size: int) -> bytes:
    """A piece again and again."""
    return piece * (size // len(piece))


def numbered(form: str, size: int) -> bytes:
    """A form filled with 1, 2, 3 and so on."""
    width = len(form.format(size))
    return b"".join(form.format(number).encode() for number in range(1, size // width))


def wide(data: bytes) -> bytes:
    """The same text with one character that makes Python keep four bytes for each."""
    return data + "# \U0001f600\n".encode()


def trace(head: bytes = b"", changes: bytes = b"", trailer: bytes = b"") -> bytes:
    """A text trace of one signal."""
    return TRACE_HEAD + head + b"signal a <\n\n0 a 0\n" + changes + b"end 900000000\n" + trailer


def segments(size: int, rows: int, images: int) -> bytes:
    """Segments with so many rows in the last two blocks, ticks and values of a signal, and so many images."""
    head = b"drillctl-trace 1\nmachine pcb-drill\ntick_hz 500\nsignal out.0 >\nsignal a <\n\nend 0\n"
    pool, column = bytes(4 * images), struct.pack("<QQq", rows, 1, 1) + bytes(rows)
    one = struct.pack("<QQ", 1, 1) + struct.pack("<q", 1) + b"\0"
    blocks = [struct.pack("<QIBBB", 1, 0, 32, 1, 0), head, b"\n", pool, one, one, column, column]
    packed = zlib.compress(b"".join(struct.pack("<Q", len(block)) + block for block in blocks), 6)
    return MAGIC + packed + os.urandom(max(0, size - len(packed)))


def most_rows(size: int) -> bytes:
    """Segments of as many changes as a file of this size may have."""
    return segments(size, (room_bytes(size) - 10_000) // (2 * CHANGE_BYTES), 1)


def most_images(size: int) -> bytes:
    """Segments of as many images as a file of this size may have."""
    return segments(size, 1, (room_bytes(size) - 10_000) // 4)


INPUTS: dict[str, tuple[str, Callable[[int], bytes]]] = {
    "kmd: different short lines": ("kmd", lambda size: numbered("KMD_CZEKAJ {}\n", size)),
    "kmd: the shortest line": ("kmd", lambda size: repeated(b"KMD_CZEKAJ 1\n", size)),
    "kmd: wide characters": ("kmd", lambda size: wide(numbered("KMD_CZEKAJ {}\n", size))),
    "kmd: empty lines": ("kmd", lambda size: wide(repeated(b"\n", size))),
    "kmd: long different lines": ("kmd", lambda size: numbered("KMD_CZEKAJ 1" + " " * 900 + "#{}\n", size)),
    "trace: different header keys": ("trace", lambda size: trace(head=numbered("k{}\n", size))),
    "trace: header lines": ("trace", lambda size: trace(head=repeated(b"a bc\n", size))),
    "trace: commands": ("trace", lambda size: trace(head=repeated(b"command 1 KMD_BAZA\n", size))),
    "trace: different changes": ("trace", lambda size: trace(changes=numbered("{0} a {0}\n", size))),
    "trace: changes": ("trace", lambda size: trace(changes=numbered("{}1 a 1\n{}2 a 0\n".replace("{}", "{0}"), size))),
    "trace: remarks": ("trace", lambda size: trace(trailer=repeated(b"#ab\n", size))),
    "trace: signals": ("trace", lambda size: TRACE_HEAD + numbered("signal s{} <\n", size)),
    "segments: rows": ("segments", most_rows),
    "segments: images": ("segments", most_images),
    "drill: holes": ("board", lambda size: b"M48\nMETRIC\nT1C0.8\n%\nT1\n" + numbered("X{}\n", size) + b"M30\n"),
    "drill: repeats": (
        "board",
        lambda size: b"M48\nMETRIC\nT1C0.8\n%\nT1\nX1\n" + repeated(b"R9X1\n", size) + b"M30\n",
    ),
    "drill: comments": ("board", lambda size: b"M48\nMETRIC\nT1C0.8\n%\nT1\n" + numbered(";{}\n", size) + b"X1\nM30\n"),
    "drill: empty lines": ("board", lambda size: b"M48\nMETRIC\nT1C0.8\n%\nT1\n" + repeated(b"\n", size)),
    "drill: unknown words": ("board", lambda size: b"M48\n" + numbered("Q{}\n", size)),
    "drill: tools": ("board", lambda size: b"M48\nMETRIC\n" + numbered("T{}C1\n", size)),
    "drill: one line": ("board", lambda size: b"M48\nMETRIC\n" + repeated(b"X", size)),
    "journal: short lines": ("journal", lambda size: journal() + repeated(b"ab\n", size)),
    "journal: one line": ("journal", lambda size: journal() + repeated(b"[", size)),
    **{
        f"{name}: brackets": (name, lambda size: repeated(b"a=[\n", size)) for name in ("machine", "drills", "line map")
    },
    **{f"{name}: lines": (name, lambda size: numbered("{} 0 1 1\n", size)) for name in ("align", "measured")},
    "recent jobs: lists": ("recent jobs", lambda size: repeated(b"[],", size)),
    "mapped card: zeros": ("mapped card", lambda size: repeated(b"\0", size)),
}


def journal() -> bytes:
    """A whole journal's bytes."""
    return readers()["journal"].material.seeds[0]


def peak_bytes(reader: Reader, data: Path) -> int:
    """The highest resident size of a process that reads the file and nothing else. Raises OSError where it died."""
    out, into = os.pipe()
    child = os.fork()
    if not child:
        try:
            _read(reader, data)
            peak = PEAK.search(Path("/proc/self/status").read_text())
            os.write(into, peak[1].encode() if peak else b"")
        finally:
            os._exit(0)
    os.close(into)
    with os.fdopen(out, "rb") as answer:
        found = answer.read()
    os.waitpid(child, 0)
    if not found:
        raise OSError(f"the process that read {data} died")
    return int(found) * 1024


def _read(reader: Reader, file: Path) -> None:
    with contextlib.suppress(*reader.errors):
        reader.call(file)


def measured(names: list[str], size: int) -> Iterator[tuple[str, int, int]]:
    """Inputs by name, each with its size and the peak that reading it took (bytes)."""
    every = readers()
    with tempfile.TemporaryDirectory() as folder:
        for name in names or INPUTS:
            kind, make = INPUTS[name]
            file = Path(folder) / f"input{every[kind].suffix}"
            file.write_bytes(make(size))
            yield name, file.stat().st_size, peak_bytes(every[kind], file)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--bytes", type=int, default=SIZE_BYTES, help="of each input, about")
    parser.add_argument("--input", action="append", default=[], metavar="NAME", help="only this one (repeatable)")
    arguments = parser.parse_args()
    passed = 0
    for name, size, peak in measured(arguments.input, arguments.bytes):
        allowed = TIMES * size + ROOM_BYTES
        passed += peak > allowed
        told = f"{name:30} {size / 1e6:6.1f} MB  peak {peak / 1e6:7.1f} MB  allowed {allowed / 1e6:7.1f} MB"
        print(told + ("  MORE" if peak > allowed else ""), flush=True)
    return 1 if passed else 0


if __name__ == "__main__":
    raise SystemExit(main())
