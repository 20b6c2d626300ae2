"""Reads the text form of a trace (`text` shows it), or refuses it by file, line and reason.

Rule: only the canonical form is read, so writing gives the same file byte for byte (remarks may be spaced differently);
and everything is bounded, since a golden file may come from anyone. Kinds follow from the signals' names; the words of
a name or command are taken as they are.
"""

import os
from array import array
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import NoReturn, TextIO

import numpy as np

from drillctl.language import Message, Refusal, message_of
from drillctl.trace.record import TICK_LIMIT, Signal, Trace
from drillctl.trace.target import Target, opened
from drillctl.trace.text import COMMAND, KEY, LINE_LIMIT, MAGIC, RESPONSE, STIMULUS, VERSION
from drillctl.trace.values import KINDS, Vocabulary, is_plain, is_word, named_signal_kind, quoted

HEADER_LIMIT = 1_000  # lines, those of commands apart
COMMANDS_LIMIT = 1_000_000  # lines of a long job
CHANGES_REMEMBERED = 1 << 14
SIGNALS_LIMIT = 1024
REMARKS_LIMIT = 10_000  # lines behind the end
TOLD_EVERY = 20_000  # lines: some tenths of a second
CHANGES_LIMIT = 20_000_000  # 20 bytes each; longer runs are kept in segments


class TraceError(Refusal):
    """A trace file that can't be read or run. `line` counts from 1, None where the whole file is meant."""

    kind = "trace"

    def __init__(self, file: str, line: int | None, reason: Message) -> None:
        super().__init__(reason.at(file, line))
        self.file, self.line, self.reason = file, line, reason

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        return self.reason.at(place)


def read_text(
    source: Target, name: str | None = None, advance: Callable[[int, int], None] = lambda done, total: None
) -> Trace:
    """Returns the trace in a path or an open text file; errors call it `name` (by default the path).

    `advance` is called with how many bytes of a path are read, and of how many; what it raises ends the reading.

    Raises TraceError for a file that is not a whole, canonical trace, OSError as `open`.
    """
    with opened(source, "r") as file:
        read = _bytes_read(file, advance) if file is not source else _nothing
        lines = _Lines(file, name or (str(source) if file is not source else "<trace>"), read)
        header, signals = _read_head(lines)
        changes = _Changes(lines, signals)
        end = changes.read()
        trailer = tuple(_remark(lines, line, count) for count, line in enumerate(lines))
    return changes.trace(header, end, trailer)


class _Lines:
    """The lines of one file, counted and bounded. Every refusal names the line it was met in."""

    def __init__(self, file: TextIO, name: str, tell: Callable[[], None]) -> None:
        self._file, self._name, self._tell, self.number = file, name, tell, 0

    def __iter__(self) -> Iterator[str]:
        while line := self._file.readline(LINE_LIMIT):
            self.number += 1
            if line[-1] != "\n":
                self.refuse(_bad_ending(line))
            if self.number % TOLD_EVERY == 0:
                self._tell()
            yield line[:-1]

    def refuse(self, reason: Message) -> NoReturn:
        raise TraceError(self._name, max(self.number, 1), reason)


def _bytes_read(file: TextIO, advance: Callable[[int, int], None]) -> Callable[[], None]:
    """Returns what tells how much of a file is read; one that grows meanwhile is never more than read."""
    size = os.fstat(file.fileno()).st_size
    return lambda: advance(min(file.buffer.tell(), size), size)


def _nothing() -> None:
    """Ignores how much of a file is read."""


def _bad_ending(line: str) -> Message:
    if len(line) == LINE_LIMIT:
        return Message("the line is longer than {count} characters", count=LINE_LIMIT)
    return Message("the line is not ended: the file was cut short; record it again")


def _read_head(lines: _Lines) -> tuple[tuple[tuple[str, str], ...], dict[str, bool]]:
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


def _check_magic(lines: _Lines, first: str) -> None:
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


def _declare(lines: _Lines, signals: dict[str, bool], declaration: str) -> None:
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


