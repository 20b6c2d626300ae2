"""Wiring: a recorded run again, without plant, clock or process; and the plugin's re-recording.

Rule: inputs, requests and gaps in time come from the trace, everything else from the tables at hand; two traces are
compared by what they put out. Called by the replay verb, by the pytest plugin, and by the scope.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import names_of
from drillctl.kmd import KmdError, Request, RequestBit, parse_program
from drillctl.kmd.queue import bit_and_value
from drillctl.machine import Library, Machine
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.plant import PlantChoice, PlantRefused
from drillctl.portio.playback import PlaybackCard
from drillctl.ports import CARD_BITS
from drillctl.trace import Difference, Segments, Trace, TraceError, first_difference, render
from drillctl.wiring.fast_ticker import TICK, FastTicker
from drillctl.wiring.outputs import Output
from drillctl.wiring.sampler import HAND_WORDS, REQUEST_WORDS, Keeper
from drillctl.wiring.ticker import Ticker
from drillctl.wiring.trace_files import read_record, read_trace, takes_segments, write_record

MOST_TICKS = 100_000_000


@dataclass(frozen=True)
class Verdict:
    """What came of a replay. ``same_tables``: the trace was recorded with the tables it was replayed with."""

    machine: Machine
    recorded: Trace
    actual: Trace
    difference: Difference | None
    same_tables: bool

    def failed(self, same_tables_wanted: bool = False) -> bool:
        """The behaviour differs, or (where that was asked for) the tables do."""
        return self.difference is not None or (same_tables_wanted and not self.same_tables)

    def remark(self) -> str:
        """How many ticks, on what, and whether the tables were others."""
        others = "" if self.same_tables else "; recorded with other tables, judged by behaviour"
        return f"{self.recorded.end} ticks on {self.machine.name}{others}"

    def message(self) -> str:
        """The first difference, in a dozen lines."""
        if self.difference is None:
            return "the tables are not those of the recording (--same-tables)"
        return render(self.difference)


def replay(file: Path, library: Library, engine: str | None = None) -> Verdict:
    """Runs a trace again, by this engine (None: fast where it can). Raises TraceError for a file that is no trace or
    can't be run, TableError for its machine.
    """
    kept = read_record(file)
    head = kept.rest if isinstance(kept, Segments) else kept
    machine = machine_of(head, file, library)
    if isinstance(kept, Segments) and engine != TICK and taped_again(head, machine, file).like(kept):
        return Verdict(machine, head, head, None, same_tables(head, machine, file))
    recorded = kept.trace() if isinstance(kept, Segments) else kept
    actual = _actual(recorded, machine, file, engine)
    difference = first_difference(recorded, actual)
    return Verdict(machine, recorded, actual, difference, same_tables(recorded, machine, file))


def in_form_of(file: Path, trace: Trace, machine: Machine) -> Trace | Segments:
    """A trace as a file of this name keeps it: as few segments as may be, where it asks for segments."""
    if not takes_segments(file, machine.cards):
        return trace
    taped = taped_again(trace, machine, file)
    return taped if taped.trace() == trace else Segments.of_trace(trace)


def taped_again(recorded: Trace, machine: Machine, file: Path) -> Segments:
    """A run's commands, requests and gaps on the ideal plant, in the segment form. Raises TraceError."""
    ticker = FastTicker.ideal(machine, taped=True)
    for _tick in _steps(ticker, recorded, program_of(recorded, machine, file), file):
        pass
    segments = ticker.record(recorded.header)
    assert isinstance(segments, Segments)
    return segments


def _actual(recorded: Trace, machine: Machine, file: Path, engine: str | None) -> Trace:
    """What the tables at hand make of the recorded inputs. Where the ideal plant gives just these, it may answer."""
    card, program = _playback(recorded, machine, file), program_of(recorded, machine, file)
    if engine != TICK:
        actual = _run(FastTicker.ideal(machine, traced=True), recorded, program, file)
        if all(_same_changes(recorded, actual, f"in.{number}") for number in range(machine.cards)):
            return actual
    return _run(Ticker(machine, card, traced=True), recorded, program, file)


def _same_changes(first: Trace, second: Trace, name: str) -> bool:
    return all(map(np.array_equal, first.changes_of(name), second.changes_of(name)))


def rerun(recorded: Trace, machine: Machine, file: Path, keeper: Keeper) -> Iterator[int]:
    """Runs a trace again a little at a time; every signal, derived ones too, goes into ``keeper``.

    The iterator runs at most a queue's length of ticks a turn, and gives how many were run so far. Raises TraceError
    before the first of them.
    """
    ticker = Ticker(machine, _playback(recorded, machine, file), traced=True, derived=True, keeper=keeper)
    return _steps(ticker, recorded, program_of(recorded, machine, file), file)


