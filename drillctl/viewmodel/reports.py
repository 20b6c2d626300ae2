"""Reports as data, drawn by ui and printed as JSON: how punctual a computer is (microseconds), and pictures of numbers.

Rule: a picture is data. A curve breaks where a value is not a number.
"""

from enum import Enum
from typing import Any, NamedTuple

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
NO_DIAMETER_MM = 0.8  # a hole is drawn so wide where nobody tells
LONGEST_ERROR = 0.06  # of the board: an error is drawn so long at most
ENLARGED = tuple(digit * 10**power for power in range(5) for digit in (1, 2, 5))


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


class PlannedTool(NamedTuple):
    """A tool of a board: its number (0: nobody tells), its diameter, and the rows of its holes."""

    number: int
    diameter_mm: float | None
    holes: NDArray[np.int64]


class BoardPlan(msgspec.Struct, frozen=True, eq=False):
    """A board from above, in mm: where each hole was sent to and where it was made, (n, 2) each; (n,) the diameter of
    its drill, not a number where nobody tells, and the number of its tool.
    """

    sent_mm: Floats
    made_mm: Floats
    diameter_mm: Floats
    tool: NDArray[np.int64]

    @property
    def error_mm(self) -> Floats:
        """(n,): how far each hole is from where it was sent."""
        off = self.made_mm - self.sent_mm
        return np.hypot(off[:, 0], off[:, 1])

    @property
    def drawn_mm(self) -> Floats:
        """(n,): the diameters as they are drawn."""
        return np.where(np.isfinite(self.diameter_mm), self.diameter_mm, NO_DIAMETER_MM)

    @property
    def outline_mm(self) -> tuple[Floats, Floats]:
        """The lowest and the highest corner of all holes, their edges included; n > 0."""
        radius = self.drawn_mm[:, None] / 2
        return (self.sent_mm - radius).min(axis=0), (self.sent_mm + radius).max(axis=0)

    @property
    def times(self) -> int:
        """How many times as long errors are drawn, that the worst is seen: 1, 2, 5, 10, 20, 50, ..."""
        longest, worst = max(float(np.ptp(self.sent_mm, axis=0).max()), 1.0), float(self.error_mm.max())
        return max((step for step in ENLARGED if worst and step * worst <= LONGEST_ERROR * longest), default=1)

    @property
    def ends_mm(self) -> Floats:
        """(n, 2): where the line of each error ends that begins where the hole was sent to."""
        return self.sent_mm + (self.made_mm - self.sent_mm) * self.times

    @property
    def tools(self) -> tuple[PlannedTool, ...]:
        """The tools, by number."""
        rows = [(int(number), np.flatnonzero(self.tool == number)) for number in np.unique(self.tool)]
        sizes = [float(self.diameter_mm[holes[0]]) for _, holes in rows]
        return tuple(
            PlannedTool(number, size if np.isfinite(size) else None, holes)
            for (number, holes), size in zip(rows, sizes, strict=True)
        )

    def as_chart(self) -> Chart:
        """The same as points and lines, for what can draw no circles."""
        ends = np.stack([self.sent_mm, self.ends_mm, np.full_like(self.sent_mm, np.nan)], axis=1).reshape(-1, 2)
        holes = Curve.of("sent to", self.sent_mm[:, 0], self.sent_mm[:, 1], Style.POINTS)
        off = Curve.of(f"off by, {self.times} times as long", ends[:, 0], ends[:, 1])
        return Chart("x, mm", "y, mm", (holes, off), to_scale=True)


class Picture(msgspec.Struct, frozen=True, eq=False):
    """Charts one below the other, and sentences that say what they show."""

    title: str
    charts: tuple[Chart | HeatMap | BoardPlan, ...]
    notes: tuple[str, ...] = ()
