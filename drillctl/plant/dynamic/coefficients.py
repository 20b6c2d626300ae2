"""The equations of one axis, and the numbers that a substep of them multiplies with. Computed once, from a table.

    u        electrical cycles; phi = 2 pi u, s = sin phi, c = cos phi; one cycle is four full steps
    w        rad/s of the shaft
    i        the four half-winding currents, each >= 0: a diode lets none flow back
    L di/dt  = V - R i + Km w s, - Km w s, + Km w c, - Km w c       windings at 0, 180, 270, 90 degrees
    V        = supply - switch for a winding that is on, -freewheel for one that is off
    T        = -Km ((i0 - i180) s + (i270 - i90) c) - Td sin 4 phi
    J dw/dt  = T - B w - friction; below it a rotor at rest stays at rest

A motor of variable reluctance (kind "reluctance", machine/dynamics.py) has n windings k, 360/n degrees apart, and

    L di/dt  = V - R i + K w i sin(phi - phi_k)      0 <= i <= the current at which the chopper holds it
    T        = sum of i^2/2 dL/dtheta = -K/2 sum of i^2 sin(phi - phi_k)

where L in the first line is the mean inductance: the time constant is taken as the same at every angle.

A motor in a drive (kind "drive") has one current and a goal g, which each pulse moves by a cycle:

    i -> a (g - u) - b w, at the pace of its current loop, within its limit and what the supply leaves: (V - K w) / R
    J dw/dt = K i - B w - friction      a, b: critically damped, at the frequency of the drive's bandwidth

It trips where g - u is more than its following error, and gives no current from then on.

The first is a unipolar motor as textbooks and Simscape have it (independent half windings, no saturation), with diodes,
forcing and true stiction added. One substep of h seconds: currents exactly for a frozen back-EMF, then speed, then
friction as far as it can stop the rotor, then place (semi-implicit Euler).

Rule: after this module only + - * and comparisons; constants and sines are rounded to 13 digits, so that the last
bits of no mathematical library show. motors.py has the substep for one rotor, fleet.py for many: the same to the bit.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from drillctl.machine.dynamics import KINDS, Dynamics

SUBSTEPS = 40  # 50 us at 500 Hz: a rotor's place is then within 0.02 full steps of the limit of finer ones
LONGEST_SUBSTEP_S = 5e-4  # even at ten times 50 us steps are lost from the same tick rate on
LONGEST_CHOPPED_S = 5e-6  # of a reluctance motor, whose windings change fifty times more often than the paper's ticks
LONGEST_SERVED_S = 1e-4  # of a drive, whose own frequency is far below
CURRENT_LOOP_HZ = 800  # how fast a drive brings its current to what it wants: assumed
# By kind of motor: the fewest substeps of a tick, and the longest one.
SUBSTEPS_OF = {
    "unipolar": (SUBSTEPS, LONGEST_SUBSTEP_S),
    "reluctance": (1, LONGEST_CHOPPED_S),
    "drive": (1, LONGEST_SERVED_S),
}
SINES = 1024  # places of a cycle; between them a straight line, wrong by less than 5e-6
QUARTER = SINES // 4


def rounded(value: float) -> float:
    """Rounds to 13 digits: the same value on every computer."""
    return float(f"{value:.12e}")


# A cycle and a quarter, and one entry more: the cosine is the sine a quarter cycle on.
SINE = tuple(round(math.sin(2 * math.pi * place / SINES), 12) for place in range(SINES + QUARTER + 2))
SLOPE = tuple(after - before for before, after in pairwise(SINE))


@dataclass(frozen=True, slots=True)
class Coefficients:
    """What a substep multiplies with.

    decay     a current's distance from its final value, after a substep
    emf       back-EMF as a current: A per rad/s
    keep      the part of the speed that viscous friction leaves
    push      rad/s gained by an ampere at its best angle
    detent    rad/s by 4 sin(phi) cos(phi) (1 - 2 sin2(phi)), which is sin 4 phi
    stop      rad/s that Coulomb friction takes off
    gain      rad/s gained by 1 N m, for a load beside the table's
    advance   cycles by 1 rad/s
    limit     A at which a chopper holds a current; 0 without one
    spacing   cycles from a winding of a reluctance motor to the next
    windings  how many; ``kind`` is one of motors.py's

    stiff     A by a pulse of following error, of a drive; ``damp`` A per rad/s
    trip      the following error in pulses at which a drive trips

    For a reluctance motor emf is A per rad/s and A, and push is by the square of an ampere.
    """

    substeps: int
    decay: float
    emf: float
    keep: float
    push: float
    detent: float
    stop: float
    gain: float
    advance: float
    limit: float
    spacing: float
    windings: int
    kind: int
    stiff: float
    damp: float
    trip: float


def coefficients(d: Dynamics, tick_hz: int) -> Coefficients:
    """Returns the coefficients for ticks of 1 / tick_hz seconds."""
    chopped, driven = d.kind == "reluctance", d.kind == "drive"
    fewest, longest_s = SUBSTEPS_OF[d.kind]
    substeps = max(fewest, math.ceil(1 / (tick_hz * longest_s)))
    h_s = 1 / (tick_hz * substeps)
    gain = h_s / d.inertia_kgm2
    torque = d.torque_nm_per_a2 if chopped else d.torque_nm_per_a
    servo = 2 * math.pi * d.bandwidth_hz  # rad/s of its own frequency, critically damped
    radians = 2 * math.pi / d.cycles_per_turn
    settles_hz = 2 * math.pi * CURRENT_LOOP_HZ if driven else d.resistance_ohm / d.inductance_h  # of a current
    return Coefficients(
        substeps,
        decay=rounded(math.exp(-h_s * settles_hz)),
        emf=rounded(torque / d.resistance_ohm),
        keep=rounded(1 - d.viscous_nms * gain),
        push=rounded((torque / 2 if chopped else torque) * gain),
        detent=rounded(4 * d.detent_nm * gain),
        stop=rounded(d.coulomb_nm * gain),
        gain=rounded(gain),
        advance=rounded(d.cycles_per_turn * h_s / (2 * math.pi)),
        limit=d.current_a,
        spacing=rounded(1 / d.windings),
        windings=d.windings,
        kind=KINDS.index(d.kind),
        stiff=rounded(servo * servo * d.inertia_kgm2 / torque * radians),
        damp=rounded(2 * servo * d.inertia_kgm2 / torque),
        trip=float(d.error_pulses),
    )


Supply = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Wires:
    """Which output bit switches each winding, and which bits force it.

    on       by winding, in the order of their degrees (machine/dynamics.py): the bit that switches it on
    forcing  by winding: the bits of the forcing wires that feed it while it is on
    """

    on: tuple[int, ...]
    forcing: tuple[int, ...]

    def supply(self, image: int, d: Dynamics) -> Supply:
        """Returns the final currents, in A, that a port image drives towards without back-EMF."""
        off, normal, forced = self.levels(d)
        return tuple(
            (forced if image & forcing else normal) if image & on else off
            for on, forcing in zip(self.on, self.forcing, strict=True)
        )

    def levels(self, d: Dynamics) -> tuple[float, float, float]:
        """Returns the final current, in A, of a winding that is off, on the normal supply, on the forcing one."""
        off, normal, forced = -d.freewheel_volts, d.normal_volts - d.switch_volts, d.forcing_volts - d.switch_volts
        return rounded(off / d.resistance_ohm), rounded(normal / d.resistance_ohm), rounded(forced / d.resistance_ohm)
