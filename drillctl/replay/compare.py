"""Runs a recorded run again, without plant, clock or process, and compares; or records it anew.

Rule: inputs, requests and gaps in time come from the trace, everything else from the tables at hand; two traces are
compared by what they put out.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from drillctl.files.outputs import Output
from drillctl.generation.waits import Advance, Waits, ignored, reading, unwatched
from drillctl.language import Message
from drillctl.machine import Library, Machine
from drillctl.plant import PlantChoice, PlantRefused
from drillctl.replay.header import check_tick, header_value, machine_of, same_tables
from drillctl.replay.player import Player, playback
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.sampler import wire_names
from drillctl.ticker.ticker import TICK, Ticker
from drillctl.trace import Difference, Segments, Trace, TraceError, first_difference, render
from drillctl.trace.files import read_record, read_trace, summary_of, takes_segments, whole_trace, write_record

RUNNING_AGAIN = Message("running it again")


@dataclass(frozen=True, repr=False)
class Verdict:
    """The result of a replay.

    difference   the first one; None where there is none
    same_tables  the trace was recorded with the tables it was replayed with
    from_tick    the ticks before were not compared
    """

    machine: Machine
    recorded: Trace
    actual: Trace
    difference: Difference | None
    same_tables: bool
    from_tick: int = 0

    def __repr__(self) -> str:
        found = self.headline() if self.difference else "no tick differs"
        return f"<Verdict: {found}: {self.remark()}>"

    def failed(self, same_tables_wanted: bool = False) -> bool:
        """Whether the behaviour differs or, where that is wanted, the tables do."""
        return self.difference is not None or (same_tables_wanted and not self.same_tables)

    def headline(self) -> str:
        """One line: the first tick that differs and its command; that the tables differ; or that nothing does."""
        found = self.difference
        if found is None:
            return "no tick differs" if self.same_tables else "recorded with other tables"
        command = _command_line(self.recorded, found.command)
        return f"differs at tick {found.tick}, " + (f"in command {command}" if command else "between commands")

    def remark(self) -> str:
        """One line: how many ticks on which machine, from where compared, and whether the tables differ."""
        since = f", judged from tick {self.from_tick} on" if self.from_tick else ""
        others = "" if self.same_tables else "; recorded with other tables, judged by behaviour"
        return f"{self.recorded.end} ticks on {self.machine.name}{since}{others}"

    def message(self) -> str:
        """About a dozen lines that show the first difference."""
        if self.difference is None:
            if self.same_tables:
                return self.headline()
            return "the tables are not those of the recording (--same-tables)"
        return render(self.difference, wire_names(self.machine))


def replay(
    file: Path, library: Library, engine: str | None = None, from_tick: int = 0, waits: Waits = unwatched
) -> Verdict:
    """Runs a trace again by an engine (None: fast where possible) and compares it from a tick on. On the ideal plant
    the ticks before are run in whole commands by either engine. ``waits`` is called with how far the work is. Raises
    TraceError for a file that is no trace, can't be run or is shorter; TableError for its machine.
    """
    kept = read_record(file, waits(reading(file.name)))
    head = kept.rest if isinstance(kept, Segments) else kept
    machine = machine_of(head, file, library)
    check_tick(head, file, from_tick)
    same = same_tables(head, machine, file)
    if isinstance(kept, Segments) and engine != TICK and taped_again(head, machine, file, waits).like(kept):
        return Verdict(machine, head, head, None, same, from_tick)
    recorded = whole_trace(kept, file) if isinstance(kept, Segments) else kept
    actual = _actual(recorded, machine, file, engine, from_tick, waits)
    return Verdict(machine, recorded, actual, first_difference(recorded, actual, from_tick=from_tick), same, from_tick)


def in_form_of(file: Path, trace: Trace, machine: Machine, waits: Waits = unwatched) -> Trace | Segments:
    """A trace in the form of a file of this name; in the segment form with as few segments as possible."""
    if not takes_segments(file, machine.cards):
        return trace
    taped = taped_again(trace, machine, file, waits)
    return taped if taped.change_count == len(trace.ticks) and taped.trace() == trace else Segments.of_trace(trace)


def segments_of_text(file: Path, out: Path, library: Library, waits: Waits = unwatched) -> Segments | None:
    """The run of a text trace in segments, to be written to ``out``; None where the tables at hand do not make the same
    run of it on the ideal plant. The memory it takes grows with the commands. Raises as ``replay``.
    """
    kept = summary_of(file, waits(reading(file.name)))
    machine = machine_of(kept.rest, file, library)
    if not takes_segments(out, machine.cards):
        return None
    taped = taped_again(kept.rest, machine, file, waits)
    return taped if kept.of(taped) else None


def taped_again(recorded: Trace, machine: Machine, file: Path, waits: Waits = unwatched) -> Segments:
    """Runs a trace again on the ideal plant and returns the record in the segment form. Raises TraceError."""
    ticker = FastTicker.ideal(machine, taped=True)
    _run(Player(ticker, recorded, machine, file), recorded.end, waits(RUNNING_AGAIN))
    segments = ticker.record(recorded.header)
    assert isinstance(segments, Segments)
    return segments


def record_again(file: Path, library: Library) -> None:
    """Runs a trace's commands and requests on its simulated machine and writes the file anew. Raises as replay."""
    old = read_trace(file)
    machine = machine_of(old, file, library)
    try:
        choice = PlantChoice.of_header(header_value(old, "plant", file), header_value(old, "seed", file))
        ticker = Ticker.simulated(machine, traced=True, plant_choice=choice)
    except PlantRefused as error:
        raise TraceError(str(file), None, error.message) from error
    _run(Player(ticker, old, machine, file), old.end)
    header = [(key, machine.digest if key == "digest" else value) for key, value in old.header]
    recorded = _trace_of(ticker, old)
    write_record(in_form_of(file, replace(recorded, header=tuple(header)), machine), Output(file))


