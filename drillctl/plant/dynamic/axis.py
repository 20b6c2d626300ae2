"""One rotor with inertia: currents, speed and place, a tick at a time. It holds what motors.py computes with.

Rule: a rotor that a whole tick left as it was, to the bit, is not computed again until its image or its load changes.
"""

from dataclasses import fields
from typing import Any

from drillctl.plant.dynamic import motors as columns
from drillctl.plant.dynamic.coefficients import Coefficients, Supply
from drillctl.plant.dynamic.kernel import KERNEL, Kernel

_COEFFICIENTS = [(field.name, getattr(columns, field.name.upper())) for field in fields(Coefficients)]


class DynamicAxis:
    """A rotor, at first at rest without currents at ``cycles``.

    rows, at  where its columns are, as motors.py names them
    law       the coefficients that stand there
    """

    __slots__ = ("_kernel", "at", "law", "rows")

    def __init__(self, law: Coefficients, cycles: float, kernel: Kernel = KERNEL):
        self._kernel = kernel
        self.rows, self.at = kernel.numbers([0.0] * columns.MOTOR), 0
        self.rows[columns.CYCLES] = cycles
        self.take(law)

    @property
    def currents(self) -> tuple[float, ...]:
        """Returns the currents of the windings, in A, in the order of their degrees (machine/dynamics.py)."""
        begin = self.at + columns.CURRENTS
        return tuple(self.rows[begin : begin + self.law.windings])

    @property
    def speed(self) -> float:
        """In rad/s of the shaft."""
        return self.rows[self.at + columns.SPEED]

    @property
    def cycles(self) -> float:
        """Where it is, in electrical cycles."""
        return self.rows[self.at + columns.CYCLES]

    @property
    def resting(self) -> bool:
        """Whether a tick more would change nothing."""
        return self.rows[self.at + columns.RESTING] != 0.0

    def move_to(self, rows: Any, at: int) -> None:
        """Goes on in a row that lies beside those of other axes, from ``at`` on."""
        rows[at : at + columns.MOTOR] = self.rows
        self.rows, self.at = rows, at

    def take(self, law: Coefficients) -> None:
        """Uses these coefficients from now on, for a new tick rate. A load must be set again (``load``)."""
        self.law = law
        for name, column in _COEFFICIENTS:
            self.rows[self.at + column] = float(getattr(law, name))
        self.rows[self.at + columns.FORWARD] = self.rows[self.at + columns.BACKWARD] = law.stop
        self.rows[self.at + columns.RESTING] = 0.0

    def load(self, forward_nm: float, backward_nm: float) -> None:
        """Sets the torque that resists besides the table's friction, by direction, from now on."""
        self._kernel.load(self.rows, self.at, forward_nm, backward_nm)

    def tick(self, supply: Supply) -> bool:
        """Computes one tick on a supply (Wires.supply); returns False where the rotor rests and
        nothing was to be done.
        """
        begin = self.at + columns.SUPPLY
        if tuple(self.rows[begin : begin + len(supply)]) != supply:
            for winding, level in enumerate(supply):
                self.rows[begin + winding] = level
            self.rows[self.at + columns.RESTING] = 0.0
        return self._kernel.step(self.rows, self.at, self._kernel.sine, self._kernel.slope)
