"""What a machine's file says of a spindle whose speed is measured: ``[spindle]``.

Rule: such a spindle has two words, the speed that is wanted and the one that it has; without them the table is refused.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import msgspec

from drillctl.language import Message
from drillctl.machine.levels import SPEED_ACTUAL, SPEED_WANTED, Word
from drillctl.machine.shape import MachineFile
from drillctl.machine.source import Source


@dataclass(frozen=True, slots=True)
class Spindle:
    """When a spindle is at its speed, and how its converter counts.

    tolerance_percent   by which the speed may differ from the one that is wanted
    standstill_rev_min  below this it stands
    reached_s           after so long it must have come to its speed, or stand
    dip_s               a speed that was reached may be missed for so long: a drill that bites brakes it
    rev_min_per_hz      turns a minute to one Hz of the converter's output: 60 for a motor of two poles
    """

    tolerance_percent: float
    standstill_rev_min: int
    reached_s: float
    dip_s: float
    rev_min_per_hz: float

    def near(self, wanted: int, actual: int) -> bool:
        """Whether the speed is the one that is wanted, in rev/min, or it stands where none is."""
        if not wanted:
            return actual <= self.standstill_rev_min
        return abs(actual - wanted) * 100 <= wanted * self.tolerance_percent


def spindle_of(source: Source, raw: MachineFile, put_out: Iterable[Word], read: Iterable[Word]) -> Spindle | None:
    """Returns what ``[spindle]`` says; None where a file has no such table. Raises TableError."""
    if raw.spindle is None:
        return None
    for kind, name, words in (("output", SPEED_WANTED, put_out), ("input", SPEED_ACTUAL, read)):
        if name not in [word.name for word in words]:
            reason = Message("spindle: its speed needs a word {name} (an {kind})", kind=kind, name=name)
            raise source.error(reason, "spindle")
    return Spindle(*msgspec.structs.astuple(raw.spindle))
