"""Reports as data, drawn by ui and printed as JSON: how punctual a computer is (microseconds), and pictures of numbers.

Rule: a picture is data. A curve breaks where a value is not a number.
"""

from enum import Enum
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray


class Lateness(msgspec.Struct, frozen=True):
    """How late the wakes of one process were: percentiles to the microsecond below, and the greatest."""

    wakes: int
    p50_us: int
    p99_us: int
    p999_us: int
    max_us: int


class Bar(msgspec.Struct, frozen=True):
    """A row of the histogram: so many ticks were from ``from_us`` to less than ``to_us`` late (None: and more)."""

    from_us: int
    to_us: int | None
    ticks: int


class Grade(msgspec.Struct, frozen=True):
    """A grade from ``A`` to ``E``, what a computer of this grade is good for, and what to do about it."""

    letter: str
    good_for: str
    advice: str


class LatencyReport(msgspec.Struct, frozen=True):
    """What ``drillctl latency`` found.

    A tick is late when it began more than a period after its deadline; ``late`` of them are ``platform`` (a canary
    process was late at the same moment), ``ours``, and ``unlabelled`` (there were more than were kept).
    ``canary_late_share`` is the share of time in which a canary was late: so many meet by chance.
    ``refused`` has a sentence for each real-time measure that was not allowed; none means real-time.
    ``carries_hz`` is the greatest usual rate that the lateness measured would allow, 0 for none. ``moving``: axes moved
    all the time; else the machine was idle.
    """

    machine: str
    tick_hz: int
    seconds: float
    ticker: Lateness
    canary: Lateness
    canary_late_share: float
    late: int
    platform: int
    ours: int
    unlabelled: int
    cpu_share: float
    refused: tuple[str, ...]
    histogram: tuple[Bar, ...]
    carries_hz: int
    grade: Grade
    interrupted: bool
    moving: bool = False

    @property
    def period_us(self) -> float:
        """The period of a tick, in microseconds."""
        return 1e6 / self.tick_hz

    def as_dict(self) -> dict[str, Any]:
        """The object that ``latency --json`` prints."""
        return {**msgspec.to_builtins(self), "real_time": not self.refused}


Floats = NDArray[np.float64]


class Style(Enum):
    """How the points of a curve are joined."""

    LINE = "line"
    STAIRS = "stairs"  # each value holds up to the next point
    POINTS = "points"


class Curve(msgspec.Struct, frozen=True, eq=False):
    """A curve through points (n,), (n,), with a name for the legend."""

    label: str
    x: Floats
    y: Floats
    style: Style = Style.LINE

    @classmethod
    def of(cls, label: str, x: ArrayLike, y: ArrayLike, style: Style = Style.LINE) -> "Curve":
        """From any numbers. Raises ValueError where there are not as many of one as of the other."""
        curve = cls(label, np.asarray(x, np.float64), np.asarray(y, np.float64), style)
        if curve.x.shape != curve.y.shape or curve.x.ndim != 1:
            raise ValueError(f"{label}: {curve.x.shape} places, {curve.y.shape} values")
        return curve


class Chart(msgspec.Struct, frozen=True, eq=False):
    """Curves over one pair of axes; ``to_scale``: a millimetre is as long upwards as sideways."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    to_scale: bool = False


class HeatMap(msgspec.Struct, frozen=True, eq=False):
    """A share (rows, columns), 0 to 1, for each value of one factor upwards and of another sideways. ``label`` says of
    what; ``columns`` and ``rows`` name the values.
    """

    label: str
    x_label: str
    y_label: str
    columns: tuple[str, ...]
    rows: tuple[str, ...]
    share: Floats


class Picture(msgspec.Struct, frozen=True, eq=False):
    """Charts one below the other, and sentences that say what they show."""

    title: str
    charts: tuple[Chart | HeatMap, ...]
    notes: tuple[str, ...] = ()
