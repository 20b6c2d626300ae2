"""The scale of an axis from a measurement: so many steps were made, so many millimetres were measured.

Rule: a measurement that can't be right gives a reason and no scale. Used by the guide of the configuration screen.
"""

from dataclasses import dataclass

from drillctl.language.words import _

MM_PER_INCH = 25.4
LEAST_TRAVEL_MM = 5.0
GREATEST_CHANGE = 2.0  # beyond that the steps or the ruler were another's, not the scale
READING_MM = 0.1  # how well a person reads a ruler


@dataclass(frozen=True, slots=True)
class Measurement:
    """``old``: columns per inch as configured; ``steps`` made either way, each of ``columns_per_step`` columns."""

    steps: int
    columns_per_step: int
    old: int
    travel_mm: float

    @property
    def columns_per_inch(self) -> int:
        """As measured, to the whole column."""
        return round(abs(self.steps) * self.columns_per_step * MM_PER_INCH / self.travel_mm)

    @property
    def change_percent(self) -> float:
        """Of the scale."""
        return 100 * (self.columns_per_inch / self.old - 1)

    @property
    def doubt_percent(self) -> float:
        """What a reading wrong by a tenth of a millimetre makes."""
        return 100 * READING_MM / self.travel_mm

    def problem(self) -> str:
        """Why no scale can be had from it; empty where one can."""
        if not self.steps:
            return _("the axis has not moved")
        if self.travel_mm < LEAST_TRAVEL_MM:
            return _("{mm:g} mm is too short to measure by: {least:g} mm at least").format(
                mm=self.travel_mm, least=LEAST_TRAVEL_MM
            )
        ratio = self.columns_per_inch / self.old
        if not 1 / GREATEST_CHANGE <= ratio <= GREATEST_CHANGE:
            return _("{new} columns/inch instead of {old} is not plausible: see what was measured").format(
                new=self.columns_per_inch, old=self.old
            )
        return ""
