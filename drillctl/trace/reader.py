"""Reads the text form of a trace (`text` shows it), or refuses it by file, line and reason.

Rule: only the canonical form is read, so writing gives the same file byte for byte (remarks may be spaced differently);
and everything is bounded, since a golden file may come from anyone. Kinds follow from the signals' names; the words of
a name or command are taken as they are.
"""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.trace.record import Trace
from drillctl.trace.stretches import Stretch
from drillctl.trace.target import Target, opened
from drillctl.trace.text import COMMAND, KEY, MAGIC, RESPONSE, STIMULUS, VERSION
from drillctl.trace.text_changes import TextChanges
from drillctl.trace.text_lines import Lines, bytes_read
from drillctl.trace.values import Values, is_plain, is_word, quoted

HEADER_LIMIT = 1_000  # lines, those of commands apart
COMMANDS_LIMIT = 1_000_000  # lines of a long job
SIGNALS_LIMIT = 1024
REMARKS_LIMIT = 10_000  # lines behind the end
CHANGES_LIMIT = 20_000_000  # 20 bytes each; longer runs are kept in segments


Kept = Callable[[Sequence[str], Stretch], Stretch]


def read_text(
    source: Target,
    name: str | None = None,
    advance: Callable[[int, int], None] = lambda done, total: None,
    kept: Kept = lambda names, stretch: stretch,
) -> Trace:
    """Returns the trace in a path or an open text file; errors call it `name` (by default the path).

    `advance` is called with how many bytes of a path are read, and of how many; what it raises ends the reading.
    `kept` is given the signals' names and the changes, a stretch at a time; the trace has those that it returns.

    Raises TraceError for a file that is not a whole, canonical trace, OSError as `open`.
    """
    with opened(source, "r") as file:
        read = bytes_read(file, advance) if file is not source else _nothing
        lines = Lines(file, name or (str(source) if file is not source else "<trace>"), read)
        header, signals = _read_head(lines)
        changes = TextChanges(lines, signals)
        read_on = (kept(tuple(signals), stretch) for stretch in changes.stretches())
        ticks, signal, values = _columns(lines, read_on)
        trailer = tuple(_remark(lines, line, count) for count, line in enumerate(lines))
    return Trace(header, changes.signals(), ticks, signal, values, changes.end, trailer)


def _columns(lines: Lines, stretches: Iterable[Stretch]) -> tuple[Values, NDArray[np.int32], Values]:
    """Returns ticks, signals and values (n,) of all changes; they are canonical already."""
    kept: list[Stretch] = []
    count = 0
    for stretch in stretches:
        kept.append(stretch)
        count += len(stretch.ticks)
        if count > CHANGES_LIMIT:
            lines.refuse(Message("more than {count} changes", count=CHANGES_LIMIT))
    _, *columns = zip(*kept, strict=True)
    ticks, signal, values = map(np.concatenate, columns)
    return ticks, signal, values


def _nothing() -> None:
    """Ignores how much of a file is read."""


def _read_head(lines: Lines) -> tuple[tuple[tuple[str, str], ...], dict[str, bool]]:
    """Returns header pairs, and the declared signals in order with whether they are a stimulus."""
    _check_magic(lines, next(iter(lines), ""))
    header: list[tuple[str, str]] = []
    signals: dict[str, bool] = {}
    left = {True: COMMANDS_LIMIT, False: HEADER_LIMIT}  # lines, by whether they are commands
    for line in lines:
        key, _, value = line.partition(" ")
        if not line:
            return tuple(header), signals
        if key == "signal":
            _declare(lines, signals, value)
        elif signals or not _is_pair(line, key, value):
            lines.refuse(
                Message("{line} is out of place: `key value` lines, signals, then a blank line", line=quoted(line))
            )
        else:
            left[key == COMMAND] -= 1
            if left[key == COMMAND] < 0:
                lines.refuse(
                    Message(
                        "more than {commands} commands, or {lines} other lines in the head",
                        commands=COMMANDS_LIMIT,
                        lines=HEADER_LIMIT,
                    )
                )
            header.append((COMMAND if key == COMMAND else key, value))  # one string for all keys of commands
    lines.refuse(Message("the file stops within its head: it was cut short; record it again"))


def _check_magic(lines: Lines, first: str) -> None:
    magic, _, version = first.partition(" ")
    if magic != MAGIC:
        lines.refuse(Message("not a trace: the first line must be '{magic} {version}'", magic=MAGIC, version=VERSION))
    if version.endswith("\r"):
        lines.refuse(
            Message("lines end in CR LF, a trace has LF alone: keep git from changing it (.gitattributes: -text)")
        )
    if version != str(VERSION):
        lines.refuse(
            Message(
                "trace version {found}; this drillctl reads version {known}",
                found=quoted(version),
                known=VERSION,
            )
        )


def _is_pair(line: str, key: str, value: str) -> bool:
    return bool(KEY.fullmatch(key)) and is_plain(value) and line == f"{key} {value}".rstrip(" ")


def _declare(lines: Lines, signals: dict[str, bool], declaration: str) -> None:
    name, _, mark = declaration.partition(" ")
    if mark not in (STIMULUS, RESPONSE) or not is_word(name):
        lines.refuse(
            Message(
                "signal {declaration}: expected a name, then < (stimulus) or > (response)",
                declaration=quoted(declaration),
            )
        )
    if name in signals:
        lines.refuse(Message("signal {name} is declared twice", name=quoted(name)))
    if len(signals) == SIGNALS_LIMIT:
        lines.refuse(Message("more than {count} signals", count=SIGNALS_LIMIT))
    signals[name] = mark == STIMULUS


def _remark(lines: Lines, line: str, count: int) -> str:
    if count == REMARKS_LIMIT:
        lines.refuse(Message("more than {count} lines follow the end", count=REMARKS_LIMIT))
    remark = line.removeprefix("#").strip()
    if not line.startswith("#") or not remark.isprintable():
        lines.refuse(Message("{line} after the end: only # lines may follow", line=quoted(line)))
    return remark
