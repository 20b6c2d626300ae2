"""What a ramp asks of a carriage: accelerations in m/s2, and how far neighbouring intervals are apart.

Rule: pure functions of a RampTable and a scale. The starting frequency itself is reached in one step, which no
acceleration describes; the figures are of what comes after it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby, pairwise

from drillctl.language import Message
from drillctl.machine.model import MM_PER_INCH, AxisTable, Machine
from drillctl.machine.ramp import RampTable

MM_PER_M = 1000


@dataclass(frozen=True, slots=True)
class RampFigures:
    """The steeper of a ramp's two directions.

    greatest_m_s2  the most that a change of the interval adds to the speed, over the time that the one before lasted
    mean_m_s2      from the starting frequency to the top one, over the time between
    ratio          the largest ratio of neighbouring intervals, less 1: 0.15 are 15 %
    length_mm      travel from state 0 to the first step at the top
    """

    greatest_m_s2: float
    mean_m_s2: float
    ratio: float
    length_mm: float

    def sentence(self) -> Message:
        """The figures as a sentence."""
        return Message(
            "acceleration at most {greatest} m/s2, {mean} on average; neighbouring intervals at most {percent} % "
            "apart; ramp of {length} mm",
            greatest=f"{self.greatest_m_s2:.3g}", mean=f"{self.mean_m_s2:.3g}", percent=f"{100 * self.ratio:.3g}",
            length=f"{self.length_mm:.3g}",
        )  # fmt: skip


def ramp_figures(
    ramp: RampTable, tick_hz: int, pulse_mm: float, columns_per_step: int = 1, top: int | None = None
) -> RampFigures:
    """Returns the figures of a ramp up to state ``top`` (unsigned; None: its highest). ``pulse_mm`` is the travel of a
    column.
    """
    top = ramp.top if top is None else top
    sides = [[ramp.interval[direction * state] for state in range(top + 1)] for direction in (1, -1)]
    return max(
        (side_figures(side, tick_hz, pulse_mm, columns_per_step) for side in sides), key=lambda side: side.greatest_m_s2
    )


def axis_figures(axis: AxisTable, tick_hz: int) -> RampFigures:
    """Returns the figures of an axis's ramp at its scale."""
    return ramp_figures(axis.ramp, tick_hz, MM_PER_INCH / axis.columns_per_inch, axis.columns_per_step)


def machine_figures(machine: Machine) -> Iterator[Message]:
    """Yields a line for each axis: its ramp and the figures."""
    for axis in machine.axes:
        figures = axis_figures(axis, machine.tick_hz).sentence()
        yield Message("{axis}: ramp {ramp}: {figures}", axis=axis.name, ramp=axis.ramp.name, figures=figures)


def side_figures(intervals: list[int], tick_hz: int, pulse_mm: float, columns_per_step: int) -> RampFigures:
    """Returns the figures of one direction, from the intervals (ticks) of its states, the slowest first."""
    speed = pulse_mm * tick_hz / MM_PER_M  # m/s at an interval of one tick
    runs = [(interval, len(list(run))) for interval, run in groupby(intervals)]
    gains = [
        (speed / after - speed / before) / (before * times * columns_per_step / tick_hz)
        for (before, times), (after, _) in pairwise(runs)
    ]
    seconds = sum(intervals[:-1]) * columns_per_step / tick_hz
    gained = speed / intervals[-1] - speed / intervals[0]
    return RampFigures(
        max(map(abs, gains), default=0.0),
        gained / seconds if seconds else 0.0,
        max((max(a, b) / min(a, b) - 1 for a, b in pairwise(intervals)), default=0.0),
        (len(intervals) - 1) * columns_per_step * pulse_mm,
    )
