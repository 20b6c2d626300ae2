"""A table tried on bench motors: what its columns do to a rotor, and the steps that a motor loses with it.

Rule: as console.py has it: nothing raises for what a person did. The motors are simulated apart from the machine at
hand, which does not move.
"""

from typing import Protocol

import msgspec

from drillctl.viewmodel.console import Problems, Watch
from drillctl.viewmodel.tables import TableKind


class PathColumn(msgspec.Struct, frozen=True):
    """A column of a phase table that is put out and held.

    place   where the rotor comes to rest, in columns of its motor from the beginning of the cycle
    torque  the greatest torque that holds it there, without forcing; 1 is that of a single winding, 0: it is free
    """

    place: float
    torque: float


class CyclePath(msgspec.Struct, frozen=True):
    """A rotor that follows a phase table for one cycle, column by column, slowly.

    motor       the axis whose motor it is; empty where no motor of the machine fits, and then there are no columns
    in_use      whether this axis has the table
    turned      columns of the motor from the beginning of the cycle to its end; ``wanted``: of a sound table
    torque_mnm  of a single winding in mN m, None where the motor's dynamics are not known
    """

    motor: str = ""
    in_use: bool = False
    columns: tuple[PathColumn, ...] = ()
    turned: float = 0.0
    wanted: int = 0
    torque_mnm: float | None = None


class MotorRun(msgspec.Struct, frozen=True):
    """The moves of one motor with a table; the rest is of the move that lost the most.

    dynamic  False: the motor has no dynamics, so an ideal one was run, which loses steps to wrong tables alone
    lost     steps at the end: commanded less reached
    steps    the length of the move, negative for backwards
    behind   steps that the rotor is behind, tick by tick
    """

    motor: str
    dynamic: bool
    moves: int
    lost: int
    steps: int
    behind: tuple[float, ...]


class BenchReport(msgspec.Struct, frozen=True):
    """What a table did at a tick rate; ``in_use``: it was tried on all motors that have it, else on one that fits."""

    tick_hz: int
    in_use: bool
    runs: tuple[MotorRun, ...]

    @property
    def lost(self) -> bool:
        """Whether any motor lost a step."""
        return any(run.lost for run in self.runs)

    @property
    def worst(self) -> MotorRun:
        """The run of the motor that lost the most, or that was behind by most."""
        return max(self.runs, key=lambda run: (abs(run.lost), max(map(abs, run.behind), default=0.0)))


class Bench(Protocol):
    """Motors to try a table on, those of the machine at hand; and this computer, as the one that makes the ticks."""

    def path(self, name: str, text: str) -> CyclePath:
        """What a phase table does to a rotor in one cycle; no columns for a text that can't be read."""

    def run(self, kind: TableKind, name: str, text: str, watch: Watch) -> tuple[BenchReport | None, Problems]:
        """Moves of many lengths, both ways, with this table; None and the reasons where it can't be tried. ``watch``:
        as Console.load has it.
        """

    def carried_hz(self, tick_hz: int, watch: Watch) -> tuple[int | None, Problems]:
        """Measures for some seconds how late ticks at this rate begin; the greatest usual tick rate that this computer
        carries, 0 for none; None and the reason where it can't be measured.
        """
