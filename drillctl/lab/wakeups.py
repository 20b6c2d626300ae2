"""How late one process woke up, in memory that its parent can read: a histogram, and the times of late wakeups.

Rule: the memory is of fixed size and made before the fork; late wakeups that no longer fit are only counted.
"""

import mmap
import os

import numpy as np
from numpy.typing import NDArray

from drillctl.viewmodel.reports import Bar, Lateness

Spans = NDArray[np.int64]  # (n, 2): from, to, in ns of the monotonic clock
LONGEST_US = 100_000  # later than that is counted with it; the greatest is known all the same
MOST_LATE = 1 << 16
MOST_TEXT = 1024
LOG = np.dtype(
    [
        ("counts", "<i8", LONGEST_US + 1),  # of wakeups, by whole microseconds of lateness
        ("late", "<i8", (MOST_LATE, 2)),  # monotonic ns: the deadline, and when it came to it
        ("late_wakeups", "<i8"),
        ("worst_ns", "<i8"),
        ("cpu_ns", "<i8"),
        ("from_ns", "<i8"),
        ("to_ns", "<i8"),
        ("refused", f"S{MOST_TEXT}"),
        ("ready", "<i8"),
        ("go", "<i8"),
        ("leave", "<i8"),
    ]
)


class WakeupLog:
    """The wakeups of one process, made by its parent. Times are nanoseconds of the monotonic clock.

    ``record`` (LOG) also has the flags by which the two wait for each other: ready, go, leave.
    """

    def __init__(self) -> None:
        self._owner = os.getpid()
        memory = mmap.mmap(-1, LOG.itemsize)
        self.record: np.void = np.frombuffer(memory, LOG, 1)[0]
        self._counts: NDArray[np.int64] = self.record["counts"]
        self._late: NDArray[np.int64] = self.record["late"]

    def add(self, begun_ns: int, late_ns: int, period_ns: int) -> None:
        """Adds a wakeup at ``begun_ns``, so much after its deadline; it counts as late by more than a period."""
        self._counts[min(late_ns // 1000, LONGEST_US)] += 1
        self.record["worst_ns"] = max(int(self.record["worst_ns"]), late_ns)
        if late_ns > period_ns:
            kept = int(self.record["late_wakeups"])
            if kept < MOST_LATE:
                self._late[kept] = begun_ns - late_ns, begun_ns
            self.record["late_wakeups"] = kept + 1

    @property
    def wanted(self) -> bool:
        """For the child: whether to go on. False once its parent wants it to leave, or is gone."""
        return not self.record["leave"] and os.getppid() == self._owner

    @property
    def wakeups(self) -> int:
        """How many wakeups there were."""
        return int(self._counts.sum())

    @property
    def elapsed_ns(self) -> int:
        """The time from before the first wakeup to after the last."""
        return int(self.record["to_ns"] - self.record["from_ns"])

    def late_spans(self) -> Spans:
        """(n, 2): deadline and wakeup of the first MOST_LATE late wakeups."""
        return self._late[: min(int(self.record["late_wakeups"]), MOST_LATE)].copy()


def quantile_us(counts: NDArray[np.int64], share: float) -> int:
    """The lateness that ``share`` of the wakeups did not exceed, in whole microseconds, rounded down; 0 for none."""
    reached = np.cumsum(counts)
    return int(np.searchsorted(reached, share * reached[-1])) if reached[-1] else 0


def lateness(logs: list[WakeupLog]) -> Lateness:
    """Percentiles over the wakeups of all these processes together."""
    counts = np.sum([log.record["counts"] for log in logs], axis=0)
    p50_us, p99_us, p999_us = (quantile_us(counts, share) for share in (0.5, 0.99, 0.999))
    worst_ns = max(int(log.record["worst_ns"]) for log in logs)
    return Lateness(int(counts.sum()), p50_us, p99_us, p999_us, worst_ns // 1000)


def bars(counts: NDArray[np.int64]) -> tuple[Bar, ...]:
    """The histogram in doubling steps, from the first that holds a wakeup to the last."""
    edges = [0, *(1 << power for power in range(LONGEST_US.bit_length()))]
    sums = np.add.reduceat(counts, edges).tolist()
    rows = [Bar(low, high, ticks) for low, high, ticks in zip(edges, [*edges[1:], None], sums, strict=True)]
    held = np.flatnonzero(sums)
    return tuple(rows[held[0] : held[-1] + 1]) if len(held) else ()


def overlapping(spans: Spans, others: Spans) -> NDArray[np.bool_]:
    """(n,): which of ``spans`` (n, 2) overlap one of ``others`` (m, 2). Touching is not overlapping."""
    if not len(others):
        return np.zeros(len(spans), bool)
    others = others[np.argsort(others[:, 0])]
    ends = np.maximum.accumulate(others[:, 1])
    begun_before = np.searchsorted(others[:, 0], spans[:, 1])
    return (begun_before > 0) & (ends[begun_before - 1] > spans[:, 0])


def covered_ns(spans: Spans, from_ns: int, to_ns: int) -> int:
    """How much of the time from ``from_ns`` to ``to_ns`` lies in at least one of ``spans`` (n, 2)."""
    if not len(spans):
        return 0
    spans = np.clip(spans[np.argsort(spans[:, 0])], from_ns, to_ns)
    ends = np.maximum.accumulate(spans[:, 1])
    begins = np.maximum(spans[:, 0], np.concatenate([[from_ns], ends[:-1]]))
    return int(np.maximum(spans[:, 1] - begins, 0).sum())
