"""Motors as the plant and the hazards know them: where each winding pulls the rotor, or what a pulse does.

Rule: angles are whole electrical degrees; a rotor's place is counted in columns, ``columns_per_cycle`` to an electrical
cycle.
"""

from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, radians, sin
from typing import Annotated, Any

import msgspec

from drillctl.language import Message
from drillctl.machine.phase import Name
from drillctl.machine.source import Source

WEAKEST_PULL = 1e-6  # of one winding's: below it the windings cancel and the rotor is free
Degrees = Annotated[int, msgspec.Meta(ge=-360, le=360)]
Count = Annotated[int, msgspec.Meta(ge=1, le=400)]


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    name: Name
    windings: dict[str, Any] = {}  # of Degrees
    columns_per_cycle: Count | None = None
    rests_per_cycle: Count | None = None
    zero_degrees: Degrees = 0
    pulse: str | None = None
    direction: str | None = None
    columns_per_pulse: Count | None = None


@dataclass(frozen=True, slots=True)
class Motor:
    """A stepper's windings, or (with ``pulse``) a drive that counts rising edges.

    windings           pairs: wire name, electrical degrees
    columns_per_cycle  the unit of the rotor's place: columns of the nominal table to a cycle, or to a pulse
    rests_per_cycle    places of a cycle in which the rotor can rest
    zero_degrees       the electrical angle at which the count is 0
    """

    name: str
    windings: tuple[tuple[str, int], ...]
    columns_per_cycle: int
    rests_per_cycle: int
    zero_degrees: int
    pulse: str | None = None
    direction: str | None = None

    def wire_names(self) -> frozenset[str]:
        """Returns the wires that this motor must find in its phase table; forcing wires may be there too."""
        if self.pulse and self.direction:
            return frozenset((self.pulse, self.direction))
        return frozenset(name for name, _ in self.windings)

    def equilibrium_degrees(self, on: frozenset[str]) -> int | None:
        """Returns where the windings that are on pull the rotor, -180 < angle <= 180; None where they cancel."""
        pulls = [radians(angle) for name, angle in self.windings if name in on]
        x, y = sum(map(cos, pulls)), sum(map(sin, pulls))
        if hypot(x, y) < WEAKEST_PULL:
            return None
        angle = round(degrees(atan2(y, x)))
        return 180 if angle == -180 else angle


def parse_motor(source: Source) -> Motor:
    """Reads a motor from its file's text: a stepper's windings or a drive's pulse, never both. Raises TableError."""
    raw = source.records(_File)
    drive = (raw.pulse, raw.direction, raw.columns_per_pulse)
    stepper = (raw.windings, raw.columns_per_cycle, raw.rests_per_cycle)
    if raw.pulse and raw.direction and raw.columns_per_pulse and not any(stepper):
        return Motor(raw.name, (), raw.columns_per_pulse, 1, 0, raw.pulse, raw.direction)
    if len(raw.windings) > 1 and raw.columns_per_cycle and raw.rests_per_cycle and not any(drive):
        windings = tuple(source.numbers(raw.windings, Degrees, "windings").items())
        return Motor(raw.name, windings, raw.columns_per_cycle, raw.rests_per_cycle, raw.zero_degrees)
    reason = Message(
        "a motor has either [windings] with columns_per_cycle and rests_per_cycle, or pulse, direction and "
        "columns_per_pulse"
    )
    raise source.error(reason, "name")
