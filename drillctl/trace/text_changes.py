"""The lines `TICK NAME VALUE` of a trace in text form, each checked against the one before; up to `end TICK`.

Rule: a page of lines is gone through at once where it holds nothing but proper changes. Any other page is gone through
line by line, so that what is wrong with it is found where it is.
"""

from array import array
from collections.abc import Generator, Iterator

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message, message_of
from drillctl.trace.record import TICK_LIMIT, Signal
from drillctl.trace.stretches import Stretch
from drillctl.trace.text_lines import Lines
from drillctl.trace.values import KINDS, Values, Vocabulary, named_signal_kind, quoted

CHANGES_REMEMBERED = 1 << 16  # different `NAME VALUE`
VALUE_BITS = 40  # of a value in `_meanings`; it is stored above LOWEST
LOWEST = -(1 << 32)
TICK_DIGITS = len(str(TICK_LIMIT))
BLANK, LINE_END, ZERO = b" \n0"


class TextChanges:
    """The changes of a file whose head has been read. `end` is known when all stretches have been taken."""

    def __init__(self, lines: Lines, signals: dict[str, bool]) -> None:
        self._lines, self._stimuli = lines, list(signals.values())
        self._names = list(signals)
        self._index = {name: index for index, name in enumerate(signals)}
        self._kinds = [named_signal_kind(name)[0] for name in signals]
        self._words: list[Vocabulary] = [{} for _ in signals]
        self._last: list[int | None] = [None] * len(signals)
        self._tick, self._place = 0, -1
        self._meanings: dict[str, int] = {}  # of `NAME VALUE`: the signal's index, and the value in VALUE_BITS
        self._ticks, self._signal, self._values = array("q"), array("i"), array("q")
        self.end = 0

    def stretches(self) -> Iterator[Stretch]:
        """Yields the changes in the order of the file. Raises TraceError."""
        singly = 1  # lines that are gone through one by one before a whole page is tried
        for line in self._lines:
            word, _, change = line.partition(" ")
            if word == "end":
                self.end = self._end(change)
                yield self._taken()
                return
            self._keep(self._number(word), change)
            singly -= 1
            if singly <= 0 and self._tick > 0:
                yield self._taken()
                singly = yield from self._pages()
        self._lines.refuse(Message("the file stops without 'end': it was cut short; record it again"))

    def signals(self) -> tuple[Signal, ...]:
        """Returns the signals as they were declared, with the words that were met so far."""
        return tuple(map(self._signal_at, range(len(self._names))))

    def _signal_at(self, index: int) -> Signal:
        name, words = self._names[index], tuple(self._words[index])
        kind, derived = named_signal_kind(name)
        return Signal(name, kind, self._stimuli[index], derived, names=words)

    def _pages(self) -> Generator[Stretch, None, int]:
        """Yields whole pages of changes; returns the number of lines in the first that is not one."""
        while page := self._lines.page():
            stretch = self._page(page)
            if stretch is None:
                break
            self._lines.skip(len(page))
            yield stretch
        return len(page)

    def _page(self, page: list[str]) -> Stretch | None:
        """Returns the changes of a page; None where a line of it must be looked at by itself."""
        found = _ticks_of(page)
        if found is None:
            return None
        ticks, begins = found
        changes = [line[begin:] for line, begin in zip(page, begins.tolist(), strict=True)]
        meanings = np.array(self._meanings_of(changes), np.int64)
        if (meanings < 0).any():
            return None
        signal, values = meanings >> VALUE_BITS, (meanings & (1 << VALUE_BITS) - 1) + LOWEST
        places = ticks * len(self._names) + signal
        if places[0] <= self._place or (np.diff(places) <= 0).any() or ticks[-1] > TICK_LIMIT:
            return None
        if not self._all_change(signal, values):
            return None
        self._tick, self._place = int(ticks[-1]), int(places[-1])
        return Stretch(self._tick + 1, ticks, signal.astype(np.int32), values)

    def _all_change(self, signal: Values, values: Values) -> bool:
        """Returns whether no row (n,) repeats its signal's value; keeps the last value of each, if so."""
        order = np.argsort(signal.astype(np.int16), kind="stable")
        signal, values = signal[order], values[order]
        joins = signal[1:] == signal[:-1]
        if (joins & (values[1:] == values[:-1])).any():
            return False
        firsts, lasts = np.append(True, ~joins), np.append(~joins, True)
        present = signal[firsts].tolist()
        if any(self._last[n] == value for n, value in zip(present, values[firsts].tolist(), strict=True)):
            return False
        for n, value in zip(present, values[lasts].tolist(), strict=True):
            self._last[n] = value
        return True

    def _meanings_of(self, changes: list[str]) -> list[int]:
        """Returns the meaning of each `NAME VALUE` (n,); -1 where there is none."""
        known = self._meanings
        try:
            return [known[change] for change in changes]
        except KeyError:
            if len(known) > CHANGES_REMEMBERED:
                known.clear()
            for change in dict.fromkeys(changes):  # in the order of the file, in which words are numbered
                if change not in known:
                    known[change] = self._packed(change)
            return [known[change] for change in changes]

    def _packed(self, change: str) -> int:
        name, _, word = change.partition(" ")
        index = self._index.get(name)
        if index is None:
            return -1
        try:
            value = KINDS[self._kinds[index]].read(word, self._words[index])
        except ValueError:
            return -1
        return (index << VALUE_BITS) + value - LOWEST

    def _taken(self) -> Stretch:
        """Returns the changes that were kept line by line, and removes them."""
        columns = np.array(self._ticks), np.array(self._signal, np.int32), np.array(self._values)
        for column in (self._ticks, self._signal, self._values):
            del column[:]
        return Stretch(self._tick + 1, *columns)

    def _keep(self, tick: int, change: str) -> None:
        index, value = self._meaning(change)
        previous, self._place = self._place, tick * len(self._names) + index
        if self._place <= previous:
            self._lines.refuse(
                Message(
                    "tick {tick} {names}: out of order (by tick, then as declared)",
                    tick=tick,
                    names=self._names[index],
                )
            )
        if self._last[index] == value:
            self._lines.refuse(
                Message("{names} has this value already: only changes are listed", names=self._names[index])
            )
        if tick > 0 and self._tick == 0:
            self._check_tick_zero()
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
        if self._place >= 0 and self._tick >= end:
            self._lines.refuse(Message("end {end}, but there is a change at tick {tick}", end=end, tick=self._tick))
        return end

    def _number(self, word: str) -> int:
        """Returns a tick, which has one spelling only. Bounded before it is converted: int() of a
        long word takes long.
        """
        tick = int(word) if len(word) <= TICK_DIGITS and word.isdecimal() else -1
        if str(tick) != word or tick > TICK_LIMIT:
            self._lines.refuse(
                Message("{word} is no tick: a whole number up to {most}", word=quoted(word), most=TICK_LIMIT)
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


def _ticks_of(page: list[str]) -> tuple[Values, Values] | None:
    """Returns the ticks that the lines (n,) begin with, and where each line goes on behind the blank; None where one
    has no tick in its only spelling.
    """
    text = np.frombuffer("\n".join(["", *page]).encode("ascii", "replace"), np.uint8)
    begins = np.flatnonzero(text == LINE_END) + 1
    blanks = np.append(np.flatnonzero(text == BLANK), len(text))
    ends = blanks[np.searchsorted(blanks, begins)]
    digits = ends - begins
    if not 1 <= digits.min() <= digits.max() <= TICK_DIGITS or ends[-1] == len(text):
        return None
    if ((text[begins] == ZERO) & (digits > 1)).any():
        return None
    ticks = np.zeros(len(begins), np.int64)
    for place in range(int(digits.max())):
        digit = _digit_at(text, begins + place) * (place < digits)
        if (digit > 9).any():
            return None
        ticks = np.where(place < digits, 10 * ticks + digit, ticks)
    return ticks, digits + 1


def _digit_at(text: NDArray[np.uint8], places: Values) -> Values:
    """Returns the digits at these places (n,); more than 9 where there is none."""
    digits: Values = (text[np.minimum(places, len(text) - 1)] - np.uint8(ZERO)).astype(np.int64)
    return digits
