"""Grades of lateness: the table's thresholds, the advice, and the rate that a lateness would carry."""

import pytest

from drillctl.lab.grades import RATES_HZ, RUNGS, Finding, carried_hz, grade


@pytest.mark.parametrize(
    ("late_share", "longest_ms", "letter"),
    [
        (0.0, 0.1, "A"), (0.0, 50.0, "A"), (0.0, 50.1, "D"), (0.001, 9.0, "B"), (0.0011, 9.0, "C"),
        (0.005, 50.0, "C"), (0.0051, 9.0, "D"), (0.02, 250.0, "D"), (0.0, 250.1, "E"), (0.021, 3.0, "E"),
        (1.0, 1e6, "E"),
    ],
)  # fmt: skip
def test_thresholds(late_share: float, longest_ms: float, letter: str) -> None:
    assert grade(Finding(late_share, longest_ms, True, 0.0, 500, 500)).letter == letter


def test_each_rung_allows_more() -> None:
    assert "".join(rung.letter for rung in RUNGS) == "ABCDE"
    for column in ("late_share", "longest_ms"):
        values = [getattr(rung, column) for rung in RUNGS]
        assert values == sorted(values)


@pytest.mark.parametrize(
    ("finding", "words"),
    [
        (Finding(0.0, 1.0, True, 0.0, 500, 500), "nothing to do"),
        (Finding(0.0, 1.0, False, 0.0, 500, 500), "grant"),
        (Finding(0.1, 9.0, True, 0.5, 500, 500), "computer stood still"),
        (Finding(0.1, 9.0, True, 0.9, 500, 200), "lower"),
        (Finding(0.1, 9.0, True, 0.4, 500, 500), "fault of this program"),
    ],
)
def test_advice(finding: Finding, words: str) -> None:
    assert words in grade(finding).advice


@pytest.mark.parametrize(
    ("lateness_us", "tick_us", "rate"),
    [(0.0, 10.0, RATES_HZ[0]), (1900.0, 100.0, 500), (1900.0, 101.0, 250), (20_000.0, 1.0, 0)],
)
def test_a_rate_must_hold_the_lateness_and_the_tick(lateness_us: float, tick_us: float, rate: int) -> None:
    assert carried_hz(lateness_us, tick_us) == rate
