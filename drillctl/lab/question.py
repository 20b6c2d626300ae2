"""What a sweep asks: every machine of a grid, and what is tried with it.

Rule: a question is data; its machine number n is always the same one, on any computer. Its digest tells two questions
apart.
"""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from math import prod
from random import Random

import numpy as np

from drillctl.lab.board import Board, scaled
from drillctl.lab.errors import LabError
from drillctl.lab.trials import check_moves
from drillctl.language import Message, known_words
from drillctl.machine import AxisTable, Dynamics
from drillctl.machine.phase import PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.plant.dynamic.coefficients import SUBSTEPS

PARAMETERS = tuple(field.name for field in fields(Dynamics) if field.type is float)
SPREAD = ("resistance_ohm", "inductance_h", "torque_nm_per_a", "inertia_kgm2", "viscous_nms", "coulomb_nm")
SLOWEST_HZ, FASTEST_HZ = 50, 20_000  # below 50 Hz a tick has more substeps
MOST_MACHINES = 10_000_000
LONGEST_STEPS = 100_000
FACTORS = 0.001, 1000  # of a parameter of the dynamics
GREATEST_LOAD_NM = 100
LAW = f"dynamic {SUBSTEPS}"  # of the plant: to be changed with its equations


@dataclass(frozen=True, slots=True)
class Variant:
    """One machine: its tables, its motor with its load, and which of the question's values these are; ``scales``: by
    which factors its dynamics differ from the axis's own.
    """

    axis: AxisTable
    dynamics: Dynamics
    phase: str
    tick_hz: int
    load_nm: float
    draw: int
    scales: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Question:
    """A grid of machines. Raises LabError for one that can't be tried.

    phases   (name, table) pairs; their wires are the axis's
    times    (parameter of the dynamics, multiples of the axis's own value) pairs
    loads_nm what resists besides
    steps    moves tried, both ways, from every kind of rest
    board    what the machines drill, in place of moves of the axis; None: they make the moves
    draws    machines at each point of the grid, each parameter of SPREAD drawn within ``spread`` of its value
    """

    axis: AxisTable
    rates_hz: tuple[int, ...]
    ramps: tuple[RampTable, ...]
    phases: tuple[tuple[str, PhaseTable], ...]
    times: tuple[tuple[str, tuple[float, ...]], ...]
    loads_nm: tuple[float, ...]
    steps: tuple[int, ...]
    draws: int = 1
    spread: float = 0.0
    seed: int = 0
    board: Board | None = None

    def __post_init__(self) -> None:
        if self.axis.dynamics is None:
            raise LabError(
                Message("axis {name} has no dynamics; docs/PLANT.md says how to name some", name=self.axis.name)
            )
        if self.board is None:
            check_moves(self.axis.dynamics)
        for name, _ in self.times:
            if name not in PARAMETERS:
                raise LabError(
                    Message("no parameter {name!r}; {words}", name=name, words=known_words(name, PARAMETERS))
                )
        _check_same_once([name for name, _ in self.times])
        for name, table in self.phases:
            for axis in self._varied():
                _check_wires(name, table, axis.phase)
        if self.machines > MOST_MACHINES:
            raise LabError(
                Message(
                    "{machines} machines; a sweep has {most_machines} at most",
                    machines=self.machines,
                    most_machines=MOST_MACHINES,
                )
            )

    def _varied(self) -> list[AxisTable]:
        return [self.axis] if self.board is None else [self.board.machine.axes[index] for index in self.board.axes]

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each factor of the grid has, the one that changes slowest first."""
        multiples = (len(values) for _, values in self.times)
        return len(self.phases), len(self.ramps), len(self.rates_hz), *multiples, len(self.loads_nm), self.draws

    @property
    def machines(self) -> int:
        """How many machines the grid has."""
        return prod(self.shape)

    @property
    def digest(self) -> str:
        """16 hex digits over everything that the results depend on."""
        return hashlib.sha256(repr((LAW, self, self.axis.dynamics)).encode()).hexdigest()[:16]

    def variant(self, number: int) -> Variant:
        """The machine with this number, counted from 0; where a board is drilled, its first axis that is varied."""
        phase, ramp, rate, *multiples, load, draw = (int(place) for place in np.unravel_index(number, self.shape))
        name, table = self.phases[phase]
        axis = replace(self.axis, phase=table, ramp=self.ramps[ramp])
        scales = {key: values[place] for (key, values), place in zip(self.times, multiples, strict=True)}
        drawn = self._drawn(draw)
        dynamics = scaled(replace(axis, dynamics=scaled(axis, scales)), drawn)
        both = {key: scales.get(key, 1.0) * drawn.get(key, 1.0) for key in {**scales, **drawn}}
        return Variant(axis, dynamics, name, self.rates_hz[rate], self.loads_nm[load], draw, both)

    def _drawn(self, draw: int) -> dict[str, float]:
        """The factors of a draw: the same everywhere on the grid, so that its points can be compared."""
        if not self.spread:
            return {}
        random = Random(f"{self.seed} {draw}")
        return {name: 1 + self.spread * random.uniform(-1, 1) for name in SPREAD}


def _check_same_once(names: Sequence[str]) -> None:
    if twice := [name for name in names if names.count(name) > 1]:
        raise LabError(Message("{twice} is varied twice", twice=twice[0]))


def _check_wires(name: str, table: PhaseTable, own: PhaseTable) -> None:
    if table.wire_names() != own.wire_names():
        needs = " ".join(own.wire_names())
        raise LabError(
            Message(
                "phase table {name} has the wires {names}; the axis has {needs}",
                name=name,
                names=" ".join(table.wire_names()),
                needs=needs,
            )
        )
