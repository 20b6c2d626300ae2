"""The sixteen gears of the boiler-drum drill: speeds, and the ticks between steps that come nearest to them.

Rule: a gear is the slowest allowed interval of a move (KMD_PREDKOSC); the ramp up to it is the machine's own. Source:
the paper has sixteen gears; their speeds are taken to be the preferred numbers R10 from 0.16 to 5 m/min.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from drillctl.machine import AxisTable, Machine
from drillctl.machine.model import MM_PER_INCH
from drillctl.machine.ramp_figures import side_figures

GEARS_MM_MIN = (160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000, 2500, 3150, 4000, 5000)
LETTERS = "0123456789ABCDEF"
MM_PER_M = 1000


def columns_hz(gear: int, axis: AxisTable) -> Fraction:
    """Returns the columns a second of a gear (0 to 15) on an axis; on this machine a column is a step."""
    return Fraction(GEARS_MM_MIN[gear], 60) * axis.columns_per_inch / Fraction(str(MM_PER_INCH))


def interval_ticks(gear: int, axis: AxisTable, tick_hz: int) -> int:
    """Returns the ticks between columns that come nearest to a gear; at least 1, the fastest there is."""
    return max(1, round(tick_hz / columns_hz(gear, axis)))


@dataclass(frozen=True, slots=True)
class GearRow:
    """One gear of one axis in figures.

    error           of the speed that whole ticks give: 0.01 is 1 % too fast
    ramp_mm         travel from rest until the gear is reached
    peak_m_s2       the most by which the speed grows from one interval to the next, over the time of the former
    """

    gear: int
    hz: float
    ticks: int
    error: float
    ramp_mm: float
    peak_m_s2: float


def gear_rows(axis: AxisTable, machine: Machine) -> Iterator[GearRow]:
    """Yields the sixteen gears of an axis."""
    for gear in range(len(GEARS_MM_MIN)):
        hz, ticks = columns_hz(gear, axis), interval_ticks(gear, axis, machine.tick_hz)
        error = float(Fraction(machine.tick_hz, ticks) / hz - 1)
        yield GearRow(gear, float(hz), ticks, error, *_ramp(axis, machine.tick_hz, ticks))


def _ramp(axis: AxisTable, tick_hz: int, floor_ticks: int) -> tuple[float, float]:
    """Returns length (mm) and greatest acceleration (m/s2) of the ramp up to a floor."""
    intervals = [max(axis.ramp.interval[state], floor_ticks) for state in range(axis.ramp.top + 1)]
    up = intervals[: intervals.index(min(intervals)) + 1]
    figures = side_figures(up, tick_hz, MM_PER_INCH / axis.columns_per_inch, axis.columns_per_step)
    return figures.length_mm, figures.greatest_m_s2
