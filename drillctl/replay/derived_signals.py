"""What a trace leaves out (columns, positions and states of the axes), found by running it again.

Rule: while the ideal plant gives the inputs that were recorded, whole commands are run at once; as soon as it doesn't,
every tick is run on the recorded inputs. Both find the same. A plant to be watched is driven by the outputs once more,
tick by tick; its sensors are not read.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drillctl.kmd.queue import CAPACITY
from drillctl.machine import Machine
from drillctl.plant import Plant
from drillctl.portio.simulated import WatchedCard
from drillctl.replay.player import Player, playback
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.sampler import signals
from drillctl.ticker.ticker import Ticker
from drillctl.trace import Recorder, Trace
from drillctl.trace.stretches import Stretch


class AxisState(NamedTuple):
    """An axis in a tick: column from 1, position in steps, state of its ramp."""

    column: int
    position: int
    state: int


def rerun(recorded: Trace, machine: Machine, file: Path, watched: Plant | None = None) -> Iterator[Stretch]:
    """Runs a trace again and yields it stretch by stretch: ``sampler.signals``, with derived ones and the lanes of the
    plant. ``watched``: a new plant of the kind that the run was made on, whose lanes are wanted too. Raises TraceError
    before the first stretch.
    """
    card = playback(recorded, machine, file)
    recorder = Recorder(signals(machine, watched.lanes if watched else (), derived=True))
    if watched is not None:
        beside = WatchedCard(card, watched)
        seen = Ticker(machine, beside, watched, traced=True, derived=True, keeper=recorder)
        yield from _stretches(seen, recorder, recorded, machine, file)
        return
    fast = FastTicker.ideal(machine, traced=True, capacity=CAPACITY, keeper=recorder)
    agreed_to, inputs = 0, _Inputs(recorded, machine)
    for stretch in _stretches(fast, recorder, recorded, machine, file):
        if not inputs.agree(stretch):
            break
        agreed_to = stretch.end
        yield stretch
    else:
        return
    recorder = Recorder(recorder.signals)
    ticker = Ticker(machine, card, traced=True, derived=True, keeper=recorder)
    for stretch in _stretches(ticker, recorder, recorded, machine, file):
        if stretch.end > agreed_to:
            yield _since(stretch, agreed_to)


def with_columns(recorded: Trace, machine: Machine, file: Path) -> Trace:
    """The whole run as a trace with its derived signals and an empty header. Raises TraceError."""
    whole = Recorder(signals(machine, (), derived=True))
    end = 0
    for stretch in rerun(recorded, machine, file):
        end = stretch.end
        whole.add(*stretch[1:])
    return whole.finish(end)


class Jumps:
    """Finds the axes in any tick of a run quickly: whole commands are run on the way there. Raises TraceError for a
    trace that can't be run.
    """

    _agrees: bool
    _recorder: Recorder

    def __init__(self, recorded: Trace, machine: Machine, file: Path):
        playback(recorded, machine, file)  # or a refusal
        self._recorded, self._machine, self._file = recorded, machine, file
        self._begin()

    def at(self, tick: int) -> tuple[AxisState, ...]:
        """The axes in a tick; empty where every tick must be run, as the inputs are not those of the ideal plant."""
        if tick < self._ticker.controller.tick - 1:
            self._begin()
        for end in self._player.up_to(tick + 1):
            self._agrees = self._agrees and self._inputs.agree(Stretch(end, *self._recorder.drain()))
        if not self._agrees or self._ticker.controller.tick != tick + 1:
            return ()
        return tuple(AxisState(axis.column + 1, axis.position, axis.state) for axis in self._ticker.controller.axes)

    def _begin(self) -> None:
        self._ticker = FastTicker.ideal(self._machine, taped=True)
        self._player = Player(self._ticker, self._recorded, self._machine, self._file)
        self._inputs, self._agrees = _Inputs(self._recorded, self._machine), True
        assert self._ticker.sampler is not None and isinstance(self._ticker.sampler.recorder, Recorder)
        self._recorder = self._ticker.sampler.recorder


class _Inputs:
    """Compares the inputs of a repeated run with the recorded ones, stretch after stretch."""

    def __init__(self, recorded: Trace, machine: Machine):
        numbers = {signal.name: number for number, signal in enumerate(signals(machine, (), False))}
        names = [f"in.{card}" for card in range(machine.cards)]
        self._recorded = [(numbers[name], *recorded.changes_of(name)) for name in names]
        self._last = [-1] * len(names)  # which no port word is
        self._until = 0

    def agree(self, stretch: Stretch) -> bool:
        """Whether every input word changes in the same ticks to the same value as recorded."""
        since, self._until = self._until, stretch.end
        return all(self._agrees(card, stretch, since) for card in range(len(self._recorded)))

    def _agrees(self, card: int, stretch: Stretch, since: int) -> bool:
        number, ticks, values = self._recorded[card]
        within = slice(*np.searchsorted(ticks, (since, stretch.end)))
        rows = np.flatnonzero(stretch.signal == number)
        news = rows[np.diff(stretch.values[rows], prepend=self._last[card]) != 0]
        self._last[card] = int(stretch.values[rows[-1]]) if len(rows) else self._last[card]
        same_ticks = np.array_equal(stretch.ticks[news], ticks[within])
        return same_ticks and np.array_equal(stretch.values[news], values[within])


def _stretches(ticker: Ticker, recorder: Recorder, recorded: Trace, machine: Machine, file: Path) -> Iterator[Stretch]:
    """Plays a recorded run to a ticker, which writes to the recorder; yields what was recorded."""
    for end in Player(ticker, recorded, machine, file).up_to(recorded.end):
        yield Stretch(end, *recorder.drain())


def _since(stretch: Stretch, tick: int) -> Stretch:
    """The changes from a tick on."""
    rows = stretch.ticks >= tick
    return Stretch(stretch.end, stretch.ticks[rows], stretch.signal[rows], stretch.values[rows])
