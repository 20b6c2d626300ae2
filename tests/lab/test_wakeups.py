"""The log of wakes on made-up ones: percentiles, bars, what was late, and whose fault that was."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.lab.wakeups import LONGEST_US, MOST_LATE, WakeupLog, bars, covered_ns, lateness, overlapping, quantile_us

PERIOD_NS = 2_000_000


def log_of(late_ns: list[int]) -> WakeupLog:
    log = WakeupLog()
    for number, late in enumerate(late_ns):
        log.add((number + 1) * 1_000_000_000 + late, late, PERIOD_NS)
    return log


def spans(*pairs: tuple[int, int]) -> np.ndarray:
    return np.array(pairs, np.int64).reshape(-1, 2)


span_lists = st.lists(st.tuples(st.integers(0, 60), st.integers(0, 9)).map(lambda p: (p[0], p[0] + p[1])), max_size=12)


@given(st.lists(st.integers(0, LONGEST_US * 1000), min_size=1, max_size=300))
def test_percentiles_are_those_of_the_wakes(late_ns: list[int]) -> None:
    told = lateness([log_of(late_ns)])
    exact = np.quantile(np.array(late_ns) // 1000, [0.5, 0.99, 0.999], method="inverted_cdf")
    assert (told.p50_us, told.p99_us, told.p999_us) == tuple(exact.tolist())
    assert (told.wakes, told.max_us) == (len(late_ns), max(late_ns) // 1000)


def test_several_processes_count_together() -> None:
    told = lateness([log_of([1000] * 3), log_of([9000])])
    assert (told.wakes, told.p50_us, told.max_us) == (4, 1, 9)


def test_more_than_a_period_is_late() -> None:
    log = log_of([0, PERIOD_NS, PERIOD_NS + 1])
    assert log.late_spans().tolist() == [[3_000_000_000, 3_002_000_001]]


def test_what_is_later_than_all_bins_is_counted_and_its_greatest_kept() -> None:
    log = log_of([(LONGEST_US + 5) * 1000])
    assert lateness([log]).max_us == LONGEST_US + 5 and log.record["counts"][-1] == 1


def test_late_wakeups_beyond_the_room_are_counted() -> None:
    log = WakeupLog()
    log.record["late_wakeups"] = MOST_LATE - 1
    for _ in range(3):
        log.add(9_000_000_000, 3 * PERIOD_NS, PERIOD_NS)
    assert log.record["late_wakeups"] == MOST_LATE + 2 and len(log.late_spans()) == MOST_LATE


def test_nothing_was_logged() -> None:
    assert lateness([WakeupLog()]).p999_us == 0 and bars(WakeupLog().record["counts"]) == ()


@given(st.lists(st.integers(0, 3 * LONGEST_US), min_size=1, max_size=50))
def test_every_wake_is_in_its_bar(late_us: list[int]) -> None:
    rows = bars(log_of([late * 1000 for late in late_us]).record["counts"])
    for row in rows:
        top = float("inf") if row.to_us is None else row.to_us
        assert row.ticks == sum(row.from_us <= min(late, LONGEST_US) < top for late in late_us)
    assert sum(row.ticks for row in rows) == len(late_us) and rows[0].ticks and rows[-1].ticks


def test_a_quantile_is_never_below_its_share() -> None:
    assert [quantile_us(np.array([1, 0, 1]), share) for share in (0.5, 0.51, 1.0)] == [0, 2, 2]


@pytest.mark.parametrize(
    ("tick", "canary", "platform"),
    [
        pytest.param((10, 20), (5, 15), True, id="begins before"),
        pytest.param((10, 20), (15, 25), True, id="ends after"),
        pytest.param((10, 20), (12, 13), True, id="within"),
        pytest.param((10, 20), (5, 25), True, id="around"),
        pytest.param((10, 20), (5, 10), False, id="ends as it begins"),
        pytest.param((10, 20), (20, 25), False, id="begins as it ends"),
        pytest.param((10, 20), (30, 40), False, id="later"),
    ],
)
def test_one_tick_and_one_canary(tick: tuple[int, int], canary: tuple[int, int], platform: bool) -> None:
    assert overlapping(spans(tick), spans(canary)).tolist() == [platform]


def test_punctual_canaries_leave_all_to_us() -> None:
    assert overlapping(spans((1, 2), (3, 4)), spans()).tolist() == [False, False]


@given(span_lists, span_lists)
def test_as_pair_by_pair(ticks: list[tuple[int, int]], canaries: list[tuple[int, int]]) -> None:
    ticks, canaries = ([(a, b + 1) for a, b in rows] for rows in (ticks, canaries))  # late is never by nothing
    expected = [any(a < d and c < b for c, d in canaries) for a, b in ticks]
    assert overlapping(spans(*ticks), spans(*canaries)).tolist() == expected


@given(span_lists, st.integers(0, 30), st.integers(30, 70))
def test_covered_time_is_counted_once(rows: list[tuple[int, int]], first: int, last: int) -> None:
    expected = sum(any(a <= t < b for a, b in rows) for t in range(first, last))
    assert covered_ns(spans(*rows), first, last) == expected