class _Changes:
    """The lines `TICK NAME VALUE`, each checked against the one before."""

    def __init__(self, lines: _Lines, signals: dict[str, bool]) -> None:
        self._lines, self._stimuli = lines, list(signals.values())
        self._names = list(signals)
        self._index = {name: index for index, name in enumerate(signals)}
        self._kinds = [named_signal_kind(name)[0] for name in signals]
        self._words: list[Vocabulary] = [{} for _ in signals]
        self._last: list[int | None] = [None] * len(signals)
        self._tick = 0
        self._ticks, self._signal, self._values = array("q"), array("i"), array("q")

    def read(self) -> int:
        """Reads all changes up to `end TICK`; returns that tick."""
        meaning = lru_cache(CHANGES_REMEMBERED)(self._meaning)  # the same changes come again and again
        place = -1
        for line in self._lines:
            word, _, change = line.partition(" ")
            if word == "end":
                return self._end(change)
            tick = self._number(word)
            index, value = meaning(change)
            previous, place = place, tick * len(self._names) + index
            if place <= previous:
                self._lines.refuse(
                    Message(
                        "tick {tick} {names}: out of order (by tick, then as declared)",
                        tick=tick,
                        names=self._names[index],
                    )
                )
            self._keep(tick, index, value)
        self._lines.refuse(Message("the file stops without 'end': it was cut short; record it again"))

    def trace(self, header: tuple[tuple[str, str], ...], end: int, trailer: tuple[str, ...]) -> Trace:
        """Returns the trace that was read. The columns are canonical already."""
        ticks, signal, values = map(np.asarray, (self._ticks, self._signal, self._values))  # the same memory
        return Trace(header, tuple(map(self._signal_at, range(len(self._names)))), ticks, signal, values, end, trailer)

    def _signal_at(self, index: int) -> Signal:
        name, words = self._names[index], tuple(self._words[index])
        kind, derived = named_signal_kind(name)
        return Signal(name, kind, self._stimuli[index], derived, names=words)

    def _keep(self, tick: int, index: int, value: int) -> None:
        if self._last[index] == value:
            self._lines.refuse(
                Message("{names} has this value already: only changes are listed", names=self._names[index])
            )
        if tick > 0 and self._tick == 0:
            self._check_tick_zero()
        if len(self._ticks) == CHANGES_LIMIT:
            self._lines.refuse(Message("more than {count} changes", count=CHANGES_LIMIT))
        self._last[index], self._tick = value, tick
        self._ticks.append(tick)
        self._signal.append(index)
        self._values.append(value)

    def _check_tick_zero(self) -> None:
        missing = [name for name, last in zip(self._names, self._last, strict=True) if last is None]
        if missing:
            self._lines.refuse(
                Message("signal {name} has no value at tick 0: tick 0 lists all signals", name=quoted(missing[0]))
            )

    def _end(self, word: str) -> int:
        end = self._number(word)
        if end > 0:
            self._check_tick_zero()
        if len(self._ticks) and self._tick >= end:
            self._lines.refuse(Message("end {end}, but there is a change at tick {tick}", end=end, tick=self._tick))
        return end

    def _number(self, word: str) -> int:
        """Returns a tick, which has one spelling only. Bounded before it is converted: int() of a
        long word takes long.
        """
        tick = int(word) if len(word) <= len(str(TICK_LIMIT)) and word.isdecimal() else -1
        if str(tick) != word or tick > TICK_LIMIT:
            self._lines.refuse(
                Message(
                    "{word} is no tick: a whole number up to {most}", word=quoted(word), most=TICK_LIMIT
                )
            )
        return tick

    def _meaning(self, change: str) -> tuple[int, int]:
        """Returns index and value of `NAME VALUE`."""
        name, _, word = change.partition(" ")
        index = self._index.get(name)
        if index is None:
            self._lines.refuse(Message("signal {name} is not declared above", name=quoted(name)))
        try:
            return index, KINDS[self._kinds[index]].read(word, self._words[index])
        except ValueError as error:
            self._lines.refuse(message_of(error).at(name))


def _remark(lines: _Lines, line: str, count: int) -> str:
    if count == REMARKS_LIMIT:
        lines.refuse(Message("more than {count} lines follow the end", count=REMARKS_LIMIT))
    remark = line.removeprefix("#").strip()
    if not line.startswith("#") or not remark.isprintable():
        lines.refuse(Message("{line} after the end: only # lines may follow", line=quoted(line)))
    return remark
