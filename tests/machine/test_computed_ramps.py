"""Ramps of hundreds of states: computed from figures, proven in a moment, and what they ask of a carriage."""

from itertools import pairwise
from pathlib import Path
from time import process_time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drillctl.machine import Library, RampTable, TableError, intervals, shipped_tables
from drillctl.machine.edit import set_state_row, with_rows
from drillctl.machine.ramp_figures import axis_figures, ramp_figures
from drillctl.machine.ramp_file import parse_ramp, ramp_rows
from drillctl.machine.ramp_formula import MOST_STATES, Computed, FormulaError, computed_intervals
from drillctl.machine.source import Source
from drillctl.machine.travel import cruising_from, travel_ticks

LIBRARY = Library((shipped_tables(),))
DRUM = LIBRARY.machine("boiler-drum")
SHIPPED = shipped_tables() / "ramp" / "even-interval.toml"
GEARS_M_MIN = (0.16, 0.2, 0.25, 0.315, 0.4, 0.5, 0.63, 0.8, 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5)


def gear_ticks(metres_a_minute: float) -> int:
    return round(DRUM.tick_hz * 60 * 0.02 / (metres_a_minute * 1000))


def text_of(**figures: object) -> str:
    known: dict[str, object] = {"tick_hz": 100000, "pulse_mm": 0.02, "start_hz": 400, "top_hz": 4000} | figures
    return 'name = "some"\n[computed]\n' + "\n".join(f"{key} = {value}" for key, value in known.items()) + "\n"


def computed(**figures: object) -> RampTable:
    return parse_ramp(Source(Path("some.toml"), text_of(**figures)))


def test_the_drums_ramp_is_one_that_its_carriage_can_follow() -> None:
    for axis in DRUM.axes:
        figures = axis_figures(axis, DRUM.tick_hz)
        assert figures.greatest_m_s2 <= 1.5
        assert figures.ratio <= 0.15
        assert axis.ramp.top >= 100
        assert axis.ramp.interval[axis.ramp.top] == gear_ticks(5) == 24


@pytest.mark.parametrize("metres_a_minute", GEARS_M_MIN)
def test_a_gear_is_a_floor_within_three_parts_of_a_thousand(metres_a_minute: float) -> None:
    ticks = gear_ticks(metres_a_minute)
    assert DRUM.tick_hz / ticks * 0.02 * 60 / 1000 == pytest.approx(metres_a_minute, rel=0.003)
    ramp = DRUM.axes[0].ramp
    assert intervals(ramp, 2 * cruising_from(ramp, ticks), ticks)[cruising_from(ramp, ticks)] == ticks


@pytest.mark.parametrize("metres_a_minute", GEARS_M_MIN)
def test_a_short_stroke_runs_whole_under_the_starting_interval_and_a_long_one_reaches_its_gear(
    metres_a_minute: float,
) -> None:
    ramp, ticks = DRUM.axes[0].ramp, gear_ticks(metres_a_minute)
    slowest = max(ramp.interval[0], ticks)
    lengths = [len(set(intervals(ramp, steps, ticks))) for steps in range(1, cruising_from(ramp, ticks) + 2)]
    ramped = [steps for steps, speeds in enumerate(lengths, 1) if speeds > 1]
    for steps in range(1, min(ramped, default=2)):
        assert intervals(ramp, steps, ticks) == [slowest] * steps
    for steps in ramped:
        assert min(intervals(ramp, steps, ticks)) == max(ticks, ramp.interval[ramp.top])


FIGURES = st.fixed_dictionaries(
    {"start_hz": st.integers(50, 900), "top_hz": st.integers(901, 20_000)},
    optional={"acceleration_m_s2": st.floats(0.05, 50), "curved_share": st.floats(0, 1)},
)


@given(FIGURES, st.none() | st.integers(1, 40))
@settings(max_examples=80, deadline=None)
def test_a_computed_ramp_keeps_its_acceleration_never_slows_and_lands(
    figures: dict[str, float], shrink_ticks: int | None
) -> None:
    if shrink_ticks is None:
        figures = {"acceleration_m_s2": 1.0} | figures
    asked = Computed(100_000, 0.02, **figures, shrink_ticks=shrink_ticks)
    try:
        waits = computed_intervals(asked)
    except FormulaError:
        return
    assert all(after <= before for before, after in pairwise(waits))
    ramp = computed(**figures, **({} if shrink_ticks is None else {"shrink_ticks": shrink_ticks}))
    assert ramp.interval[: ramp.top + 1] == tuple(waits)
    assert ramp.first_inexact() is None
    if asked.acceleration_m_s2 is not None:
        assert ramp_figures(ramp, 100_000, 0.02).greatest_m_s2 <= asked.acceleration_m_s2 * (1 + 1e-9)
    if shrink_ticks is not None:
        assert max(before - after for before, after in pairwise(waits)) <= shrink_ticks


