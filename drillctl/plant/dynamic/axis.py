"""One rotor with inertia: currents, speed and place, a tick at a time. The reference that fleet.py must equal to the
bit.

Rule: plain floats, + - * and comparisons (coefficients.py has the equations). A rotor that a whole tick left as it was,
to the bit, is not computed again until its image or its load changes.
"""

from drillctl.plant.dynamic.coefficients import QUARTER, SINE, SINES, SLOPE, Coefficients, Supply

State = tuple[float, float, float, float, float, float]


class DynamicAxis:
    """A rotor, at first at rest without currents at ``cycles``.

    currents  of the four half windings, in A, in the order of WINDING_DEGREES
    speed     rad/s of the shaft
    cycles    electrical cycles
    resting   a tick more would change nothing
    """

    __slots__ = ("_backward", "_forward", "_supply", "currents", "cycles", "law", "resting", "speed")

    def __init__(self, law: Coefficients, cycles: float):
        self.law = law
        self.currents = (0.0, 0.0, 0.0, 0.0)
        self.speed = 0.0
        self.cycles = cycles
        self.resting = False
        self._forward = self._backward = law.stop
        self._supply: Supply | None = None

    def take(self, law: Coefficients) -> None:
        """Uses these coefficients from now on, for a new tick rate. A load must be set again (``load``)."""
        self.law = law
        self._forward = self._backward = law.stop
        self.resting = False

    def load(self, forward_nm: float, backward_nm: float) -> None:
        """Sets the torque that resists besides the table's friction, by direction, from now on."""
        forward = self.law.stop + forward_nm * self.law.gain
        backward = self.law.stop + backward_nm * self.law.gain
        if (forward, backward) != (self._forward, self._backward):
            self._forward, self._backward = forward, backward
            self.resting = False

    def tick(self, supply: Supply) -> bool:
        """Computes one tick on a supply (Wires.supply); returns False where the rotor rests and
        nothing was to be done.
        """
        if self.resting and supply == self._supply:
            return False
        before = (self.currents, self.speed, self.cycles)
        self._supply = supply
        self._integrate(supply)
        self.resting = (self.currents, self.speed, self.cycles) == before
        return True

    def _integrate(self, supply: Supply) -> None:
        # Locals for speed: most of a simulated second is spent in this loop.
        sine, slope, quarter, places = SINE, SLOPE, QUARTER, SINES
        law, forward, backward = self.law, self._forward, self._backward
        decay, emf, keep, push = law.decay, law.emf, law.keep, law.push
        detent, advance = law.detent, law.advance
        to_a, to_b, to_c, to_d = supply
        a, b, c, d = self.currents
        speed, cycles = self.speed, self.cycles
        for _ in range(law.substeps):
            place = cycles % 1.0 * places
            entry = int(place)
            part = place - entry
            sin = sine[entry] + slope[entry] * part
            cos = sine[entry + quarter] + slope[entry + quarter] * part

            back = emf * speed
            goal = to_a + back * sin
            a = goal + (a - goal) * decay
            goal = to_b - back * sin
            b = goal + (b - goal) * decay
            goal = to_c + back * cos
            c = goal + (c - goal) * decay
            goal = to_d - back * cos
            d = goal + (d - goal) * decay
            a = a if a > 0.0 else 0.0
            b = b if b > 0.0 else 0.0
            c = c if c > 0.0 else 0.0
            d = d if d > 0.0 else 0.0

            pull = (a - b) * sin + (c - d) * cos
            hold = sin * cos * (1.0 - 2.0 * sin * sin)
            speed = speed * keep - push * pull - detent * hold
            if speed > forward:
                speed -= forward
            elif speed < -backward:
                speed += backward
            else:
                speed = 0.0
            cycles += advance * speed
        self.currents = (a, b, c, d)
        self.speed, self.cycles = speed, cycles
