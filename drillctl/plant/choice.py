"""Which plant stands behind a simulated card: ``ideal``, or ``dynamic`` with its faults, ``dynamic blunt=20
loose.x=0.4``.

A trace's header has the same words.
"""

from dataclasses import dataclass

from drillctl.language import Message
from drillctl.machine import Machine
from drillctl.plant.base import Plant
from drillctl.plant.faults import PlantRefused
from drillctl.plant.ideal import IdealPlant

IDEAL, DYNAMIC, NONE = "ideal", "dynamic", "none"
GREATEST_SEED = 2**31 - 1


@dataclass(frozen=True, slots=True)
class PlantChoice:
    """A kind of plant, its faults as text, and the seed of its random numbers."""

    kind: str = IDEAL
    faults: tuple[str, ...] = ()
    seed: int = 0

    @classmethod
    def of_header(cls, described: str, seed: str) -> "PlantChoice":
        """Reads the choice from a trace's header; ideal for a trace of a real machine. Raises PlantRefused."""
        kind, *faults = described.split() or [""]
        if kind == NONE:
            return IDEAL_PLANT
        if kind not in (IDEAL, DYNAMIC):
            raise PlantRefused(Message("plant {described!r} can't be built", described=described[:60]))
        return cls(kind, tuple(faults), int(seed[:20]) if seed.isdecimal() else 0)

    def __str__(self) -> str:
        return " ".join((self.kind, *self.faults))

    def build(self, machine: Machine) -> Plant:
        """Returns the plant. Raises PlantRefused where the machine can't have it."""
        if self.kind == DYNAMIC:
            from drillctl.plant.dynamic.plant import DynamicPlant

            return DynamicPlant(machine, self.faults, self.seed)
        if self.faults:
            raise PlantRefused(Message("only the dynamic plant can have faults: say --plant dynamic"))
        return IdealPlant(machine)


IDEAL_PLANT = PlantChoice()