def _actual(
    recorded: Trace, machine: Machine, file: Path, engine: str | None, from_tick: int, waits: Waits
) -> Trace:
    """The run by the tables at hand. Where the ideal plant gives just the recorded inputs, the fast engine runs it."""
    ticker = Ticker(machine, playback(recorded, machine, file), traced=True)
    if engine != TICK or from_tick:
        fast = FastTicker.ideal(machine, traced=True)
        player = Player(fast, recorded, machine, file)
        advance = waits(RUNNING_AGAIN)
        _run(player, from_tick, advance)
        fast.in_batches = engine != TICK
        _run(player, recorded.end, advance)
        actual = _trace_of(fast, recorded)
        if all(_same_changes(recorded, actual, f"in.{number}") for number in range(machine.cards)):
            return actual
    _run(Player(ticker, recorded, machine, file), recorded.end, waits(RUNNING_AGAIN))
    return _trace_of(ticker, recorded)


def _command_line(recorded: Trace, shown: str) -> str:
    """A command shown as ``6:KMD_GOTOdXdY`` with its arguments: ``6 KMD_GOTOdXdY 30 0``; an empty text for none."""
    number, _, name = shown.partition(":")
    lines = (value for key, value in recorded.header if key == "command")
    return next((line for line in lines if line.startswith(f"{number} ")), f"{number} {name}" if name else "")


def _same_changes(first: Trace, second: Trace, name: str) -> bool:
    return all(map(np.array_equal, first.changes_of(name), second.changes_of(name)))


def _run(player: Player, end: int, advance: Advance = ignored) -> None:
    for ticks in player.up_to(end):
        advance(ticks, end)


def _trace_of(ticker: Ticker, recorded: Trace) -> Trace:
    """The trace that a ticker made, under the header of the recorded run."""
    trace = ticker.finished_trace(recorded.header)
    assert trace is not None
    return trace
