"""The run of a trace file as the scope sees it. What the file leaves out is found by running it again.

Rule: the file is shown at once, and the axes at the cursor with it; the waves of columns, positions and states follow,
and those of the dynamic plant that a run was made on, a little at every turn, so that no screen waits for a long run.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from drillctl.console.machine_console import MachineConsole
from drillctl.console.readiness import BUSY
from drillctl.console.scope import RunRecording, RunScope
from drillctl.generation.waits import Waits, reading, unwatched
from drillctl.language import Message
from drillctl.machine import Library, Machine, TableError
from drillctl.plant import Plant, PlantRefused
from drillctl.plant.choice import DYNAMIC
from drillctl.ports import CARD_BITS
from drillctl.replay.derived_signals import AxisState, Jumps, rerun
from drillctl.replay.header import check_tick, choice_of, machine_of, same_tables
from drillctl.ticker.sampler import signals
from drillctl.trace import Segments, Signal, Trace, TraceError
from drillctl.trace.files import read_record
from drillctl.trace.lanes import Column
from drillctl.trace.segments import OUTPUT
from drillctl.trace.tape_lanes import TapeColumn, TapeView
from drillctl.trace.values import IDLE, Values
from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.scope import Notice

TURN_S = 0.025  # of the screen's beat of 50 ms, while there is something left to run
MOST_ROWS = 20_000_000  # 16 bytes each
LAYING_OUT = Message("laying out the waves")


class TraceFile(RunScope):
    """A ScopeSource, opened at a tick; ``waits`` is called with how far the work is. Raises TraceError for a file that
    is no trace or has no such tick, TableError for its machine.
    """

    def __init__(self, file: Path, library: Library, from_tick: int = 0, waits: Waits = unwatched):
        record = read_record(file, waits(reading(file.name)))
        waits(LAYING_OUT)
        recorded = record.rest if isinstance(record, Segments) else record
        machine = machine_of(recorded, file, library)
        check_tick(recorded, file, from_tick)
        plant = _dynamic(recorded, machine)
        sampled = signals(machine, plant.lanes if plant else (), True)
        derived = [signal for signal in sampled if signal.derived]
        missing = [signal for signal in derived if not recorded.has(signal.name)]
        own, values = _idle_first(recorded)
        if isinstance(record, Segments):  # its outputs are looked at in the segments, and have no rows
            own += [signal for signal in record.signals if not recorded.has(signal.name)]
        super().__init__(f"{file.name} ({machine.name})", machine, (*own, *missing), MOST_ROWS)
        self._outputs = self._taped(record) if isinstance(record, Segments) else {}
        self.lanes.append(recorded.ticks, recorded.signal, values)
        self.last_tick, self.opening_tick = recorded.end - 1, from_tick
        self._commands = dict(value.split(" ", 1) for value in recorded.header_values("command") if " " in value)
        self._missing = {signal.name for signal in missing}
        self._other_tables = not same_tables(recorded, machine, file)
        self._trouble: Notice | None = None
        self._derivation = self._derived(recorded, machine, file, plant, sampled) if missing else iter(())
        self._known_to = 0 if missing else recorded.end
        self._jumps = self._able_to_jump(recorded, machine, file) if missing else None
        self._here: tuple[int, tuple[AxisState, ...]] = (-1, ())

    def turn(self) -> None:
        """Runs the trace on, for TURN_S at most."""
        until_s = time.monotonic() + TURN_S
        while self._known_to <= self.last_tick and not self._trouble and time.monotonic() < until_s:
            self._known_to = next(self._derivation, self._known_to)

    def known_to(self, signal: int) -> int:
        """The tick up to which a signal is known: a derived one as far as the run has come."""
        return self._known_to if self._source(signal).name in self._missing else self.last_tick + 1

    def notices(self) -> tuple[Notice, ...]:
        """How far the run has come, and why its derived signals may be wrong or missing."""
        found = [*super().notices()]
        if self._trouble:
            found.append(self._trouble)
        elif self._known_to <= self.last_tick:
            found.append(Notice("running", 100 * self._known_to // (self.last_tick + 1)))
        if self._missing and self._other_tables:
            found.append(Notice("other tables"))
        return tuple(found)

    def _column(self, signal: int) -> Column | TapeColumn:
        """Like the base class's; an output of a run in segments is looked at there."""
        return self._outputs.get(signal) or super()._column(signal)

    def _taped(self, segments: Segments) -> dict[int, TapeColumn]:
        """What answers for each lane that is a bit of the outputs."""
        view, found = TapeView(segments), {}
        for number, (_shown, lane) in enumerate(self._laid):
            card = OUTPUT.fullmatch(self._recorded[lane.signal].name)
            if card and lane.bit is not None:
                found[number] = TapeColumn(view, CARD_BITS * int(card[1]) + lane.bit, lane.invert)
        return found

    def _value(self, signal: int, tick: int) -> int | None:
        """Like the base class's; of an axis also in a tick that the run has not reached yet."""
        if self._known_to <= tick <= self.last_tick and self._source(signal).name in self._missing:
            return self._far_value(signal, tick)
        return super()._value(signal, tick)

    def _far_value(self, signal: int, tick: int) -> int | None:
        """A value found by a jump to its tick. None where a jump can't find it; then none is tried again."""
        if self._jumps is not None and self._here[0] != tick:
            self._here = tick, self._jumps.at(tick)
            if not self._here[1]:
                self._jumps = None
        states = dict(zip(self.machine.axis_names, self._here[1], strict=False)) if self._here[0] == tick else {}
        shown = self._signals[signal]
        value: int | None = getattr(states.get(shown.group), shown.name, None)
        return value

    def _able_to_jump(self, recorded: Trace, machine: Machine, file: Path) -> Jumps | None:
        try:
            return Jumps(recorded, machine, file)
        except TraceError as error:
            self._trouble = Notice("underivable", error.reason)
            return None

    def _derived(self, recorded: Trace, machine: Machine, file: Path, plant: Plant | None, sampled: list[Signal]
                 ) -> Iterator[int]:  # fmt: skip
        """Runs the trace again and fills the derived lanes; yields the tick up to which they are known."""
        place = self._places(sampled)
        try:
            for stretch in rerun(recorded, machine, file, plant):
                rows = np.flatnonzero(place[stretch.signal] >= 0)
                if len(self.lanes) + len(rows) > MOST_ROWS:
                    self._trouble = Notice("too long", self._known_to)
                    return
                self.lanes.append(stretch.ticks[rows], place[stretch.signal[rows]], stretch.values[rows])
                yield stretch.end
            yield recorded.end
        except TraceError as error:
            self._trouble = Notice("underivable", error.reason)

    def _places(self, sampled: list[Signal]) -> "np.ndarray[tuple[int], np.dtype[np.int32]]":
        """(n,): for each signal of the run its number in this source; -1 for those that the file has itself."""
        own = {signal.name: number for number, signal in enumerate(self._recorded)}
        return np.array([own[each.name] if each.name in self._missing else -1 for each in sampled], np.int32)

    def _written(self, sequence: int, tick: int) -> str:
        return self._commands.get(str(sequence), "")


