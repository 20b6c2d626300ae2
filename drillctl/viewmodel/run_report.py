"""A recorded run as a report tells it: facts, holes, axes, commands, events and waves. Made by lab/run_report.py, drawn
by ui/report.

Rule: plain data, in the units of a person: seconds, millimetres, steps.
"""

import msgspec
import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.viewmodel.reports import BoardPlan

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class ReportAxis(msgspec.Struct, frozen=True, eq=False):
    """One axis over time, in ``n`` stretches of equal length.

    speed_mm_s, rotor_mm_s  (n,) commanded, and of the rotor (empty on the ideal plant)
    lag_steps               (n,) the greatest distance of the rotor behind its column, in full steps (empty likewise)
    lost_steps              at the end, in steps of the ramp
    travelled_mm            the way of the whole run, both directions added
    """

    name: str
    speed_mm_s: Floats
    rotor_mm_s: Floats
    lag_steps: Floats
    lost_steps: int
    travelled_mm: float


class ReportCommand(msgspec.Struct, frozen=True):
    """A command as it was run: from its first tick up to, not including, ``end_tick``."""

    sequence: int
    text: str
    first_tick: int
    end_tick: int


class ReportEvent(msgspec.Struct, frozen=True):
    """Something that is no command: a request, a fault, a gap in time."""

    tick: int
    words: Message


class ReportWave(msgspec.Struct, frozen=True, eq=False):
    """A signal's changes: (n,) ticks and values; ``is_wire``: 0 and 1."""

    name: str
    is_wire: bool
    ticks: Ints
    values: Ints


class RunReport(msgspec.Struct, frozen=True, eq=False):
    """A run. ``holes``: in mm from where the machine was switched on. ``waves_to``: the tick up to which the waves go;
    all of the run where it is not longer.
    """

    name: str
    machine: str
    description: str
    plant: str
    tick_hz: int
    ticks: int
    fault: tuple[str, Message, Message] | None  # name, cause, remedy
    holes: BoardPlan
    axes: tuple[ReportAxis, ...]
    commands: tuple[ReportCommand, ...]
    events: tuple[ReportEvent, ...]
    waves: tuple[ReportWave, ...]
    waves_to: int

    @property
    def seconds(self) -> float:
        """How long the run was, by its ticks."""
        return self.ticks / self.tick_hz


class Comparison(msgspec.Struct, frozen=True):
    """Two runs compared. ``tick``: the first that differs, None where none does; ``lines``: about a dozen that show it,
    ``first`` marked by ``-`` and ``second`` by ``+``.
    """

    first: str
    second: str
    tick: int | None
    lines: tuple[str, ...] = ()
