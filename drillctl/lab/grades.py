"""What a measured lateness is good for: grades A to E, and what to do for a better one.

Rule: a grade asks two things, how often a tick is late and how long the longest wait was; each line of the table must
hold for both. The waits are those at which execution acts (execution/clock.py).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from drillctl.execution.clock import FAULT_MS, HOLD_MS
from drillctl.viewmodel.reports import Grade

GOOD_SHARE = 0.005  # late ticks that a job does not mind: a step is stretched here and there
RATES_HZ = (20_000, 10_000, 5_000, 2_000, 1_000, 500, 250, 200, 100, 50)


class Rung(NamedTuple):
    """A grade: at most this share of ticks late, and no wait longer."""

    letter: str
    late_share: float
    longest_ms: float
    good_for: str


RUNGS = (
    Rung("A", 0.0, HOLD_MS, "any job at this rate: no tick was late"),
    Rung("B", 0.001, HOLD_MS, "drilling: now and then a step is stretched, nothing else"),
    Rung("C", GOOD_SHARE, HOLD_MS, "drilling: long moves hesitate once in a while"),
    Rung("D", 0.02, FAULT_MS, "trying out without a board: moves falter, and long waits put the machine on hold"),
    Rung("E", 1.0, float("inf"), "simulation only: motors would stall and jobs end in LATE_TICK"),
)


@dataclass(frozen=True, slots=True)
class Finding:
    """What the advice depends on. ``platform_share`` is of the labelled late ticks."""

    late_share: float
    longest_ms: float
    real_time: bool
    platform_share: float
    tick_hz: int
    carries_hz: int


class Advice(NamedTuple):
    """A sentence, and when it is given."""

    fits: Callable[[Finding], bool]
    sentence: str


ADVICE = (  # the first that fits
    Advice(lambda f: f.late_share == 0 and f.real_time, "nothing to do"),
    Advice(lambda f: not f.real_time, "grant the measures named above: without them any other load makes ticks late"),
    Advice(
        lambda f: 0 < f.carries_hz < f.tick_hz,
        "this rate is too high for this computer, as busy as it is: choose a lower one, or end other work on it",
    ),
    Advice(
        lambda f: f.platform_share >= 0.5,
        "the computer stood still by itself: end other work on it, switch power saving off, leave a virtual machine "
        "for a real one, or take a PREEMPT_RT kernel",
    ),
    Advice(lambda f: True, "measure again, for longer; if it stays, it is a fault of this program"),
)


def grade(finding: Finding) -> Grade:
    """The best rung that holds, with the advice that fits."""
    rung = next(r for r in RUNGS if finding.late_share <= r.late_share and finding.longest_ms <= r.longest_ms)
    return Grade(rung.letter, rung.good_for, next(a.sentence for a in ADVICE if a.fits(finding)))


def carried_hz(lateness_us: float, tick_us: float) -> int:
    """The greatest usual rate whose period holds this lateness and then the tick itself; 0 for none."""
    return next((rate for rate in RATES_HZ if lateness_us + tick_us <= 1e6 / rate), 0)
