"""One rotor, found from the output bits alone. Angles are whole electrical degrees, counted on past 360.

Rule: a rotor goes to the nearest stable equilibrium of the windings that are on; half a cycle away it may go either
way, so it stays, and that is a slip. A rotor rests in one of a few places of the cycle (four for two phases, three
columns apart), and all columns of a place look alike: so a rotor's place tells the controller's column to within a
rest, and not to a column.
"""

from itertools import product

from drillctl.machine import AxisTable

FULL_TURN = 360
HALF_TURN = 180


class Rotor:
    """What winding rotors and pulse drives share: an angle, and how it is read in columns.

    degrees  where the rotor is; ``zero`` is where it stood at power-up, and there the column count is 0
    slips    jumps of half a cycle: the coils gave no direction
    """

    def __init__(self, table: AxisTable):
        motor = table.motor
        self.mask = sum(1 << bit for bit in table.wire_bits)
        self.columns_per_cycle = motor.columns_per_cycle
        self.half_rest = HALF_TURN / motor.rests_per_cycle
        self.zero = motor.zero_degrees
        self.degrees: float = self.zero
        self.slips = 0
        self.seen = 0

    def pull(self, pattern: int) -> bool:
        """Takes the axis's bits of a new port image; returns whether the rotor has moved."""
        raise AssertionError("a rotor has windings or a drive")

    def see(self, pattern: int) -> None:
        """Takes the bits as those that are on already; nothing moves."""
        self.seen = pattern

    @property
    def columns(self) -> float:
        """Columns travelled since power-up, by the rotor's place."""
        return (self.degrees - self.zero) * self.columns_per_cycle / FULL_TURN

    def columns_lost(self, travelled: int) -> float:
        """Returns how far the rotor is behind a controller that put ``travelled`` columns out (forward - backward)."""
        commanded = travelled * FULL_TURN / self.columns_per_cycle + self.zero
        behind = commanded - self.degrees
        return behind * self.columns_per_cycle / FULL_TURN if abs(behind) > self.half_rest else 0.0


class WindingRotor(Rotor):
    """A stepper: each combination of windings has one equilibrium, or none where they cancel."""

    def __init__(self, table: AxisTable):
        super().__init__(table)
        bits = dict(zip(table.phase.wire_names(), table.wire_bits, strict=True))
        windings = [name for name, _ in table.motor.windings]
        self.winding_mask = sum(1 << bits[name] for name in windings)
        self.equilibrium: dict[int, int | None] = {}
        for choice in product((False, True), repeat=len(windings)):
            on = frozenset(name for name, chosen in zip(windings, choice, strict=True) if chosen)
            pattern = sum(1 << bits[name] for name in on)
            self.equilibrium[pattern] = table.motor.equilibrium_degrees(on)

    def pull(self, pattern: int) -> bool:
        """Moves to the nearest equilibrium. Forcing wires raise a current; they move no equilibrium."""
        angle = self.equilibrium[pattern & self.winding_mask]
        if angle is None:
            return False
        jump = (angle - self.degrees + HALF_TURN) % FULL_TURN - HALF_TURN
        if jump == -HALF_TURN:
            self.slips += 1
            return False
        self.degrees += jump
        return jump != 0


class PulseRotor(Rotor):
    """A drive with pulse and direction: one turn of the count at each rising edge."""

    def __init__(self, table: AxisTable):
        super().__init__(table)
        bits = dict(zip(table.phase.wire_names(), table.wire_bits, strict=True))
        motor = table.motor
        assert motor.pulse and motor.direction
        self.pulse = 1 << bits[motor.pulse]
        self.direction = 1 << bits[motor.direction]
        self.forward = self.direction if forward_level(table) else 0
        self.was_high = False

    def see(self, pattern: int) -> None:
        """Takes the bits as those that are on already; nothing moves."""
        super().see(pattern)
        self.was_high = bool(pattern & self.pulse)

    def pull(self, pattern: int) -> bool:
        """Counts a rising edge of the pulse by the direction that stands beside it."""
        high = bool(pattern & self.pulse)
        rising = high and not self.was_high
        self.was_high = high
        if rising:
            self.degrees += FULL_TURN if pattern & self.direction == self.forward else -FULL_TURN
        return rising


def forward_level(table: AxisTable) -> bool:
    """Returns whether the direction wire of an axis with a pulse drive is high on the way forward."""
    return bool(next(wire for wire in table.phase.wires if wire.name == table.motor.direction).forward[0])


def rotor_of(table: AxisTable) -> Rotor:
    """Returns the rotor for an axis's motor."""
    return PulseRotor(table) if table.motor.pulse else WindingRotor(table)
