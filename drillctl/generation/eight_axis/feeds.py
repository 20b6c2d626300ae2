"""Speeds in mm/min as the least ticks between two columns of an axis.

Rule: a speed is kept within 2 %, or refused with the nearest ones that the tick rate can give.
"""

from drillctl.generation.errors import JobError
from drillctl.language import Message
from drillctl.machine import AxisTable, Machine
from drillctl.machine.model import MM_PER_INCH

KEPT_WITHIN = 0.02
SECONDS = 60


def interval_of(machine: Machine, axis: int, mm_min: float, name: str) -> int:
    """Returns the ticks between two columns at a speed; ``name`` is the parameter's. Raises JobError."""
    table = machine.axes[axis]
    ticks = speed_at(machine, table, 1) / mm_min
    nearest = max(1, round(ticks))
    if abs(speed_at(machine, table, nearest) / mm_min - 1) <= KEPT_WITHIN:
        return nearest
    slower = max(2, int(ticks) + 1)
    fields = {
        "name": name,
        "wanted": f"{mm_min:g}",
        "slower": f"{speed_at(machine, table, slower):.1f}",
        "faster": f"{speed_at(machine, table, slower - 1):.1f}",
        "hz": machine.tick_hz,
    }
    reason = Message(
        "{name}: {wanted} mm/min can't be kept at {hz} Hz; the nearest are {slower} and {faster} mm/min", **fields
    )
    raise JobError(reason.at(machine.file))


def speed_at(machine: Machine, table: AxisTable, ticks: int) -> float:
    """Returns the speed, in mm/min, of a column every so many ticks."""
    return machine.tick_hz * SECONDS * MM_PER_INCH / (table.columns_per_inch * ticks)
