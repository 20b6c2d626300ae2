"""What the scope may see and ask: the signals of a run, windows of them, and the machine at any of its ticks.

Rule: as console.py has it: nothing raises for what a person did. A signal is named by its index in ``signals``; ticks
count from 0 as in a trace, and a value at a tick is that after its flush.
"""

from collections.abc import Sequence
from typing import Literal, Protocol

import msgspec
import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.viewmodel.console import Problems, Watch

Ints = NDArray[np.int64]
Shape = Literal["wire", "count", "words"]
Find = Literal["change", "step", "command", "sensor", "request", "late", "fault"]
Lack = Literal["forgotten", "behind", "running", "underivable", "too long", "other tables", "other rate"]
FORWARDS, BACKWARDS = 1, -1


class ScopeSignal(msgspec.Struct, frozen=True):
    """A lane of the scope. ``group``: an axis's name, sensors, outputs, kmd, run or plant."""

    group: str
    name: str
    shape: Shape


class Changes(msgspec.Struct, frozen=True, eq=False):
    """A signal in a window of ticks: the value that stands at its start, then every change; (n,) each, ticks rising."""

    ticks: Ints
    values: Ints


class Strip(msgspec.Struct, frozen=True, eq=False):
    """A signal in n stretches of ticks, as many as there are columns to draw: the value at the end of each, and how
    often it changed in it, (n,) each. A pulse is counted however short it is; two changes may stand for more."""

    values: Ints
    changes: Ints


class AxisMoment(msgspec.Struct, frozen=True):
    """An axis at a tick: as AxisView has it, without a target, which no trace tells."""

    name: str
    position_steps: int
    position_mm: float
    state: int
    top_state: int
    column: int  # from 1
    wires: tuple[tuple[str, str, bool], ...]  # name, row of the phase table in x and ., lit then


class Moment(msgspec.Struct, frozen=True):
    """The machine at a tick. ``values``: of every signal, None where it is not known; ``axes``: those that are."""

    tick: int
    command: str
    values: tuple[int | None, ...]
    axes: tuple[AxisMoment, ...]


class Notice(msgspec.Struct, frozen=True):
    """Something that a run lacks, and the number or reason that belongs to it."""

    lack: Lack
    value: int | Message = 0


class ScopeSource(Protocol):
    """One run: it may go on, and its oldest part may be forgotten, while it is looked at."""

    @property
    def name(self) -> str:
        """The name of the machine or of the file."""

    @property
    def tick_hz(self) -> int:
        """The tick rate, in ticks a second."""

    @property
    def first_tick(self) -> int:
        """The earliest tick that is kept."""

    @property
    def last_tick(self) -> int:
        """The latest tick; below ``first_tick`` while nothing has run."""

    @property
    def opening_tick(self) -> int:
        """The tick at which a finished run is opened."""

    def turn(self) -> None:
        """Reads what is new in the run; returns soon."""

    def notices(self) -> Sequence[Notice]:
        """What the run lacks, and why."""

    def signals(self) -> Sequence[ScopeSignal]:
        """The lanes from top to bottom; always the same ones."""

    def shown(self, signal: int, value: int, tick: int) -> str:
        """The text for a value that the signal has in a tick."""

    def known_to(self, signal: int) -> int:
        """The first tick for which the signal is not known, or not yet."""

    def window(self, signal: int, from_tick: int, to_tick: int) -> Changes:
        """Every change in from_tick..to_tick-1; none as long as nothing is known of the signal."""

    def strip(self, signal: int, edges: Ints) -> Strip:
        """The stretches between rising ``edges``, (n+1,): as quick for a whole run as for a moment of it."""

    def at(self, tick: int) -> Moment:
        """The machine at a tick, found without running up to it."""

    def find(self, what: Find, tick: int, direction: int, signal: int) -> int | None:
        """The nearest tick after (or before) ``tick`` with such an event: ``change`` is one of the signal; ``step`` is
        one of the signal's axis, or of any where the signal is of none."""


class RunOpening(Protocol):
    """Opens runs for the scope."""

    def running(self) -> ScopeSource:
        """The run of the machine at hand, since it was chosen."""

    def open_trace(self, file: str, watch: Watch) -> tuple[ScopeSource | None, Problems]:
        """The run in a trace file; None and the reason where it can't be read. ``watch``: as Console.load has it."""
