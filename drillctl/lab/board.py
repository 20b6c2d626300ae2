"""A board that many machines are to drill: its program, the axes whose tables are varied, and where its holes belong.

Rule: nothing of it depends on the variant but the tick rate, in which waits are counted. The holes belong where the
ideal plant drills them.
"""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from drillctl.lab.dynamic_rerun import plane_of
from drillctl.lab.errors import LabError
from drillctl.lab.trials import FULL_STEPS_PER_CYCLE
from drillctl.language import Message
from drillctl.machine import AxisTable, Dynamics, Machine
from drillctl.machine.phase import PhaseTable
from drillctl.machine.ramp import RampTable
from drillctl.plant import IDEAL_PLANT, PlantChoice
from drillctl.plant.choice import DYNAMIC
from drillctl.ticker.link import Touch
from drillctl.ticker.program_run import run_program

NO_FAULT = 0
Program = NDArray[np.void]
Place = tuple[float, ...]  # of all axes, in steps from machine zero


@dataclass(frozen=True, slots=True)
class Drilled:
    """What became of the board on one machine. ``sound``: every hole made in its place, no step lost, no fault.

    worst_mm  the greatest distance of a hole from where it belongs
    """

    sound: bool
    holes: int
    lost_steps: int
    worst_mm: float
    ticks: int
    fault: int


@dataclass(frozen=True, eq=False)
class Board:
    """``axes``: indexes of those that are varied; ``digest`` stands for all that the results depend on."""

    name: str = field(repr=False)
    machine: Machine = field(repr=False)
    axes: tuple[int, ...]
    programs: Mapping[int, Program] = field(repr=False)
    places: Mapping[tuple[int, int], Place] = field(repr=False)
    digest: str

    @classmethod
    def of(cls, name: str, machine: Machine, axes: Sequence[int], programs: Mapping[int, Program]) -> "Board":
        """The board of a program for each tick rate, dtype kmd.RECORD. Raises LabError for a machine without dynamics,
        and for a program that does not drill to its end even with ideal motors.
        """
        if lacking := [axis.name for axis in machine.axes if axis.dynamics is None]:
            raise LabError(Message("axis {name} has no dynamics; docs/PLANT.md says how to name some", name=lacking[0]))
        rate, program = next(iter(programs.items()))
        ideal = run_program(program, machine.at_rate(rate), IDEAL_PLANT)
        if not ideal.complete or not ideal.touches:
            raise LabError(Message("drills no hole, or ends in a fault, even with ideal motors").at(name))
        described = (machine, [axis.dynamics for axis in machine.axes], machine.surroundings, tuple(axes))
        content = hashlib.sha256(repr(described).encode())
        for rate, program in sorted(programs.items()):
            content.update(b"%d" % rate + program.tobytes())
        places = {(touch.tag, touch.axis): touch.places for touch in ideal.touches}
        return cls(name, machine, tuple(axes), programs, places, content.hexdigest()[:16])

    def on(
        self, tick_hz: int, ramp: RampTable | None, phase: PhaseTable | None, scales: Mapping[str, float]
    ) -> Machine:
        """The machine at a tick rate, with other tables (None: each axis its own), and its dynamics multiplied by
        ``scales``, on the axes that are varied.
        """
        axes = list(self.machine.axes)
        for index in self.axes:
            own = axes[index]
            axes[index] = replace(own, ramp=ramp or own.ramp, phase=phase or own.phase, dynamics=scaled(own, scales))
        return replace(self.machine, axes=tuple(axes)).at_rate(tick_hz)

    def drilled(self, machine: Machine, seed: int, to_the_end: bool = True) -> Drilled:
        """Drills the board on the dynamic plant of a machine that ``on`` made; with ``to_the_end`` False only up to
        the first hole that is out of its place.
        """
        within_mm = full_step_mm(machine, self.axes)

        def goes_on(touches: list[Touch]) -> bool:
            return to_the_end or self._worst_mm(touches[-8:]) < within_mm

        choice = PlantChoice(DYNAMIC, (), seed)
        run = run_program(self.programs[machine.tick_hz], machine, choice, goes_on)
        worst_mm, lost = self._worst_mm(run.touches), sum(map(abs, run.lost))
        made = run.complete and len(run.touches) == len(self.places)
        return Drilled(
            made and not lost and worst_mm < within_mm, len(run.touches), lost, worst_mm, run.ticks, run.fault
        )

    def _worst_mm(self, touches: Sequence[Touch]) -> float:
        plane = plane_of(self.machine)
        scale = np.array([self.machine.axes[axis].steps_per_mm for axis in plane])
        off = [
            [touch.places[axis] - self.places[touch.tag, touch.axis][axis] for axis in plane]
            for touch in touches
            if (touch.tag, touch.axis) in self.places
        ]
        return float(np.hypot(*(np.array(off).reshape(-1, len(plane)) / scale).T).max(initial=0.0)) if off else 0.0


def scaled(axis: AxisTable, scales: Mapping[str, float]) -> Dynamics:
    """The axis's dynamics, each parameter of ``scales`` so many times as great."""
    own = axis.dynamics
    assert own is not None
    return replace(own, **{name: getattr(own, name) * times for name, times in scales.items()})


def full_step_mm(machine: Machine, axes: Sequence[int]) -> float:
    """A full step, the smallest of these axes: nearer than that a hole is in its place."""
    tables = [machine.axes[index] for index in axes]
    columns = (table.motor.columns_per_cycle / FULL_STEPS_PER_CYCLE / table.columns_per_step for table in tables)
    return min(steps / table.steps_per_mm for steps, table in zip(columns, tables, strict=True))
