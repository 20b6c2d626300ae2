"""A run as the scope sees it (viewmodel/scope.py): what any run has, and the run of the machine in use.

Rule: values are found by searching the lanes, never by going through a run; what is not known is None, never a guess.
The run of a trace file is in scope_runs.py.
"""

from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from drillctl.console.scope_layout import KMD, LANDMARKS, RUN, lanes_of, lanes_with
from drillctl.generation.job import names_of
from drillctl.kmd import to_text
from drillctl.machine import AxisTable, Machine
from drillctl.ticker.sampler import EVERY_LANE, signals
from drillctl.trace import Signal
from drillctl.trace.lanes import Column, Lanes
from drillctl.trace.ring import CHANGE, RingRecorder
from drillctl.trace.tape_lanes import TapeColumn
from drillctl.trace.values import OPCODES
from drillctl.viewmodel.scope import AxisMoment, Changes, Find, Ints, Moment, Notice, ScopeSignal, Strip

MOST_ROWS = 4_000_000  # of a recording: 16 bytes each; drilling makes five of them a tick
MOST_WAITING = 500  # times that the ring was emptied while nobody looked
MOST_PROGRAMS = 500  # whose commands are remembered as they were written


class RunScope:
    """A ScopeSource over the signals of one machine. A subclass fills ``lanes`` and keeps ``last_tick``."""

    def __init__(self, name: str, machine: Machine, recorded: Sequence[Signal], most_rows: int):
        self.name, self.machine, self._recorded = name, machine, recorded
        self._laid = lanes_of(machine, recorded)
        self._signals = tuple(signal for signal, _lane in self._laid)
        self._index = {(signal.group, signal.name): number for number, signal in enumerate(self._signals)}
        self.lanes = Lanes([lane for _signal, lane in self._laid], most_rows)
        self.last_tick = -1
        self.opening_tick = 0

    @property
    def tick_hz(self) -> int:
        """Ticks a second, as the machine runs now."""
        return self.machine.tick_hz

    @property
    def first_tick(self) -> int:
        """The first tick that is still known: later than 0 once something was forgotten."""
        return self.lanes.first_tick

    def turn(self) -> None:
        """Takes in what was recorded since the last call; here nothing, as of a run that is complete."""

    def notices(self) -> tuple[Notice, ...]:
        """Notices of what was forgotten, and of the first tick at another tick rate."""
        forgotten = [Notice("forgotten", self.first_tick)] if self.first_tick else []
        pace = self._index.get((RUN, "pace"))
        changed = None if pace is None else self._column(pace).find(self.first_tick - 1, 1, onset=True)
        return (*forgotten, *([] if changed is None else [Notice("other rate", changed)]))

    def signals(self) -> tuple[ScopeSignal, ...]:
        """The signals, in the order in which they are numbered and drawn."""
        return self._signals

    def shown(self, signal: int, value: int, tick: int) -> str:
        """A value in words: a command as it was written, as far as that is remembered."""
        if self._signals[signal].group == KMD:
            return self._command_text(value, tick)
        return self._source(signal).show(value) if self._signals[signal].shape == "words" else str(value)

    def known_to(self, signal: int) -> int:
        """The tick up to which a signal is known: here to the end."""
        return self.last_tick + 1

    def window(self, signal: int, from_tick: int, to_tick: int) -> Changes:
        """The changes of a signal between two ticks; views into the lane, but for the first row."""
        return Changes(*self._column(signal).window(from_tick, to_tick))

    def strip(self, signal: int, edges: Ints) -> Strip:
        """What a signal does between each two neighbouring edges (n,) in ticks, by two binary searches each."""
        return Strip(*self._column(signal).strip(edges))

    def at(self, tick: int) -> Moment:
        """All values, the command and the axes in one tick, by a binary search in each lane."""
        values = tuple(self._value(number, tick) for number in range(len(self._signals)))
        command = values[self._index[KMD, "command"]] if (KMD, "command") in self._index else None
        axes = (_axis_moment(axis, self._named(axis.name, values)) for axis in self.machine.axes)
        text = self._command_text(command, tick) if command else ""
        return Moment(tick, text, values, tuple(filter(None, axes)))

    def find(self, what: Find, tick: int, direction: int, signal: int) -> int | None:
        """The nearest tick with an event in a direction (+1, -1), from any lane that can show it; None for none."""
        onset = what != "change" and LANDMARKS[what].onset
        lanes = (self._column(number) for number in lanes_with(what, signal, self._signals))
        found = [place for lane in lanes if (place := lane.find(tick, direction, onset)) is not None]
        within = [place for place in found if place <= self.last_tick]
        return (min(within) if direction > 0 else max(within)) if within else None

    def _value(self, signal: int, tick: int) -> int | None:
        known = self.first_tick <= tick < self.known_to(signal)
        return self._column(signal).at(tick) if known else None

    def _column(self, signal: int) -> Column | TapeColumn:
        """What answers for a signal."""
        return self.lanes.columns[signal]

    def _named(self, group: str, values: tuple[int | None, ...]) -> dict[str, int | None]:
        pairs = zip(self._signals, values, strict=True)
        return {signal.name: value for signal, value in pairs if signal.group == group}

    def _source(self, signal: int) -> Signal:
        return self._recorded[self._laid[signal][1].signal]

    def _command_text(self, value: int, tick: int) -> str:
        """Number and text of the command that runs in a tick; its name where the text is not remembered."""
        text = self._written(value // OPCODES, tick) if value else ""
        return f"{value // OPCODES} {text}" if text else self._source(self._index[KMD, "command"]).show(value)

    def _written(self, sequence: int, tick: int) -> str:
        """A command as it was written; empty where that is not known."""
        return ""


class RunRecording(RunScope):
    """The run of the machine in use, from its start: ``ring`` is filled by the ticker and emptied by ``keep``.

    ticks  returns how many the ticker has run
    """

    def __init__(self, machine: Machine, plant_lanes: Sequence[str], ring: RingRecorder, ticks: Callable[[], int]):
        super().__init__(machine.name, machine, signals(machine, plant_lanes, derived=True), MOST_ROWS)
        self._ring, self._ticks = ring, ticks
        self._waiting: list[NDArray[np.void]] = []
        self._programs: deque[tuple[int, int, NDArray[np.void]]] = deque(maxlen=MOST_PROGRAMS)

    @staticmethod
    def ring_for(machine: Machine) -> RingRecorder:
        """A ring with room for the signals of a machine, whatever plant it has."""
        return RingRecorder(len(signals(machine, EVERY_LANE, derived=True)))

    def keep(self) -> None:
        """Empties the ring. Cheap, and to be called often."""
        changes = self._ring.drain()
        if len(changes):
            self._waiting.append(changes)
        if len(self._waiting) > MOST_WAITING:
            self.turn()

    def begin(self, program: NDArray[np.void], commands_before: int) -> None:
        """Remembers a program whose commands run from the next tick on, numbered on from those before."""
        self._programs.append((self._ticks(), commands_before, program))

    def turn(self) -> None:
        """Sorts what was taken out of the ring into the lanes."""
        self.last_tick = self._ticks() - 1
        self._waiting.append(self._ring.drain())
        changes = np.concatenate([np.zeros(0, CHANGE), *self._waiting])
        self._waiting.clear()
        self.lanes.append(changes["tick"], changes["signal"], changes["value"])

    def notices(self) -> tuple[Notice, ...]:
        """What is to be known of the run, as for any; also that changes were lost because the ring was full."""
        return (*super().notices(), *[Notice("behind")] * self._ring.overrun)

    def _written(self, sequence: int, tick: int) -> str:
        index = bisect_right(self._programs, tick, key=lambda each: each[0]) - 1
        if index < 0:
            return ""
        _from_tick, before, program = self._programs[index]
        row = sequence - before - 1
        return to_text(program[row], names_of(self.machine)) if 0 <= row < len(program) else ""


def _axis_moment(axis: AxisTable, values: dict[str, int | None]) -> AxisMoment | None:
    """An axis from its signals' values; None where its column, position or state is not known."""
    position, state, column = (values.get(name) for name in ("position", "state", "column"))
    if position is None or state is None or column is None:
        return None
    rows = ((wire.name, "".join("x" if on else "." for on in wire.forward)) for wire in axis.phase.wires)
    wires = tuple((name, row, bool(values.get(name))) for name, row in rows)
    return AxisMoment(axis.name, position, position / axis.steps_per_mm, state, axis.ramp.top, column, wires)