def same_tables(trace: Trace, machine: Machine, file: Path) -> bool:
    """Whether a trace was recorded with the tables that ``machine`` has now."""
    return _header(trace, "digest", file) == machine.digest


def machine_of(trace: Trace, file: Path, library: Library) -> Machine:
    """The machine that a trace names: one of the library's, or a file relative to the trace."""
    named = _header(trace, "machine", file)
    beside = file.parent / named
    found = library.machine(str(beside) if named.endswith(".toml") else named)
    rate = _header(trace, "tick_hz", file)
    if not rate.isdecimal() or not SLOWEST_TICK_HZ <= int(rate) <= FASTEST_TICK_HZ:
        raise TraceError(str(file), None, f"tick_hz {rate!r} is no tick rate")
    return found.at_rate(int(rate))


def program_of(trace: Trace, machine: Machine, file: Path) -> NDArray[np.void]:
    """The program in a trace's header. Raises TraceError."""
    lines = [value.partition(" ") for value in trace.header_values("command")]
    text = "\n".join(command for _, _, command in lines)
    try:
        program = parse_program(text, names_of(machine), str(file))
    except KmdError as error:
        raise TraceError(str(file), None, f"command {error.line}: {error.reason}") from error
    if [number for number, _, _ in lines] != [str(n) for n in program["sequence"].tolist()]:
        raise TraceError(str(file), None, "the commands are not numbered from 1 to a KMD_KONIEC")
    return program


def record_again(file: Path, library: Library) -> None:
    """Runs a trace's commands and requests on its simulated machine and writes the file anew. Raises as replay."""
    old = read_trace(file)
    machine = machine_of(old, file, library)
    try:
        choice = PlantChoice.of_header(_header(old, "plant", file), _header(old, "seed", file))
        ticker = Ticker.simulated(machine, traced=True, plant_choice=choice)
    except PlantRefused as error:
        raise TraceError(str(file), None, str(error)) from error
    recorded = _run(ticker, old, program_of(old, machine, file), file)
    header = [(key, machine.digest if key == "digest" else value) for key, value in old.header]
    write_record(in_form_of(file, replace(recorded, header=tuple(header)), machine), Output(file))


def _run(ticker: Ticker, recorded: Trace, program: NDArray[np.void], file: Path) -> Trace:
    """To the end, and what came of it."""
    for _tick in _steps(ticker, recorded, program, file):
        pass
    trace = ticker.finished_trace(recorded.header)
    assert trace is not None
    return trace


def _steps(ticker: Ticker, recorded: Trace, program: NDArray[np.void], file: Path) -> Iterator[int]:
    """The program, the recorded requests and gaps, to the recorded end; where the job outlasts it, to the job's end."""
    feeder = Feeder(program, ticker.queue)
    requests = _Stimulus(*_worded(recorded, "request", REQUEST_WORDS, file), recorded.end)
    hands = _Stimulus(*_worded(recorded, "hand", HAND_WORDS, file), recorded.end)
    gaps = _Stimulus(*_changes(recorded, "late"), recorded.end)
    while (now := ticker.controller.tick) < recorded.end:
        feeder.feed()
        ticker.controller.gap = gaps.at(now)
        _ask(ticker, requests.at(now) << 1, hands.at(now))
        upcoming = min(requests.next_tick, gaps.next_tick)
        if not ticker.turn(before=upcoming):
            break
        yield ticker.controller.tick


def _ask(ticker: Ticker, asked: int, hand: int) -> None:
    """What was asked in a tick: requests as bits of the mailbox, and the output that was set by hand."""
    for request in Request:
        if request != Request.OUTPUT and asked >> request & 1:
            ticker.requests.post(request)
    if hand and asked & RequestBit.OUTPUT:
        ticker.requests.set_output(*bit_and_value(hand))


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


def _playback(recorded: Trace, machine: Machine, file: Path) -> PlaybackCard:
    """The recorded inputs as a card. Raises TraceError for a trace that can't be run."""
    if recorded.end > MOST_TICKS:
        raise TraceError(str(file), None, f"{recorded.end} ticks; replay takes at most {MOST_TICKS}")
    if recorded.header_values("overrun"):
        raise TraceError(str(file), None, "changes are missing (overrun): the recording fell behind; record it again")
    if (tick := _tables_edited(recorded)) is not None:
        reason = f"tables were edited at tick {tick} (LOAD): what came after can't be told from one set of them"
        raise TraceError(str(file), None, reason)
    return PlaybackCard(*_inputs(recorded, machine, file))


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


def _header(trace: Trace, key: str, file: Path) -> str:
    values = trace.header_values(key)
    if not values:
        raise TraceError(str(file), None, f"the header has no {key!r} line")
    return values[0]
