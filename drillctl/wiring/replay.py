"""Wiring: a recorded run again, without plant, clock or process; and the plugin's re-recording.

Rule: inputs, requests and gaps in time come from the trace, everything else from the tables at hand; two traces are
compared by what they put out. Called by the replay verb and by the pytest plugin.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.feeder import Feeder
from drillctl.generation.job import names_of
from drillctl.kmd import KmdError, Request, parse_program
from drillctl.machine import Library, Machine
from drillctl.machine.shape import FASTEST_TICK_HZ, SLOWEST_TICK_HZ
from drillctl.portio.playback import PlaybackCard
from drillctl.ports import CARD_BITS
from drillctl.trace import Difference, Trace, TraceError, first_difference, read_text, render, write_text
from drillctl.wiring.outputs import Output
from drillctl.wiring.sampler import REQUEST_WORDS
from drillctl.wiring.ticker import Ticker

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


def replay(file: Path, library: Library) -> Verdict:
    """Runs a trace again. Raises TraceError for a file that is no trace or can't be run, TableError for its machine."""
    recorded = _read(file)
    machine = machine_of(recorded, file, library)
    if recorded.end > MOST_TICKS:
        raise TraceError(str(file), None, f"{recorded.end} ticks; replay takes at most {MOST_TICKS}")
    if recorded.header_values("overrun"):
        raise TraceError(str(file), None, "changes are missing (overrun): the recording fell behind; record it again")
    card = PlaybackCard(*_inputs(recorded, machine, file))
    actual = _run(Ticker(machine, card, traced=True), recorded, program_of(recorded, machine, file), file)
    difference = first_difference(recorded, actual)
    return Verdict(machine, recorded, actual, difference, _header(recorded, "digest", file) == machine.digest)


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
    old = _read(file)
    machine = machine_of(old, file, library)
    ticker = Ticker.simulated(machine, traced=True)
    recorded = _run(ticker, old, program_of(old, machine, file), file)
    header = [(key, machine.digest if key == "digest" else value) for key, value in old.header]
    Output(file).write(lambda target: write_text(replace(recorded, header=tuple(header)), target))


def _run(ticker: Ticker, recorded: Trace, program: NDArray[np.void], file: Path) -> Trace:
    """The program, the recorded requests and gaps, to the recorded end; where the job outlasts it, to the job's end."""
    feeder = Feeder(program, ticker.queue)
    requests = _Stimulus(*_requests(recorded, file), recorded.end)
    gaps = _Stimulus(*_changes(recorded, "late"), recorded.end)
    while (now := ticker.controller.tick) < recorded.end:
        feeder.feed()
        ticker.controller.gap = gaps.at(now)
        asked = requests.at(now)
        for request in Request:
            if asked >> request & 1:
                ticker.requests.post(request)
        upcoming = min(requests.next_tick, gaps.next_tick)
        if not ticker.run(min(max(1, len(ticker.queue)), upcoming - now)):
            break
    trace = ticker.finished_trace(recorded.header)
    assert trace is not None
    return trace


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


def _requests(trace: Trace, file: Path) -> tuple[list[int], list[int]]:
    """Ticks at which the requests served change, and what they are from there on, as bits of the mailbox."""
    ticks, values = _changes(trace, "request")
    masks = []
    for value in values:
        word = trace.signals[trace.index_of("request")].show(value)
        if word not in REQUEST_WORDS:
            raise TraceError(str(file), None, f"request {word!r} is not known")
        masks.append(REQUEST_WORDS.index(word) << 1)
    return ticks, masks


def _changes(trace: Trace, name: str) -> tuple[list[int], list[int]]:
    """Ticks and values of a signal; none where it was not recorded."""
    if not trace.has(name):
        return [], []
    ticks, values = trace.changes_of(name)
    return ticks.tolist(), values.tolist()


def _read(file: Path) -> Trace:
    try:
        return read_text(file)
    except OSError as error:
        raise TraceError(str(file), None, f"can't be read: {error.strerror}") from error


def _header(trace: Trace, key: str, file: Path) -> str:
    values = trace.header_values(key)
    if not values:
        raise TraceError(str(file), None, f"the header has no {key!r} line")
    return values[0]
