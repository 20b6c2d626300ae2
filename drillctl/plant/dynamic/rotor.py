"""A rotor with inertia, driven by port images and read in columns.

Rule: time goes on by one tick with each image. Steps are lost in whole cycles: a rotor that holds the field, or would
return to it, has lost none, however far it lags or friction keeps it from its rest.
"""

from dataclasses import replace
from typing import Any

from drillctl.machine import AxisTable
from drillctl.plant.dynamic import law, motors
from drillctl.plant.dynamic.axis import DynamicAxis
from drillctl.plant.dynamic.coefficients import Supply, Wires, coefficients
from drillctl.plant.dynamic.kernel import KERNEL, Kernel
from drillctl.plant.rotor import FULL_TURN, Rotor, forward_level


class DynamicRotor(Rotor):
    """The motor of an axis that has dynamics; ``friction`` multiplies the table's Coulomb friction."""

    def __init__(self, table: AxisTable, tick_hz: int, friction: float = 1.0, kernel: Kernel = KERNEL):
        super().__init__(table)
        assert table.dynamics is not None
        self._dynamics = replace(table.dynamics, coulomb_nm=table.dynamics.coulomb_nm * friction)
        self._wires = wires_of(table)
        self._supplies: dict[int, Supply] = {}
        self.axis = DynamicAxis(coefficients(self._dynamics, tick_hz), self.zero / FULL_TURN, kernel)
        off, normal, forced = self._wires.levels(self._dynamics)
        if self._dynamics.kind == "drive":
            forced = normal if forward_level(table) else off
        rows = self.axis.rows
        rows[motors.OFF], rows[motors.NORMAL], rows[motors.FORCED] = off, normal, forced

    def set_rate(self, tick_hz: int) -> None:
        """Uses ticks of 1 / tick_hz seconds from now on."""
        self.axis.take(coefficients(self._dynamics, tick_hz))

    def pull(self, pattern: int) -> bool:
        """Computes one tick of this image; returns False while the rotor rests, unchanged to the bit."""
        supply = self._supplies.get(pattern)
        if supply is None:
            supply = self._supplies[pattern] = self._wires.supply(pattern, self._dynamics)
        moved = self.axis.tick(supply)
        self.follow()
        return moved

    def follow(self) -> None:
        """Reads the rotor's place anew, after a tick."""
        self.degrees = self.axis.cycles * FULL_TURN

    def lie_in(self, rows: Any, at: int) -> None:
        """Goes on in a row of law.py that lies beside those of other axes."""
        self.axis.move_to(rows, at)
        rows[at + law.ZERO], rows[at + law.COLUMNS] = float(self.zero), float(self.columns_per_cycle)

    @property
    def tripped(self) -> bool:
        """Whether it is a drive that has tripped: it gives no current any more."""
        return self._dynamics.kind == "drive" and self.axis.rows[self.axis.at + motors.CURRENTS + motors.TRIPPED] != 0.0

    def pulling(self) -> tuple[float, ...]:
        """Returns the current of each phase, in A; of a unipolar one that of a half winding less its opponent's."""
        currents = self.axis.currents
        if self._dynamics.kind != "unipolar":
            return currents
        first, against_first, against_second, second = currents  # in the order of WINDING_DEGREES
        return first - against_first, second - against_second

    def wires(self) -> tuple[int, ...]:
        """Returns its wires as motors.py has them."""
        missing = (0,) * (motors.MOST - len(self._wires.on))
        return (*self._wires.on, *missing, *self._wires.forcing, *missing)

    def columns_lost(self, travelled: int) -> float:
        """Returns the columns by which the rotor is behind, rounded to whole electrical cycles. A drive that has not
        tripped comes after its pulses, and has lost those alone that it has not counted.
        """
        behind = self.columns_behind(travelled)
        if self._dynamics.kind == "drive" and not self.tripped:
            counted = self.axis.rows[self.axis.at + motors.CURRENTS + motors.COUNT]
            behind = travelled - counted * self.columns_per_cycle
        return round(behind / self.columns_per_cycle) * self.columns_per_cycle

    def columns_behind(self, travelled: int) -> float:
        """Returns how far the rotor is from the middle of its column: lag, friction, and what was lost."""
        return travelled - self.columns


def wires_of(table: AxisTable) -> Wires:
    """Returns which output bits the windings of an axis with dynamics hang at."""
    assert table.dynamics is not None
    bits = {name: 1 << bit for name, bit in zip(table.phase.wire_names(), table.wire_bits, strict=True)}
    if table.dynamics.kind == "drive":
        assert table.motor.pulse and table.motor.direction
        return Wires((bits[table.motor.pulse], bits[table.motor.direction]), (0, 0))
    at = {degrees % FULL_TURN: name for name, degrees in table.motor.windings}
    names = [at[degrees] for degrees in table.dynamics.degrees]
    feeds = [(bits[wire], fed) for wire, fed in table.dynamics.forcing if wire in bits]
    forced = (sum(bit for bit, fed in feeds if name in fed) for name in names)
    return Wires(tuple(bits[name] for name in names), tuple(forced))


def rest_cycles(table: AxisTable, columns: int) -> float:
    """Returns where the field holds a rotor, in electrical cycles, once ``columns`` have been put out since power-up.

    Raises ValueError where a column's windings cancel each other.
    """
    phase, motor = table.phase, table.motor
    shown = (columns - 1) % phase.columns
    on = frozenset(wire.name for wire in phase.wires if wire.forward[shown] and not wire.forcing)
    angle = motor.equilibrium_degrees(on)
    if angle is None:
        raise ValueError(f"column {shown + 1} of {phase.name} holds no rotor")
    nominal = motor.zero_degrees + columns * FULL_TURN / motor.columns_per_cycle
    off = (angle - nominal + FULL_TURN / 2) % FULL_TURN - FULL_TURN / 2
    return (nominal + off) / FULL_TURN
