"""The plant of the simulated machine as a screen shows and changes it: its kind, its faults, its seed."""

from typing import Protocol

import msgspec

from drillctl.language import Message
from drillctl.viewmodel.console import Problems


class FaultWord(msgspec.Struct, frozen=True):
    """A kind of fault: how it is written (``loose.AXIS=N``), the least and the greatest N, and what N means."""

    usage: str
    least: float
    most: float
    meaning: Message


class PlantView(msgspec.Struct, frozen=True):
    """The plant in use.

    kind           ideal or dynamic
    faults         as they are written, ``blunt=20``
    sensors, axes  of the machine, by the names that faults take
    real_port      the port where a real machine is in use, which has no plant; else empty
    """

    kind: str
    faults: tuple[str, ...]
    seed: int
    words: tuple[FaultWord, ...]
    sensors: tuple[str, ...]
    axes: tuple[str, ...]
    real_port: str = ""


class PlantControl(Protocol):
    """The plant of the simulated machine, and the change to another one, which starts the machine anew."""

    def plant(self) -> PlantView:
        """The plant in use, and the faults that there are."""

    def swap(self) -> Problems:
        """From the ideal plant to the dynamic one, and back; ideal has no faults. Refused while something moves."""

    def choose(self, faults: str, seed: str) -> Problems:
        """The dynamic plant with these faults, spaces between them. Refused while something moves, and for a fault or
        a seed that can't be; then nothing changes.
        """
