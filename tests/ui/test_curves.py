"""Curves in characters: no peak is left out, however many values a column has; and the scope's, with its measures."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.ui.screens.scope_curve import CURVE_LINES, curve_lines, height_of
from drillctl.ui.screens.scope_measure import between, command_after
from drillctl.ui.widgets.curves import curve_rows
from drillctl.viewmodel.scope import Changes, ScopeSignal, Strip

values = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=300)


@given(values, st.integers(1, 40), st.integers(1, 8), st.booleans())
def test_a_curve_fills_its_box_and_touches_its_highest_and_its_lowest_row(
    drawn: list[float], columns: int, rows: int, plain: bool
) -> None:
    lines = curve_rows(drawn, columns, rows, plain)
    assert len(lines) == rows and all(len(line) == columns for line in lines)
    assert lines[-1].strip(), "the lowest value is in the lowest row"
    assert max(drawn) == min(drawn) or lines[0].strip(), "and the highest in the highest"
    assert not plain or "".join(lines).isascii()


def test_a_peak_of_one_value_among_thousands_is_seen() -> None:
    drawn = [0.0] * 5000
    drawn[2345] = 1.0
    assert "*" in curve_rows(drawn, 10, 3, plain=True)[0]


@pytest.mark.parametrize(("columns", "rows"), [(0, 3), (5, 0), (-2, 3)])
def test_no_room_draws_nothing(columns: int, rows: int) -> None:
    assert "".join(curve_rows([1.0, 2.0], columns, rows)).strip() == "" == "".join(curve_rows([], 5, 2)).strip()


class Steps:
    """A run of 100 ticks at 50 Hz: x makes a step in ticks 10, 12 and 14 and one back in tick 80; two commands."""

    first_tick, last_tick, tick_hz = 0, 99, 50
    ticks = np.array([0, 10, 12, 14, 80])
    positions = np.array([0, 1, 2, 3, 2])
    commands = np.array([0, 5, 79]), np.array([0, 1, 2])

    def signals(self) -> tuple[ScopeSignal, ...]:
        return ScopeSignal("x", "position", "count"), ScopeSignal("kmd", "command", "words")

    def known_to(self, signal: int) -> int:
        return 100

    def shown(self, signal: int, value: int, tick: int) -> str:
        return {1: "1 KMD_RUCHd x=3", 2: "2 KMD_RUCHd x=-1"}[value]

    def window(self, signal: int, first: int, last: int) -> Changes:
        ticks, changed = (self.ticks, self.positions) if signal == 0 else self.commands
        begin = int(np.searchsorted(ticks, first, side="right")) - 1
        inside = np.flatnonzero((ticks > first) & (ticks < last))
        return Changes(np.append(first, ticks[inside]), np.append(changed[begin], changed[inside]))

    def strip(self, signal: int, edges: "np.ndarray[tuple[int], np.dtype[np.int64]]") -> Strip:
        ends = np.searchsorted(self.ticks, edges[1:], side="left") - 1
        begins = np.searchsorted(self.ticks, edges[:-1], side="left")
        return Strip(self.positions[ends], np.maximum(ends + 1 - begins, 0))


def test_a_position_has_its_speed_below_in_steps_a_second() -> None:
    edges = np.arange(0, 101, 2)
    lines = curve_lines(Steps(), 0, edges, 50, 2 * CURVE_LINES, True)  # type: ignore[arg-type]
    labels = [label for label, _row in lines]
    assert labels[1] == "0..3" and labels[CURVE_LINES] == "steps/s"
    low, _, high = labels[-1].partition("..")
    assert float(high) == 25.0, "a step every second tick at 50 Hz"
    assert -1 < float(low) < 0, "one step back after 66 ticks"
    top = lines[0][1]
    assert top[7] == "*" and top[3] == " ", "three steps from tick 14 on"


@pytest.mark.parametrize(("shape", "name", "height"), [("wire", "1a", 1), ("words", "command", 1),
    ("count", "position", 2 * CURVE_LINES), ("count", "x_i1_mA", CURVE_LINES)])  # fmt: skip
def test_only_numbers_have_curves(shape: str, name: str, height: int) -> None:
    assert height_of(ScopeSignal("x", name, shape)) == height  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("marks", "cursor", "told"),
    [
        pytest.param((), 5, "A and B: not set", id="no marks"),
        pytest.param((("A", 0), ("B", 20)), 99, "A 0 B 20: 20 ticks, 400 ms, 2.5 Hz, steps: X +3", id="there"),
        pytest.param(
            (("A", 90), ("B", 20)), 99, "A 90 B 20: 70 ticks, 1400 ms, 0.7143 Hz, steps: X -1", id="the later first"
        ),
        pytest.param((("A", 20),), 30, "A 20: 10 ticks, 200 ms, 5 Hz, no steps", id="to the cursor"),
    ],
)
def test_an_interval_is_told_in_ticks_milliseconds_and_steps(
    marks: tuple[tuple[str, int], ...], cursor: int, told: str
) -> None:
    assert between(Steps(), marks, cursor) == told  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("tick", "text", "found"),
    [
        (0, "ruch", 5),
        (5, "ruch", 79),
        (0, "x=-1", 79),
        (0, "kmd*-1", 79),
        (0, "[x]", None),
        (0, "", None),
        (79, "ruch", None),
    ],
)
def test_a_command_is_found_by_a_part_of_its_text(tick: int, text: str, found: int | None) -> None:
    assert command_after(Steps(), tick, text) == found  # type: ignore[arg-type]
