"""What a trace says of its run: its header written, and all of it read, that a ticker can be given it again.

Rule: the trace is believed in what came from outside: its program, inputs, requests and gaps in time; what it put out
is not looked at here. Called by desk, replay and rerun, and by whoever must know the machine of a trace.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import Job, names_of
from drillctl.kmd import KmdError, Request, RequestBit, parse_program, to_text
from drillctl.kmd.queue import bit_and_value
from drillctl.machine import Library, Machine
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.plant import PlantChoice
from drillctl.portio.playback import PlaybackCard
from drillctl.ports import CARD_BITS
from drillctl.ticker.link import Header
from drillctl.ticker.sampler import HAND_WORDS, REQUEST_WORDS
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Trace, TraceError
from drillctl.trace.segments import MOST_TICKS
from drillctl.trace.text import COMMAND

BY_HAND = (Request.OUTPUT, Request.PACE)  # have a value, in a signal of their own


def trace_header(job: Job, plant: Header) -> Iterator[tuple[str, str]]:
    """What a trace says of itself, enough to run it again; the machine is named by whoever writes the file. Put into
    words only where somebody wants it.
    """
    yield from [("machine", job.machine.name), ("digest", job.machine.digest), ("tick_hz", str(job.machine.tick_hz))]
    yield from plant
    names = names_of(job.machine)
    for record in job.program:
        yield "command", f"{record['sequence']} {to_text(record, names)}"


def header_value(trace: Trace, key: str, file: Path) -> str:
    """A value of the header. Raises TraceError where it is missing."""
    values = trace.header_values(key)
    if not values:
        raise TraceError(str(file), None, f"the header has no {key!r} line")
    return values[0]


def machine_of(trace: Trace, file: Path, library: Library) -> Machine:
    """The machine that a trace names: one of the library's, or a file relative to the trace. Raises TraceError for the
    trace, TableError for the machine.
    """
    named = header_value(trace, "machine", file)
    beside = file.parent / named
    found = library.machine(str(beside) if named.endswith(".toml") else named)
    rate = header_value(trace, "tick_hz", file)
    if not rate.isdecimal() or not SLOWEST_TICK_HZ <= int(rate) <= FASTEST_TICK_HZ:
        raise TraceError(str(file), None, f"tick_hz {rate!r} is no tick rate")
    return found.at_rate(int(rate))


def same_tables(trace: Trace, machine: Machine, file: Path) -> bool:
    """Whether a trace was recorded with the tables that ``machine`` has now."""
    return header_value(trace, "digest", file) == machine.digest


def choice_of(trace: Trace) -> PlantChoice:
    """The plant that a run was made on; ideal where its header tells of none. Raises PlantRefused."""
    described, seed = ("".join(trace.header_values(key)[:1]) for key in ("plant", "seed"))
    return PlantChoice.of_header(described, seed)


def check_tick(recorded: Trace, file: Path, tick: int) -> None:
    """Raises TraceError where a run has no such tick to begin at; any may begin at 0."""
    if tick and tick >= recorded.end:
        raise TraceError(str(file), None, f"no tick {tick}: it has {recorded.end} ticks, counted from 0 (--from-tick)")


def program_of(trace: Trace, machine: Machine, file: Path) -> NDArray[np.void]:
    """The program in a trace's header. Raises TraceError."""
    lines = trace.header_values(COMMAND)
    text = "\n".join(line.partition(" ")[2] for line in lines)
    try:
        program = parse_program(text, names_of(machine), str(file))
    except KmdError as error:
        raise TraceError(str(file), None, f"command {error.line}: {error.reason}") from error
    counted = all(line.partition(" ")[0] == str(number) for number, line in enumerate(lines, 1))
    if len(program) != len(lines) or not counted:
        raise TraceError(str(file), None, "the commands are not numbered from 1 to a KMD_KONIEC")
    return program


def playback(recorded: Trace, machine: Machine, file: Path) -> PlaybackCard:
    """The recorded inputs as a card. Raises TraceError for a trace that can't be run."""
    if recorded.end > MOST_TICKS:
        raise TraceError(str(file), None, f"{recorded.end} ticks; replay takes at most {MOST_TICKS}")
    if recorded.header_values("overrun"):
        raise TraceError(str(file), None, "changes are missing (overrun): the recording fell behind; record it again")
    if (tick := _tables_edited(recorded)) is not None:
        reason = f"tables were edited at tick {tick} (LOAD): what came after can't be told from one set of them"
        raise TraceError(str(file), None, reason)
    return PlaybackCard(*_inputs(recorded, machine, file))


