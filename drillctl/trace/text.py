"""The text form of a trace, for golden files and diffs: one change a line. Written here, read by `reader`.

    drillctl-trace 1            the magic first line
    tick_hz 500                 key value, as many as there are
    signal kmd <                < stimulus, > response; in order of declaration
    signal out.0 >
                                a blank line
    0 kmd -                     TICK NAME VALUE, by tick then declaration; tick 0 lists every signal
    0 out.0 0x00000000
    1 kmd 1:KMD_GOTOdXdY
    7 out.0 0x00000025
    end 8                       number of ticks run; without it the file was cut short
    # summary ...               remarks, ignored by replay

Rule: the same trace gives the same bytes.
"""

import os
import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from drillctl.files.inputs import read_start
from drillctl.trace.record import Signal, Trace
from drillctl.trace.segments import Segments
from drillctl.trace.stretches import Stretch, stretches
from drillctl.trace.target import Target, opened
from drillctl.trace.values import is_plain, named_signal_kind, quoted

MAGIC = "drillctl-trace"
VERSION = 1
KEY = re.compile(r"(?!(signal|end)\b)[a-z][a-z0-9_-]*")
COMMAND = "command"  # the key of a head's line that is one command of the program
STIMULUS, RESPONSE = "<", ">"  # how a signal line ends
LINE_LIMIT = 4096  # characters, the line end included
ROWS_AT_ONCE = 50_000  # written in one piece: bounds the memory that a long trace takes as Python objects


def is_trace(path: str | os.PathLike[str]) -> bool:
    """Returns whether the file begins as a trace, of any version: `read_text` refuses one that is too new.

    Raises OSError as `open`. Reads the first bytes only.
    """
    start = f"{MAGIC} ".encode()
    return read_start(path, len(start)) == start


def write_text(record: Trace | Segments, target: Target, *, derived: bool = False) -> None:
    """Writes the record to a path or an open text file; derived signals only on request. Of segments no more than some
    changes are in memory at once.

    Raises ValueError if reading it back would not give the same trace (a header of two lines, a signal whose name
    stands for another kind), before anything is written; OSError as `open`.
    """
    frame, parts = (record.rest, record.stretches()) if isinstance(record, Segments) else (record, stretches(record))
    chosen = [index for index, signal in enumerate(record.signals) if derived or not signal.derived]
    head = _head_lines(frame, [record.signals[index] for index in chosen])
    trailer = [_line("#", remark) for remark in frame.trailer]
    with opened(target, "w") as file:
        file.writelines(head)
        file.writelines(_change_lines(record.signals, parts, chosen))
        file.write(f"end {frame.end}\n")
        file.writelines(trailer)


def _head_lines(trace: Trace, signals: Sequence[Signal]) -> list[str]:
    for key in dict(trace.header):
        if not KEY.fullmatch(key):
            raise ValueError(f"header: {quoted(key)} is no key: a-z 0-9 _ -, and not `signal` or `end`")
    return [
        _line(MAGIC, str(VERSION)),
        *_lines(trace.header),
        *(_line("signal", _declaration(signal)) for signal in signals),
        "\n",
    ]


def _lines(pairs: Sequence[tuple[str, str]]) -> list[str]:
    """Returns the lines that ``_line`` makes; looked at all together, since a board has tens of thousands."""
    lines = [f"{key} {value}".rstrip(" ") + "\n" for key, value in pairs]
    values = "\n".join(["", *(value for _, value in pairs), ""])
    printable = values.count("\n") == len(pairs) + 1 and values.replace("\n", "").isprintable()
    short = max(map(len, lines), default=0) <= LINE_LIMIT
    if printable and short and "\n " not in values and " \n" not in values:
        return lines
    return [_line(key, value) for key, value in pairs]


def _line(key: str, value: str) -> str:
    line = f"{key} {value}".rstrip(" ") + "\n"
    if not is_plain(value) or len(line) > LINE_LIMIT:
        raise ValueError(f"{key} {quoted(value)}: controls, outer blanks or too long for one line")
    return line


def _declaration(signal: Signal) -> str:
    kind, _ = named_signal_kind(signal.name)
    if signal.kind != kind:
        raise ValueError(f"signal {signal.name} is a {signal.kind}, but its name says a {kind} to readers")
    return f"{signal.name} {STIMULUS if signal.stimulus else RESPONSE}"


def _change_lines(signals: Sequence[Signal], parts: Iterable[Stretch], chosen: Sequence[int]) -> Iterator[str]:
    """Yields the lines of these signals, many at once. Each different `NAME VALUE` of a part is formatted only once."""
    for part in parts:
        endings: list[str] = []
        ending = np.full(len(part.ticks), -1)
        for index in chosen:
            signal, rows = signals[index], np.flatnonzero(part.signal == index)
            distinct, where = np.unique(part.values[rows], return_inverse=True)
            ending[rows] = where + len(endings)
            endings += [f"{signal.name} {signal.show(value)}\n" for value in distinct.tolist()]
        rows = np.flatnonzero(ending >= 0)
        for start in range(0, len(rows), ROWS_AT_ONCE):
            piece = rows[start : start + ROWS_AT_ONCE]
            pairs = zip(part.ticks[piece].tolist(), ending[piece].tolist(), strict=True)
            yield "".join([f"{tick} {endings[code]}" for tick, code in pairs])
