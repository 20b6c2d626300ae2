"""What the engine must know of what lies beyond the port, and how it leaves that as if ticked.

Rule: execution sees no plant; whoever builds the engine hands it one that answers to this. plant/forecast.py does.
"""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from drillctl.execution.axis import Axis


class PlantFacts(Protocol):
    """A plant that always answers alike. Travel is in columns of the phase table since power-up, as the wires have
    it (an inverted axis counts against its controller).
    """

    @property
    def inputs(self) -> int:
        """The input image that the next latch will see."""

    def stands(self, axis: int, travel: int, turn: int) -> bool:
        """Whether the rotor is where so many columns have put it, and will follow any further. In the middle of a
        drive's pulse that depends on the way it goes, ``turn``: 1 or -1, as the wires have it.
        """

    def free(self, axis: int) -> tuple[float, float]:
        """Between these travels (neither included) no sensor changes and no bit meets the board."""

    def free_of_switches(self, axis: int) -> tuple[float, float]:
        """Between these travels the same, but that the index of the axis's encoder may change."""

    def index_mask(self, axis: int) -> int:
        """The input bit of the index of an axis's encoder, 0 where it has none."""

    def index_levels(self, axis: int, travel: int, turns: NDArray[np.int64], column: NDArray[np.int64],
                     ) -> NDArray[np.int64]:  # fmt: skip
        """That bit after each of n turns, (n,), from the ``travel`` before them. ``turns`` (n,) are columns put out in
        each: 1, 0 or -1, as the wires have it; ``column`` (n,) is the one that stands then, from 0.
        """

    def follow(self, axis: int, travel: int, turn: int) -> None:
        """The rotor has moved, and is where so many columns put it, within ``free``; ``turn`` as for ``stands``."""

    def memory(self, axis: int) -> tuple[Any, ...]:
        """All that an axis's rotor and sensors remember, its output bits left out."""

    def recall(self, axis: int, memory: Any) -> None:
        """Puts an axis's part of the plant back to what ``memory`` returned."""

    def settle(self, image: int, met: Sequence[int]) -> None:
        """Takes the output image after the last tick; meanwhile the bits of these axes have met their boards."""


def turned(axis: Axis) -> tuple[int, int]:
    """Returns the columns of an axis since power-up, and the way it goes: both as the wires have it, for ``stands`` and
    ``follow``.
    """
    return axis.travelled * axis.direction_sign, axis.direction * axis.direction_sign