def _dynamic(recorded: Trace, machine: Machine) -> Plant | None:
    """A new dynamic plant like the one that a run was made on; None for another kind, or where it can't be built."""
    try:
        choice = choice_of(recorded)
        return choice.build(machine) if choice.kind == DYNAMIC else None
    except PlantRefused:
        return None


def _idle_first(trace: Trace) -> tuple[list[Signal], Values]:
    """Signals and values with each signal's words numbered anew, the idle word 0: a file numbers them as they come."""
    values, own = trace.values.copy(), list(trace.signals)
    for index, signal in enumerate(trace.signals):
        if signal.kind == "name":
            names = (IDLE, *(name for name in signal.names if name != IDLE))
            rows = trace.signal == index
            values[rows] = np.array([names.index(name) for name in signal.names], np.int64)[values[rows]]
            own[index] = replace(signal, names=names)
    return own, values


class ScopeRuns:
    """A RunOpening (viewmodel/scope.py): the run of the machine in use, and those of trace files."""

    def __init__(self, library: Library, console: MachineConsole):
        self._library, self._console = library, console

    def running(self) -> RunRecording:
        """The run of the machine in use; another one once another machine was chosen."""
        return self._console.recording

    def open_trace(self, file: str, watch: Watch = unwatched) -> tuple[TraceFile | None, Problems]:
        """Opens a trace file. Refused while the machine is at work: a long file takes longer than a ticker waits."""
        if self._console.at_work:
            return None, (BUSY,)
        try:
            return TraceFile(Path(file), self._library, waits=watch), ()
        except (TraceError, TableError) as error:
            return None, error.messages
