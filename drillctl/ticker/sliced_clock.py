"""The simulated clock of a screen: each wake of the ticker's process runs a slice of ticks, those that are due by now.

Rule: a simulated machine's time may lag behind the wall's, and is never late: what this computer can't run in time is
not made up for. ``pace`` says how much of real time the machine had. Used where no motor is driven.
"""

import time
from collections.abc import Callable

FRAME_NS = 10_000_000  # a slice is what is due in this time, or one tick of a slower machine
MOST_FRAMES = 3  # due at most at once
PACE_NS = 500_000_000  # over which the pace is measured
WHOLE = 100  # percent


class SlicedClock:
    """Stands in for a PacedClock. After ``wait``, ``ticks`` are due, 1 or more; whoever has run them all, or as many as
    there was time for, says so to ``ran``. ``pace`` is in percent of real time.
    """

    late = worst_ns = 0

    def __init__(
        self,
        tick_hz: int,
        now_ns: Callable[[], int] = time.monotonic_ns,
        sleep_s: Callable[[float], object] = time.sleep,
    ):
        self._now_ns, self._sleep_s = now_ns, sleep_s
        self.begun_ns = now_ns()
        self.ticks, self.pace = 1, WHOLE
        self.set_rate(tick_hz)

    def set_rate(self, tick_hz: int) -> None:
        """The rate from the next slice on."""
        self._tick_hz = tick_hz
        self.period_ns = 1_000_000_000 // tick_hz
        self._frame_ns = max(FRAME_NS, self.period_ns)
        self._left = 0  # of a tick, in 1/1e9
        self._passed_ns = self._measured_ns = self._ran = 0

    def rest(self) -> None:
        """A frame is rest enough."""

    def wait(self) -> int:
        """Sleeps to the next frame. Returns the periods by which it begins too late: always 0."""
        sleep_ns = self.begun_ns + self._frame_ns - self._now_ns()
        if sleep_ns > 0:
            self._sleep_s(sleep_ns / 1e9)
        now_ns = self._now_ns()
        self._passed_ns, self.begun_ns = now_ns - self.begun_ns, now_ns
        granted_ns = min(self._passed_ns, MOST_FRAMES * self._frame_ns)
        due, self._left = divmod(granted_ns * self._tick_hz + self._left, 1_000_000_000)
        self.ticks = max(due, 1)
        return 0

    def ran(self, ticks: int) -> None:
        """Notes for the pace how many ticks the newest slice had."""
        self._measured_ns += self._passed_ns
        self._ran += ticks
        if self._measured_ns >= PACE_NS:
            self.pace = round(WHOLE * self._ran * 1_000_000_000 / (self._measured_ns * self._tick_hz))
            self._measured_ns = self._ran = 0
