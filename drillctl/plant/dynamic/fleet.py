"""Many variants of one rotor at once: the same substep as motors.py, a lane for each, equal to the bit.

Rule: numpy's + - * and comparisons element by element, in the order of motors.py; no reductions. Quicker than the plain
law from about thirty lanes on. Unipolar motors only. For sweeps, tuning, and the figures of docs/PLANT.md; the machine
is run by law.py.
"""

from collections.abc import Sequence
from dataclasses import astuple, dataclass

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message
from drillctl.machine.dynamics import WINDING_DEGREES, Dynamics
from drillctl.plant.dynamic.coefficients import QUARTER, SINE, SINES, SLOPE, Wires, coefficients

Floats = NDArray[np.float64]
_SINE, _SLOPE = np.array(SINE), np.array(SLOPE)
OF_THE_LAW = 8  # coefficients, from decay to advance
_AHEAD = np.array([[0], [QUARTER]])  # the cosine is the sine a quarter cycle on


@dataclass(frozen=True, slots=True)
class Lane:
    """One variant: a motor with its load, at a tick rate; ``cycles`` is where its rotor stands without current.

    forward_nm, backward_nm   torque that resists besides the table's friction, by direction
    """

    dynamics: Dynamics
    tick_hz: int
    cycles: float = 0.0
    forward_nm: float = 0.0
    backward_nm: float = 0.0


class Fleet:
    """n rotors on equal wires. Raises ValueError where the lanes have different numbers of substeps a tick.

    cycles    (n,) electrical cycles
    speed     (n,) rad/s
    currents  (4, n) A, in the order of WINDING_DEGREES
    """

    def __init__(self, lanes: Sequence[Lane], wires: Wires):
        if other := next((lane.dynamics for lane in lanes if lane.dynamics.kind != "unipolar"), None):
            raise ValueError(
                Message(
                    "sweeps of single moves take unipolar motors; {name} is a {kind} motor's: sweep --board takes it",
                    name=other.name,
                    kind=other.kind,
                )
            )
        laws = [coefficients(lane.dynamics, lane.tick_hz) for lane in lanes]
        if len({law.substeps for law in laws}) != 1:
            raise ValueError("the lanes of a fleet need the same number of substeps: tick rates from 50 Hz on have it")
        self._substeps = laws[0].substeps
        self._lanes, self._wires = lanes, wires
        columns = np.array([astuple(law)[1 : 1 + OF_THE_LAW] for law in laws]).T
        self._decay, self._emf, self._keep, self._push, self._detent, stop, gain, self._advance = columns
        self._forward = stop + np.array([lane.forward_nm for lane in lanes]) * gain
        self._backward = -(stop + np.array([lane.backward_nm for lane in lanes]) * gain)
        self.cycles = np.array([lane.cycles for lane in lanes])
        self.speed = np.zeros(len(lanes))
        self.currents = np.zeros((len(WINDING_DEGREES), len(lanes)))
        self._supplies: dict[int, Floats] = {}

    def run(self, images: NDArray[np.integer], keep: bool = False) -> Floats:
        """Computes a tick for each row of images, (ticks,) for all lanes alike or (ticks, n); goes on from where the
        lanes are.

        Returns the cycles at the end, (n,); with ``keep`` after every tick, (ticks, n).
        """
        history = np.empty((len(images) if keep else 0, len(self._lanes)))
        distinct, index = np.unique(images, return_inverse=True)
        supplies = np.stack([self._supply(image) for image in distinct.tolist()])
        everywhere = np.arange(len(self._lanes))
        for tick, row in enumerate(index.reshape(images.shape)):
            supply = supplies[row] if images.ndim == 1 else supplies[row, :, everywhere].T
            self._tick(supply)
            if keep:
                history[tick] = self.cycles
        return history if keep else self.cycles.copy()

    def _supply(self, image: int) -> Floats:
        """Returns the final currents that an image drives towards, (4, n)."""
        if image not in self._supplies:
            supplies = [self._wires.supply(image, lane.dynamics) for lane in self._lanes]
            self._supplies[image] = np.array(supplies).T
        return self._supplies[image]

    def _tick(self, supply: Floats) -> None:
        currents, speed = self.currents, self.speed
        back = np.empty_like(currents)
        for _ in range(self._substeps):
            sin, cos = self._angles()
            electric = self._emf * speed
            back[0], back[2] = electric * sin, electric * cos
            np.negative(back[0], out=back[1])
            np.negative(back[2], out=back[3])
            goal = supply + back
            currents -= goal
            currents *= self._decay
            currents += goal
            np.maximum(currents, 0.0, out=currents)

            pull = (currents[0] - currents[1]) * sin + (currents[2] - currents[3]) * cos
            hold = sin * cos * (1.0 - 2.0 * sin * sin)
            speed *= self._keep
            speed -= self._push * pull
            speed -= self._detent * hold
            speed -= np.minimum(np.maximum(speed, self._backward), self._forward)
            self.cycles += self._advance * speed

    def _angles(self) -> Floats:
        """Returns sine and cosine of the rotors' places, (2, n)."""
        place = (self.cycles - np.floor(self.cycles)) * SINES
        entry = place.astype(np.intp)
        entries = entry + _AHEAD
        return _SINE[entries] + _SLOPE[entries] * (place - entry)
