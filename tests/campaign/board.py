"""The campaign's boards: a few holes, and where each must be found afterwards. Reckoned here, not by the program."""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from random import Random

STEPS_PER_MM = 1200 / 25.4  # pcb-drill's scale
APART_MM = 0.4
REST_STEPS = 3  # of a rotor: columns 1 to 3 of the phase table are one place
Place = tuple[float, float]


@dataclass(frozen=True)
class Board:
    """Tools with their holes, file millimetres; a hole's number is its place in ``holes``, from 1."""

    tools: tuple[tuple[Place, ...], ...]

    @classmethod
    def random(cls, rng: Random) -> "Board":
        """3 to 6 holes of 1 to 3 tools, near machine zero and none upon another."""
        grid = [(0.5 + APART_MM * x, 0.5 + APART_MM * y) for x in range(6) for y in range(6)]
        holes = rng.sample(grid, rng.randint(3, 6))
        cuts = sorted(rng.sample(range(1, len(holes)), rng.randint(0, 2)))
        bounds = [0, *cuts, len(holes)]
        return cls(tuple(tuple(holes[a:b]) for a, b in pairwise(bounds)))

    @property
    def holes(self) -> list[Place]:
        return [hole for tool in self.tools for hole in tool]

    @property
    def places(self) -> list[Place]:
        """By hole: X and Y in steps from machine zero; the lowest X and Y of the board lie there."""
        x_low, y_low = (min(hole[axis] for hole in self.holes) for axis in (0, 1))
        return [((x - x_low) * STEPS_PER_MM, (y - y_low) * STEPS_PER_MM) for x, y in self.holes]

    def hole_at(self, x_steps: float, y_steps: float) -> int | None:
        """The number of the hole that the bit met there, None for a place where there is no hole."""
        for number, (x, y) in enumerate(self.places, start=1):
            if max(abs(x - x_steps), abs(y - y_steps)) <= REST_STEPS:
                return number
        return None

    def write(self, file: Path) -> None:
        """As an Excellon file."""
        lines = ["M48", "METRIC", *(f"T{n}C0.{6 + n}00" for n in range(1, len(self.tools) + 1)), "%", "G90", "G05"]
        for number, holes in enumerate(self.tools, start=1):
            lines += [f"T{number}", *(f"X{x:.3f}Y{y:.3f}" for x, y in holes)]
        file.write_text("\n".join([*lines, "M30", ""]))