class Player:
    """Gives a ticker the program of a recorded run, and its requests and gaps, each in its tick. Raises TraceError."""

    def __init__(self, ticker: Ticker, recorded: Trace, machine: Machine, file: Path):
        self._ticker = ticker
        self._feeder = Feeder(program_of(recorded, machine, file), ticker.queue)
        self._requests = _Stimulus(*_worded(recorded, "request", REQUEST_WORDS, file), recorded.end)
        self._hands = _Stimulus(*_worded(recorded, "hand", HAND_WORDS, file), recorded.end)
        self._gaps = _Stimulus(*_changes(recorded, "late"), recorded.end)
        self._rates = _Stimulus(*_rates(recorded, file), recorded.end)

    def up_to(self, end: int) -> Iterator[int]:
        """Runs on, up to tick ``end`` or to where nothing goes on; after each turn the ticks that were run so far."""
        while self._ticker.controller.tick < end and self._turn(end):
            yield self._ticker.controller.tick

    def _turn(self, end: int) -> int:
        now = self._ticker.controller.tick
        self._feeder.feed()
        self._ticker.controller.gap = self._gaps.at(now)
        _ask(self._ticker, self._requests.at(now) << 1, self._hands.at(now), self._rates.at(now))
        return self._ticker.turn(before=min(end, self._requests.next_tick, self._gaps.next_tick))


class _Stimulus:
    """What came from outside, tick by tick; ``at`` is asked with rising ticks.

    next_tick  the tick from which on ``at`` must be asked again: the next one while there is a value
    """

    def __init__(self, ticks: Sequence[int], values: Sequence[int], end: int):
        self._changes = [*zip(ticks, values, strict=True), (end, 0)]
        self._row = self._value = 0
        self.next_tick = 0

    def at(self, tick: int) -> int:
        """The value in a tick."""
        while self._changes[self._row][0] <= tick:
            self._value = self._changes[self._row][1]
            self._row += 1
        self.next_tick = tick + 1 if self._value else self._changes[self._row][0]
        return self._value


def _ask(ticker: Ticker, asked: int, hand: int, tick_hz: int) -> None:
    """What was asked in a tick: requests as bits of the mailbox, and the output or the rate that was set by hand."""
    for request in Request:
        if request not in BY_HAND and asked >> request & 1:
            ticker.requests.post(request)
    if hand and asked & RequestBit.OUTPUT:
        ticker.requests.set_output(*bit_and_value(hand))
    if tick_hz and asked & RequestBit.PACE:
        ticker.requests.set_rate(tick_hz)


def _tables_edited(recorded: Trace) -> int | None:
    """The first tick of a run that had other tables than those it began with."""
    ticks, values = _changes(recorded, "request")
    signal = recorded.signals[recorded.index_of("request")] if ticks else None
    loads = (tick for tick, value in zip(ticks, values, strict=True) if signal and "LOAD" in signal.show(value))
    return next(loads, None)


def _inputs(trace: Trace, machine: Machine, file: Path) -> tuple[list[int], list[int]]:
    """The input image from each tick at which a card's word changes."""
    changes: dict[int, dict[int, int]] = {}
    for card in range(machine.cards):
        if not trace.has(f"in.{card}"):
            raise TraceError(str(file), None, f"no signal in.{card}, which {machine.name} has")
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
    """Ticks and values of the tick rates asked for (PACE). Raises TraceError for what is none."""
    ticks, rates = _changes(trace, "pace")
    for tick, tick_hz in zip(ticks, rates, strict=True):
        if tick_hz and not SLOWEST_TICK_HZ <= tick_hz <= FASTEST_TICK_HZ:
            raise TraceError(str(file), None, f"pace {tick_hz} at tick {tick} is no tick rate")
    return ticks, rates


def _worded(trace: Trace, name: str, words: Sequence[str], file: Path) -> tuple[list[int], list[int]]:
    """Ticks at which a signal of words changes, and the places of its words among ours: a file numbers its own."""
    ticks, values = _changes(trace, name)
    places = []
    for value in values:
        word = trace.signals[trace.index_of(name)].show(value)
        if word not in words:
            raise TraceError(str(file), None, f"{name} {word!r} is not known")
        places.append(words.index(word))
    return ticks, places


def _changes(trace: Trace, name: str) -> tuple[list[int], list[int]]:
    """Ticks and values of a signal; none where it was not recorded."""
    if not trace.has(name):
        return [], []
    ticks, values = trace.changes_of(name)
    return ticks.tolist(), values.tolist()
