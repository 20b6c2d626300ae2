"""The paced clock on a time of its own: deadlines are absolute, a gap is never made up for, lateness is counted."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.execution.clock import PacedClock

PERIOD_NS = 2_000_000  # 500 Hz
HALF_NS = PERIOD_NS // 2


class FakeTime:
    """A time that goes on only while somebody sleeps or works; each sleep ends late by the next of ``delays_ns``."""

    def __init__(self, delays_ns: list[int]):
        self.now = 1_000_000_000
        self.delays_ns = iter(delays_ns)

    def now_ns(self) -> int:
        return self.now

    def sleep_s(self, seconds: float) -> None:
        assert seconds > 0
        self.now += round(seconds * 1e9) + next(self.delays_ns, 0)

    def work(self, ns: int) -> None:
        self.now += ns


def clock_on(time: FakeTime) -> PacedClock:
    return PacedClock(500, time.now_ns, time.sleep_s)


def begun(delays_ns: list[int], ticks: int) -> list[int]:
    """When each tick began, from the start of the clock, where sleeps end late by these."""
    time = FakeTime(delays_ns)
    clock = clock_on(time)
    start_ns = time.now
    return [clock.begun_ns - start_ns for _ in range(ticks) if clock.wait() is not None]


def test_ticks_begin_on_their_deadlines() -> None:
    assert begun([], 4) == [PERIOD_NS, 2 * PERIOD_NS, 3 * PERIOD_NS, 4 * PERIOD_NS]


def test_jitter_does_not_add_up() -> None:
    jitter_ns = [HALF_NS, 70_000, 50_000] * 1000
    assert begun(jitter_ns, 3000)[-1] == 3000 * PERIOD_NS + 50_000


@pytest.mark.parametrize(("tick_hz", "periods"), [(500, 1), (1000, 1), (5000, 5), (8000, 8), (100_000, 100)])
def test_at_rest_a_wake_comes_a_millisecond_later_or_a_period(tick_hz: int, periods: int) -> None:
    time = FakeTime([])
    clock = PacedClock(tick_hz, time.now_ns, time.sleep_s)
    assert clock.wait() == 0
    first_ns = clock.begun_ns
    clock.rest()
    assert clock.wait() == 0 and clock.begun_ns - first_ns == periods * clock.period_ns
    assert clock.wait() == 0 and clock.begun_ns - first_ns == (periods + 1) * clock.period_ns


def test_a_gap_moves_every_later_deadline_with_it() -> None:
    gap_ns = 7 * PERIOD_NS + 11
    assert begun([0, gap_ns], 5) == [PERIOD_NS, *(n * PERIOD_NS + gap_ns for n in (2, 3, 4, 5))]


@pytest.mark.parametrize(
    ("late_ns", "periods"),
    [
        pytest.param(0, 0, id="on time"),
        pytest.param(HALF_NS, 0, id="jitter"),
        pytest.param(HALF_NS + 1, 0, id="moves the deadlines"),
        pytest.param(PERIOD_NS, 0, id="a period is not late"),
        pytest.param(PERIOD_NS + 1, 1, id="more than a period is"),
        pytest.param(2 * PERIOD_NS - 1, 1, id="less than two"),
        pytest.param(2 * PERIOD_NS, 2, id="two"),
        pytest.param(25 * PERIOD_NS + 3, 25, id="many"),
    ],
)
def test_lateness_is_told_in_whole_periods(late_ns: int, periods: int) -> None:
    clock = clock_on(FakeTime([late_ns]))
    assert clock.wait() == periods
    assert (clock.late_ns, clock.worst_ns, clock.late) == (late_ns, late_ns, int(periods > 0))
    assert clock.wait() == 0
    assert (clock.late_ns, clock.worst_ns, clock.late) == (0, late_ns, int(periods > 0))


def test_work_that_outlasts_its_period_makes_the_next_tick_late() -> None:
    time = FakeTime([])
    clock = clock_on(time)
    clock.wait()
    time.work(4 * PERIOD_NS)
    assert clock.wait() == 3
    assert clock.deadline_ns == clock.begun_ns + PERIOD_NS


@given(st.lists(st.integers(0, 6 * PERIOD_NS), max_size=60), st.lists(st.integers(0, 3 * PERIOD_NS), max_size=60))
def test_never_a_burst(delays_ns: list[int], works_ns: list[int]) -> None:
    """Whatever holds up the sleeps and the ticks: two are half a period apart at least, and no tick is early."""
    time = FakeTime(delays_ns)
    clock = clock_on(time)
    starts_ns = [time.now]
    for work_ns in [*works_ns, *[0] * len(delays_ns), 0]:
        deadline_ns = clock.deadline_ns
        told = clock.wait()
        assert clock.begun_ns >= deadline_ns
        assert told == (clock.late_ns // PERIOD_NS if clock.late_ns > PERIOD_NS else 0)
        starts_ns.append(clock.begun_ns)
        time.work(work_ns)
    assert all(after - before >= HALF_NS for before, after in pairwise(starts_ns))
