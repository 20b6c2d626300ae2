"""The drills that a workshop owns: which of them serves a hole, and how long it lasts.

Rule: a hole is served by the nearest diameter within that drill's tolerance, or its tool is refused by name. Read
from a TOML file (``--drills``):

    tolerance_mm = 0.05          # for drills without one of their own

    [[drill]]
    diameter_mm = 0.8
    life_hits = 2000             # optional: holes until it is blunt
    used_hits = 150              # optional: holes it has made
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import msgspec

from drillctl.generation.errors import JobError
from drillctl.language import Message
from drillctl.machine import TableError
from drillctl.machine.source import Source

DEFAULT_TOLERANCE_MM = 0.05
Diameter = Annotated[float, msgspec.Meta(gt=0, le=50)]
Tolerance = Annotated[float, msgspec.Meta(ge=0, le=5)]
Hits = Annotated[int, msgspec.Meta(ge=0)]


class Drill(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """One drill: its diameter, how far from it a hole may be, its life and the holes it has made."""

    diameter_mm: Diameter
    tolerance_mm: Tolerance | None = None
    life_hits: Hits | None = None
    used_hits: Hits = 0

    @property
    def hits_left(self) -> int | None:
        """How many more holes it is good for; None where the file gives no life of it."""
        return None if self.life_hits is None else max(0, self.life_hits - self.used_hits)


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    drill: Annotated[list[Drill], msgspec.Meta(min_length=1, max_length=1000)]
    tolerance_mm: Tolerance = DEFAULT_TOLERANCE_MM


@dataclass(frozen=True, slots=True)
class DrillTable:
    """The drills at hand and the tolerance of those that state none."""

    drills: tuple[Drill, ...]
    tolerance_mm: float

    def serving(self, diameter_mm: float) -> Drill | None:
        """The drill nearest to a diameter among those that may make it; None where there is none."""
        fitting = [drill for drill in self.drills if self._off(drill, diameter_mm) <= 1e-9]
        return min(fitting, key=lambda drill: abs(drill.diameter_mm - diameter_mm), default=None)

    def nearest(self, diameter_mm: float) -> Drill:
        """The drill nearest to a diameter, whatever its tolerance."""
        return min(self.drills, key=lambda drill: abs(drill.diameter_mm - diameter_mm))

    def _off(self, drill: Drill, diameter_mm: float) -> float:
        tolerance_mm = self.tolerance_mm if drill.tolerance_mm is None else drill.tolerance_mm
        return abs(drill.diameter_mm - diameter_mm) - tolerance_mm


def read_drills(file: Path) -> DrillTable:
    """Reads a drill table. Raises JobError naming file, place and reason."""
    try:
        raw = Source.read(file).records(_File)
    except TableError as error:
        raise JobError(error.message) from error
    return DrillTable(tuple(raw.drill), raw.tolerance_mm)


def drill_problems(table: DrillTable, tools: list[tuple[int, float | None]], name: str) -> Iterator[Message]:
    """A line for each (number, diameter) that no drill serves."""
    for number, diameter_mm in tools:
        if diameter_mm is None:
            yield Message("tool T{number} has no diameter, so no drill can be chosen for it", number=number).at(name)
        elif table.serving(diameter_mm) is None:
            nearest = table.nearest(diameter_mm).diameter_mm
            yield Message(
                "no drill serves tool T{number} ({diameter:.3f} mm); the nearest is {nearest:.3f} mm",
                number=number,
                diameter=diameter_mm,
                nearest=nearest,
            ).at(name)
