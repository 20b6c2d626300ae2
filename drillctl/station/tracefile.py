"""Wiring: the run of a ``.trace`` file as the scope sees it. What the text leaves out is found by running it again.

Rule: the file is shown at once; columns, positions and states follow, a little at every turn, so that nothing has to
wait for a long run. Created by the scope verb and by scopebench.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from drillctl.machine import Library, Machine
from drillctl.panel.scope import Notice
from drillctl.station.scope import RunScope
from drillctl.trace import Signal, Trace, TraceError
from drillctl.trace.ring import RingRecorder
from drillctl.trace.values import IDLE, Values
from drillctl.wiring.replay import machine_of, rerun, same_tables
from drillctl.wiring.sampler import signals
from drillctl.wiring.trace_files import read_trace

TURN_S = 0.025  # of the screen's beat of 50 ms, while there is something left to run
MOST_ROWS = 20_000_000  # 16 bytes each


class TraceFile(RunScope):
    """A ScopeSource. Raises TraceError for a file that is no trace, TableError for its machine."""

    def __init__(self, file: Path, library: Library):
        recorded = read_trace(file)
        machine = machine_of(recorded, file, library)
        derived = [signal for signal in signals(machine, False, True) if signal.derived]
        missing = [signal for signal in derived if not recorded.has(signal.name)]
        own, values = _idle_first(recorded)
        super().__init__(f"{file.name} ({machine.name})", machine, (*own, *missing), MOST_ROWS)
        self.lanes.append(recorded.ticks, recorded.signal, values)
        self.last_tick = recorded.end - 1
        self._commands = dict(value.split(" ", 1) for value in recorded.header_values("command") if " " in value)
        self._missing = {signal.name for signal in missing}
        self._other_tables = not same_tables(recorded, machine, file)
        self._trouble: Notice | None = None
        self._derivation = self._derived(recorded, machine, file) if missing else iter(())
        self._known_to = 0 if missing else recorded.end

    def turn(self) -> None:
        """The run again, for as long as a screen can wait."""
        until_s = time.monotonic() + TURN_S
        while self._known_to <= self.last_tick and not self._trouble and time.monotonic() < until_s:
            self._known_to = next(self._derivation, self._known_to)

    def known_to(self, signal: int) -> int:
        """Derived signals as far as the run has come."""
        return self._known_to if self._source(signal).name in self._missing else self.last_tick + 1

    def notices(self) -> tuple[Notice, ...]:
        """How far the run has come, and what it can't tell."""
        found = [*super().notices()]
        if self._trouble:
            found.append(self._trouble)
        elif self._known_to <= self.last_tick:
            found.append(Notice("running", 100 * self._known_to // (self.last_tick + 1)))
        if self._missing and self._other_tables:
            found.append(Notice("other tables"))
        return tuple(found)

    def _derived(self, recorded: Trace, machine: Machine, file: Path) -> Iterator[int]:
        """Runs the trace again, its derived signals into the lanes; gives the tick up to which they are known."""
        sampled = signals(machine, False, True)
        ring = RingRecorder(len(sampled))
        place = self._places(sampled)
        try:
            for ticks in rerun(recorded, machine, file, ring):
                changes = ring.drain()
                changes = changes[place[changes["signal"]] >= 0]
                if len(self.lanes) + len(changes) > MOST_ROWS:
                    self._trouble = Notice("too long", self._known_to)
                    return
                self.lanes.append(changes["tick"], place[changes["signal"]], changes["value"])
                yield ticks
            yield recorded.end
        except TraceError as error:
            self._trouble = Notice("underivable", error.reason)

    def _places(self, sampled: list[Signal]) -> "np.ndarray[tuple[int], np.dtype[np.int32]]":
        """For each signal of the run where it stands among ours; -1 for those that the file has itself."""
        own = {signal.name: number for number, signal in enumerate(self._recorded)}
        return np.array([own[each.name] if each.name in self._missing else -1 for each in sampled], np.int32)

    def _written(self, sequence: int, tick: int) -> str:
        return self._commands.get(str(sequence), "")


def _idle_first(trace: Trace) -> tuple[list[Signal], Values]:
    """Signals and values, words numbered anew so that none is 0, as in a run: a file numbers them as they come."""
    values, own = trace.values.copy(), list(trace.signals)
    for index, signal in enumerate(trace.signals):
        if signal.kind == "name":
            names = (IDLE, *(name for name in signal.names if name != IDLE))
            rows = trace.signal == index
            values[rows] = np.array([names.index(name) for name in signal.names], np.int64)[values[rows]]
            own[index] = replace(signal, names=names)
    return own, values
