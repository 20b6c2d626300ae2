"""The paced clock: sleeps to absolute deadlines, one a tick. A late tick is counted and never made up for.

Rule: time is stretched. A tick that begins more than half a period late moves all later deadlines with it, so two
ticks are never closer together than half a period; what is less is jitter, and the next tick is on time again.
"""

import time
from collections.abc import Callable

from drillctl.execution.conditions import Event, occur, raise_fault
from drillctl.execution.controller import Controller
from drillctl.execution.motion import SETTLING
from drillctl.execution.stops import too_fast_to_stop
from drillctl.kmd import Fault

REST_NS = 1_000_000  # a wake at rest serves what the desk asks; the desk looks every 10 ms


class PacedClock:
    """Begins ticks by the clock. ``begun_ns``: when the newest began, ``late_ns`` after its deadline; ``late`` counts
    those that began more than a period too late, ``worst_ns`` is the greatest lateness. Time can be handed in
    (``now_ns``, ``sleep_s``).
    """

    def __init__(
        self,
        tick_hz: int,
        now_ns: Callable[[], int] = time.monotonic_ns,
        sleep_s: Callable[[float], object] = time.sleep,
    ):
        self._now_ns, self._sleep_s = now_ns, sleep_s
        self.period_ns = 1_000_000_000 // tick_hz
        self.begun_ns = now_ns()
        self.deadline_ns = self.begun_ns + self.period_ns
        self.late = self.late_ns = self.worst_ns = 0

    def set_rate(self, tick_hz: int) -> None:
        """The period from the next tick on."""
        self.period_ns = 1_000_000_000 // tick_hz

    def rest(self) -> None:
        """Puts the next deadline off by whole periods, to REST_NS from the last: nothing is to be done."""
        self.deadline_ns += max(0, REST_NS // self.period_ns - 1) * self.period_ns

    def wait(self) -> int:
        """Sleeps to the next deadline; returns how many whole periods the tick begins too late, mostly 0."""
        left_ns = self.deadline_ns - self._now_ns()
        if left_ns > 0:
            self._sleep_s(left_ns / 1e9)
        self.begun_ns = self._now_ns()
        self.late_ns = late_ns = self.begun_ns - self.deadline_ns
        self.worst_ns = max(self.worst_ns, late_ns)
        self.deadline_ns += self.period_ns
        if late_ns * 2 > self.period_ns:
            self.deadline_ns += late_ns
        if late_ns <= self.period_ns:
            return 0
        self.late += 1
        return late_ns // self.period_ns


HOLD_MS = 50
FAULT_MS = 250


def apply_gap(m: Controller) -> None:
    """The gap before this tick: every axis that it stopped starts anew; a long one holds, a longer one is a fault."""
    gap_ticks, m.gap = m.late, 0
    stopped = [axis for axis in m.axes if axis.motion > SETTLING and gap_ticks > axis.interval[0]]
    m.caught = any(too_fast_to_stop(m, axis) for axis in stopped)
    for axis in stopped:
        axis.start_again()
    gap_ms = gap_ticks * 1000 // m.tick_hz
    if gap_ms > FAULT_MS and (m.busy or m.moving):
        m.position_known = m.position_known and not m.caught
        raise_fault(m, Fault.LATE_TICK)
    elif gap_ms > HOLD_MS:
        occur(m, Event.HOLD)
