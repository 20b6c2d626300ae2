"""Ramps from an axis's parameters: their length, speed and acceleration, and what the tick rate can't give."""

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.drive_ramp import FROM_PARAMETERS, KEPT_WITHIN, ROUNDING, drive_ramp, pulses_per_mm
from drillctl.machine.parameters import ParameterRow
from drillctl.machine.ramp_figures import ramp_figures
from drillctl.machine.ramp_formula import FormulaError

M_S2 = 3_600_000  # mm/min2


def row(
    speed: float | None, acceleration: float = M_S2, s_share: float = 0.0, gear: tuple[int, int] = (1, 1)
) -> ParameterRow:
    given = {
        "greatest_speed_mm_min": speed, "acceleration_mm_min2": acceleration, "s_share": s_share,
        "pulse_equivalent_mm": 0.01, "gear_numerator": gear[0], "gear_denominator": gear[1],
    }  # fmt: skip
    return ParameterRow(tuple((name, value) for name, value in given.items() if value is not None))


@pytest.mark.parametrize(
    ("tick_hz", "speed", "s_share", "steps", "interval"),
    [
        (100_000, 10_000, 0, 1389, 3),  # v*v / 2a of 10 m/min at 1 m/s2
        (100_000, 10_000, 0.5, 1851, 3),  # ... / (1 - S/2)
        (100_000, 10_000, 1, 2777, 3),
        (8_000, 2_400, 0, 80, 1),
        (8_000, 1_200, 0, 20, 2),
    ],
)
def test_a_ramp_is_as_long_as_its_acceleration_asks_for(
    tick_hz: int, speed: float, s_share: float, steps: int, interval: int
) -> None:
    ramp = drive_ramp(row(speed, s_share=s_share), tick_hz, 2)
    assert ramp.top == pytest.approx(steps, abs=1)
    assert (ramp.interval[ramp.top], ramp.interval[-ramp.top]) == (interval, interval)
    assert ramp.first_inexact() is None if ramp.top < 200 else True


@settings(max_examples=15, deadline=None)
@given(
    tick_hz=st.integers(1000, 100_000),
    interval=st.integers(4, 40),
    acceleration=st.floats(1, 20),
    share=st.floats(0, 1),
)
def test_neither_speed_nor_acceleration_is_ever_above_the_parameters(
    tick_hz: int, interval: int, acceleration: float, share: float
) -> None:
    speed = tick_hz / 2 / interval * 60 * 0.01
    try:
        ramp = drive_ramp(row(speed, acceleration * M_S2, share), tick_hz, 2)
    except FormulaError as error:
        assert error.key == "acceleration_mm_min2", "more steps than a ramp has"
        return
    assert speed * (1 - KEPT_WITHIN) <= tick_hz / 2 / ramp.interval[ramp.top] * 0.6 <= speed * (1 + ROUNDING)
    assert list(ramp.interval[: ramp.top + 1]) == sorted(ramp.interval[: ramp.top + 1], reverse=True)
    assert ramp_figures(ramp, tick_hz, 0.005, 2).greatest_m_s2 <= acceleration * (1 + 1e-6) or ramp.top == 1


@pytest.mark.parametrize(
    ("speed", "words"),
    [
        (2401.0, None),
        (2500.0, "can't give 2500 mm/min; the greatest is 2400"),
        (2390.0, "the nearest are 1200 and 2400"),
        (1180.0, "the nearest are 800 and 1200"),
        (1224.0, None),
        (1225.0, "the nearest are 1200 and 2400"),
    ],
)
def test_a_speed_that_the_tick_rate_can_not_give_is_refused_by_name(speed: float, words: str | None) -> None:
    if words is None:
        assert drive_ramp(row(speed), 8000, 2).top > 1
        return
    with pytest.raises(FormulaError) as refused:
        drive_ramp(row(speed), 8000, 2)
    assert refused.value.key == "greatest_speed_mm_min"
    assert str(refused.value).startswith("greatest_speed_mm_min: ") and words in str(refused.value)


def test_the_gear_is_an_exact_fraction() -> None:
    assert pulses_per_mm(row(2400, gear=(3, 7))) == Fraction(700, 3)
    assert pulses_per_mm(ParameterRow()) is None


def test_an_axis_with_unset_parameters_is_slow() -> None:
    ramp = drive_ramp(row(None), 8000, 2)
    assert (ramp.top, set(ramp.interval)) == (1, {80})


EIGHT = shipped_tables() / "machines" / "eight-axis.toml"
X = "[parameters.axis.x]"


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (("greatest_speed_mm_min = 2400.0", "greatest_speed_mm_min = 4800.0"),
         "parameters.axis.x: greatest_speed_mm_min: the tick rate can't give 4800 mm/min; the greatest is 2400"),
        (("acceleration_mm_min2 = 3600000.0", "acceleration_mm_min2 = 3600.0"),
         "parameters.axis.x: acceleration_mm_min2: the ramp has more than 4096 steps"),
        (("gear_numerator = 1", "gear_numerator = 2"),
         "axis x: columns_per_inch 5080, and pulse equivalent and gear make it 2540"),
    ],
)  # fmt: skip
def test_a_file_whose_parameters_make_no_ramp_is_refused(tmp_path: Path, change: tuple[str, str], reason: str) -> None:
    text = EIGHT.read_text("utf-8")
    before, after = text.split(X)
    file = tmp_path / "mine.toml"
    file.write_text(before + X + after.replace(*change, 1), "utf-8")
    with pytest.raises(TableError) as refused:
        Library((shipped_tables(),)).machine(str(file))
    assert reason in str(refused.value)


def test_a_geared_axis_is_placed_by_the_exact_fraction(tmp_path: Path) -> None:
    """3/7 of 0.01 mm a pulse: an inch has 11853 and a third columns."""
    text = EIGHT.read_text("utf-8").replace("columns_per_inch = 5080", "columns_per_inch = 11853", 1)
    before, after = text.split(X)
    after = after.replace("gear_numerator = 1", "gear_numerator = 3", 1).replace(
        "gear_denominator = 1", "gear_denominator = 7", 1
    )
    after = after.replace("greatest_speed_mm_min = 2400.0", "greatest_speed_mm_min = 1028.6", 1)
    file = tmp_path / "mine.toml"
    file.write_text(before + X + after, "utf-8")
    axis = Library((shipped_tables(),)).machine(str(file)).axes[0]
    assert (axis.pulses_per_mm, axis.ramp.name) == (Fraction(700, 3), FROM_PARAMETERS)
    assert axis.steps_per_mm == pytest.approx(700 / 3, rel=1e-15)
    assert replace(axis, pulses_per_mm=None).steps_per_mm != axis.steps_per_mm