def test_an_s_share_begins_and_ends_gently() -> None:
    """Its acceleration is below half of the greatest at both ends, that of a straight ramp is the greatest at once."""

    def first_gain(share: float) -> float:
        waits = computed_intervals(Computed(100_000, 0.02, 400, 4000, acceleration_m_s2=1.0, curved_share=share))
        return (100_000 / waits[2] - 100_000 / waits[0]) * 0.02 / 1000 / (sum(waits[:2]) / 100_000)

    assert first_gain(0.8) < 0.5
    assert first_gain(0) > 0.75


def test_the_proof_of_thousands_of_states_takes_a_moment() -> None:
    rows = [(state, state, state + 1 if state else 0, 30) for state in range(MOST_STATES + 1)]
    columns = [[row[i] for row in rows] + [row[i] for row in reversed(rows[1:])] for i in (3, 1, 2)]
    begun = process_time()
    assert RampTable("long", MOST_STATES, *map(tuple, columns)).first_inexact() is None
    columns[2][MOST_STATES] = columns[2][MOST_STATES - 1] = columns[2][MOST_STATES - 2]
    missed = RampTable("long", MOST_STATES, *map(tuple, columns)).first_inexact()
    assert missed is not None and missed[0] > 1
    assert process_time() - begun < 5  # seconds of CPU: the proof by walking took minutes


def test_thousands_of_rows_are_read_from_a_file() -> None:
    text = with_rows(text_of(acceleration_m_s2=0.1), ramp_rows(Source(Path("t"), text_of(acceleration_m_s2=0.1))))
    ramp = parse_ramp(Source(Path("t"), text))
    assert ramp.top > 1500
    assert ramp == computed(acceleration_m_s2=0.1)


def test_editing_a_state_of_a_computed_ramp_writes_its_rows_out() -> None:
    source = Source.read(SHIPPED)
    text = set_state_row(with_rows(source.text, ramp_rows(source)), 0, "interval", 260)
    ramp, before = parse_ramp(Source(SHIPPED, text)), parse_ramp(source)
    assert "[computed]" not in text and text.startswith(source.text.splitlines()[0])
    assert ramp.interval == (260, *before.interval[1:])
    assert (ramp.accelerate, ramp.brake, ramp.whole_strokes) == (before.accelerate, before.brake, True)


REFUSED = [
    ({"shrink_ticks": 1, "top_hz": 300}, "computed: top_hz 300 is not above start_hz 400", "top_hz"),
    ({}, "computed: shrink_ticks or acceleration_m_s2 is missing", "start_hz"),
    ({"shrink_ticks": 1, "acceleration_m_s2": 1e-6}, "computed: the ramp has more than 4096 states", "start_hz"),
    ({"acceleration_m_s2": 1e-6}, "computed: the ramp has more than 4096 states", "start_hz"),
    ({"shrink_ticks": 1, "start_hz": 0.5}, "computed: start_hz 0.5 is an interval of 200000 ticks", "start_hz"),
    ({"shrink_ticks": 1.5}, "computed.shrink_ticks: expected int", "shrink_ticks"),
    ({"curved_share": 1.5, "acceleration_m_s2": 1}, "computed.curved_share: expected float <= 1.0", "curved_share"),
    ({"shrink": 1}, "computed: unknown key shrink", "shrink"),
]


@pytest.mark.parametrize(("figures", "reason", "key"), REFUSED)
def test_figures_that_make_no_ramp_are_refused_with_their_line(
    figures: dict[str, object], reason: str, key: str
) -> None:
    text = text_of(**figures)
    with pytest.raises(TableError) as refused:
        parse_ramp(Source(Path("some.toml"), text))
    assert refused.value.reason.startswith(reason)
    assert text.splitlines()[(refused.value.line or 0) - 1].startswith(f"{key} =")


def test_a_machine_of_another_scale_is_refused(tmp_path: Path) -> None:
    (tmp_path / "machines").mkdir()
    file = tmp_path / "machines" / "other.toml"
    text = (shipped_tables() / "machines" / "boiler-drum.toml").read_text("utf-8")
    for old, new in (("tick_hz = 100000", "tick_hz = 50000"), ("columns_per_inch = 1270", "columns_per_inch = 1200")):
        file.write_text(text.replace(old, new))
        with pytest.raises(TableError, match="is computed for 100000 ticks a second"):
            Library((tmp_path, shipped_tables())).machine(str(file))


def test_travel_of_whole_strokes_grows_by_the_starting_interval() -> None:
    ramp = DRUM.axes[0].ramp
    assert [travel_ticks(ramp, steps) for steps in (1, 2, 3)] == [250, 500, 750]
