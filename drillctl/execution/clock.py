"""The paced clock: sleeps to absolute deadlines, one a tick. A late tick is counted and never made up for.

Rule: time is stretched. A tick that begins more than a period late moves all later deadlines with it, so two steps
are never closer together than a period. Handed to the ticker, which asks it before each tick.
"""

import time


class PacedClock:
    """``late`` counts ticks that began more than a period after their deadline; times are nanoseconds."""

    def __init__(self, tick_hz: int):
        self.period_ns = 1_000_000_000 // tick_hz
        self.deadline_ns = time.monotonic_ns() + self.period_ns
        self.late = 0
        self.worst_ns = 0

    def wait(self) -> int:
        """Sleeps to the next deadline; returns how many whole periods the tick begins too late, mostly 0."""
        left_ns = self.deadline_ns - time.monotonic_ns()
        if left_ns > 0:
            time.sleep(left_ns / 1e9)
        late_ns = time.monotonic_ns() - self.deadline_ns
        self.worst_ns = max(self.worst_ns, late_ns)
        self.deadline_ns += self.period_ns
        if late_ns <= self.period_ns:
            return 0
        self.late += 1
        self.deadline_ns += late_ns
        return late_ns // self.period_ns
