"""Gives a ticker the program, inputs, requests and gaps in time of a recorded run, each in its tick.

Rule: only what came from outside is taken from the trace; what the run put out is not looked at here.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

from drillctl.generation.feeder import Feeder
from drillctl.kmd import Request, RequestBit
from drillctl.kmd.queue import bit_and_value
from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.portio.playback import PlaybackCard
from drillctl.ports import CARD_BITS
from drillctl.replay.header import program_of
from drillctl.ticker.sampler import HAND_WORDS, REQUEST_WORDS
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Trace, TraceError
from drillctl.trace.segments import MOST_TICKS

BY_HAND = (Request.OUTPUT, Request.PACE)  # have a value, in a signal of their own


def playback(recorded: Trace, machine: Machine, file: Path) -> PlaybackCard:
    """A card whose inputs are the recorded ones. Raises TraceError for a trace that can't be run again."""
    if recorded.end > MOST_TICKS:
        raise TraceError(
            str(file),
            None,
            Message("{end} ticks; replay takes at most {most}", end=recorded.end, most=MOST_TICKS),
        )
    if recorded.header_values("overrun"):
        raise TraceError(
            str(file), None, Message("changes are missing (overrun): the recording fell behind; record it again")
        )
    if (tick := _tables_edited(recorded)) is not None:
        reason = Message(
            "tables were edited at tick {tick} (LOAD): what came after can't be told from one set of them", tick=tick
        )
        raise TraceError(str(file), None, reason)
    return PlaybackCard(*_inputs(recorded, machine, file))


class Player:
    """Gives a ticker the program of a recorded run, and its requests and gaps in time. Raises TraceError.

    The inputs come from the ticker's port: ``playback``, or a simulated card.
    """

    def __init__(self, ticker: Ticker, recorded: Trace, machine: Machine, file: Path):
        self._ticker = ticker
        self._feeder = Feeder(program_of(recorded, machine, file), ticker.queue)
        self._requests = _Stimulus(*_worded(recorded, "request", REQUEST_WORDS, file), recorded.end)
        self._hands = _Stimulus(*_worded(recorded, "hand", HAND_WORDS, file), recorded.end)
        self._gaps = _Stimulus(*_changes(recorded, "late"), recorded.end)
        self._rates = _Stimulus(*_rates(recorded, file), recorded.end)

    def up_to(self, end: int) -> Iterator[int]:
        """Runs on to tick ``end``, or until nothing goes on; yields the number of ticks run so far after each turn."""
        while self._ticker.controller.tick < end and self._turn(end):
            yield self._ticker.controller.tick

    def _turn(self, end: int) -> int:
        now = self._ticker.controller.tick
        self._feeder.feed()
        self._ticker.controller.gap = self._gaps.at(now)
        _ask(self._ticker, self._requests.at(now) << 1, self._hands.at(now), self._rates.at(now))
        return self._ticker.turn(before=min(end, self._requests.next_tick, self._gaps.next_tick))


class _Stimulus:
    """One thing that came from outside, by tick. ``at`` is called with rising ticks.

    next_tick  the tick from which on ``at`` must be called again: the next one while there is a value
    """

    def __init__(self, ticks: Sequence[int], values: Sequence[int], end: int):
        self._changes = [*zip(ticks, values, strict=True), (end, 0)]
        self._row = self._value = 0
        self.next_tick = 0

    def at(self, tick: int) -> int:
        """The value in a tick, 0 for none."""
        while self._changes[self._row][0] <= tick:
            self._value = self._changes[self._row][1]
            self._row += 1
        self.next_tick = tick + 1 if self._value else self._changes[self._row][0]
        return self._value


def _ask(ticker: Ticker, asked: int, hand: int, tick_hz: int) -> None:
    """Makes the requests of a tick: ``asked`` as bits of the mailbox, with the output or rate that was asked for."""
    for request in Request:
        if request not in BY_HAND and asked >> request & 1:
            ticker.requests.post(request)
    if hand and asked & RequestBit.OUTPUT:
        ticker.requests.set_output(*bit_and_value(hand))
    if tick_hz and asked & RequestBit.PACE:
        ticker.requests.set_rate(tick_hz)


def _tables_edited(recorded: Trace) -> int | None:
    """The first tick after a LOAD, from which on a run had other tables; None for none."""
    ticks, values = _changes(recorded, "request")
    signal = recorded.signals[recorded.index_of("request")] if ticks else None
    loads = (tick for tick, value in zip(ticks, values, strict=True) if signal and "LOAD" in signal.show(value))
    return next(loads, None)


def _inputs(trace: Trace, machine: Machine, file: Path) -> tuple[list[int], list[int]]:
    """Ticks at which a card's input word changes, and the input image from each of them on."""
    changes: dict[int, dict[int, int]] = {}
    for card in range(machine.cards):
        if not trace.has(f"in.{card}"):
            raise TraceError(
                str(file), None, Message("no signal in.{card}, which {machine} has", card=card, machine=machine.name)
            )
        for tick, value in zip(*(column.tolist() for column in trace.changes_of(f"in.{card}")), strict=True):
            changes.setdefault(tick, {})[card] = value
    words = [0] * machine.cards
    ticks, images = [], []
    for tick in sorted(changes):
        for card, value in changes[tick].items():
            words[card] = value
        ticks.append(tick)
        images.append(sum(value << CARD_BITS * card for card, value in enumerate(words)))
    return ticks, images


def _rates(trace: Trace, file: Path) -> tuple[list[int], list[int]]:
    """Ticks and values of the tick rates asked for (PACE). Raises TraceError for an impossible rate."""
    ticks, rates = _changes(trace, "pace")
    for tick, tick_hz in zip(ticks, rates, strict=True):
        if tick_hz and not SLOWEST_TICK_HZ <= tick_hz <= FASTEST_TICK_HZ:
            raise TraceError(
                str(file), None, Message("pace {hz} at tick {tick} is no tick rate", hz=tick_hz, tick=tick)
            )
    return ticks, rates


def _worded(trace: Trace, name: str, words: Sequence[str], file: Path) -> tuple[list[int], list[int]]:
    """Ticks at which a signal of words changes, and the index of each word in ``words``: a file has its own numbers."""
    ticks, values = _changes(trace, name)
    places = []
    for value in values:
        word = trace.signals[trace.index_of(name)].show(value)
        if word not in words:
            raise TraceError(str(file), None, Message("{name} {word!r} is not known", name=name, word=word))
        places.append(words.index(word))
    return ticks, places


def _changes(trace: Trace, name: str) -> tuple[list[int], list[int]]:
    """Ticks and values at which a signal changes; empty where it was not recorded."""
    if not trace.has(name):
        return [], []
    ticks, values = trace.changes_of(name)
    return ticks.tolist(), values.tolist()
