"""Placing a board: each option by hand on one asymmetric board, then what must hold for all of them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.generation.placing import Affine, Panel, Placing, PlacingError, boards, transform

BOARD_MM = np.array([[10.0, 20.0], [40.0, 20.0], [10.0, 25.0]])

millimetres = st.floats(-500, 500, allow_nan=False)
points_mm = st.lists(st.tuples(millimetres, millimetres), min_size=1, max_size=20)
panels = st.builds(
    Panel,
    columns=st.integers(1, 4),
    rows=st.integers(1, 4),
    pitch_x_mm=st.floats(1, 100),
    pitch_y_mm=st.floats(1, 100),
    order=st.sampled_from(["serpentine", "rows"]),
)
placings = st.builds(
    Placing,
    origin=st.sampled_from([None, "base", "file"]),
    mirror=st.sampled_from([None, "x", "y"]),
    rotate_deg=st.floats(-720, 720, allow_nan=False),
    offset_mm=st.tuples(millimetres, millimetres),
    panel=st.none() | panels,
)


def as_filed(**options: Any) -> Placing:
    return Placing(origin="file", **options)


@pytest.mark.parametrize(
    ("placing", "expected_mm"),
    [
        pytest.param(as_filed(), [[10, 20], [40, 20], [10, 25]], id="as the file has it"),
        pytest.param(Placing(), [[0, 0], [30, 0], [0, 5]], id="lowest corner at the base"),
        pytest.param(Placing(offset_mm=(1, -2)), [[1, -2], [31, -2], [1, 3]], id="offset after the corner"),
        pytest.param(as_filed(mirror="x"), [[-10, 20], [-40, 20], [-10, 25]], id="x changes sign"),
        pytest.param(as_filed(mirror="y"), [[10, -20], [40, -20], [10, -25]], id="y changes sign"),
        pytest.param(Placing(mirror="x"), [[30, 0], [0, 0], [30, 5]], id="mirrored, then cornered"),
        pytest.param(as_filed(rotate_deg=90), [[-20, 10], [-20, 40], [-25, 10]], id="left turn"),
        pytest.param(as_filed(rotate_deg=-90), [[20, -10], [20, -40], [25, -10]], id="right turn"),
        pytest.param(Placing(rotate_deg=180), [[30, 5], [0, 5], [30, 0]], id="upside down"),
        pytest.param(as_filed(mirror="x", rotate_deg=90), [[-20, -10], [-20, -40], [-25, -10]], id="mirror first"),
    ],
)
def test_where_the_holes_come_to_lie(placing: Placing, expected_mm: list[list[float]]) -> None:
    # Quarter turns are exact, so nothing is approximate here.
    np.testing.assert_array_equal(transform(placing, BOARD_MM).apply(BOARD_MM), expected_mm)


def test_rotation_by_an_odd_angle_is_counter_clockwise() -> None:
    turned = transform(as_filed(rotate_deg=30), BOARD_MM).apply([[2.0, 0.0]])
    np.testing.assert_allclose(turned, [[np.sqrt(3), 1.0]])


def test_corner_counts_all_points_handed_in_but_maps_any() -> None:
    affine = transform(Placing(), [[5.0, 5.0], [9.0, 1.0]])
    np.testing.assert_array_equal(affine.apply([[6.0, 6.0]]), [[1.0, 5.0]])


def test_board_without_a_point_lies_at_the_files_zero() -> None:
    affine = transform(Placing(offset_mm=(3.0, 4.0)), np.zeros((0, 2)))
    np.testing.assert_array_equal(affine.apply([[0.0, 0.0]]), [[3.0, 4.0]])
    assert affine.apply(np.zeros((0, 2))).shape == (0, 2)


@given(placings, points_mm)
def test_holes_made_map_back_to_the_file(placing: Placing, xy_mm: list[tuple[float, float]]) -> None:
    for board in boards(placing, xy_mm):
        np.testing.assert_allclose(board.inverse().apply(board.apply(xy_mm)), xy_mm, atol=1e-9)


@given(placings, points_mm)
def test_distances_are_kept(placing: Placing, xy_mm: list[tuple[float, float]]) -> None:
    before, after = np.array(xy_mm), transform(placing, xy_mm).apply(xy_mm)
    np.testing.assert_allclose(np.hypot(*(after - after[0]).T), np.hypot(*(before - before[0]).T), atol=1e-9)


@given(placings, points_mm)
def test_lowest_corner_lies_at_base_plus_offset(placing: Placing, xy_mm: list[tuple[float, float]]) -> None:
    lowest_mm = transform(placing, xy_mm).apply(xy_mm).min(axis=0)
    if placing.origin != "file":
        np.testing.assert_allclose(lowest_mm, placing.offset_mm, atol=1e-9)


@given(placings, points_mm)
def test_then_is_one_map_after_the_other(placing: Placing, xy_mm: list[tuple[float, float]]) -> None:
    one, other = transform(placing, xy_mm), Affine.of([[1.0, 0.2], [0.0, 0.9]], (7.0, -3.0))
    np.testing.assert_allclose(one.then(other).apply(xy_mm), other.apply(one.apply(xy_mm)), atol=1e-9)


@pytest.mark.parametrize(
    ("order", "expected_mm"),
    [
        ("rows", [[0, 0], [50, 0], [100, 0], [0, 40], [50, 40], [100, 40]]),
        ("serpentine", [[0, 0], [50, 0], [100, 0], [100, 40], [50, 40], [0, 40]]),
    ],
)
def test_panel_steps_and_repeats(order: str, expected_mm: list[list[float]]) -> None:
    panel = Panel(columns=3, rows=2, pitch_x_mm=50, pitch_y_mm=40, order=order)
    np.testing.assert_array_equal(panel.shifts_mm(), expected_mm)
    placed = [board.apply(BOARD_MM[:1])[0] for board in boards(Placing(panel=panel), BOARD_MM)]
    np.testing.assert_array_equal(placed, expected_mm)


def test_panel_repeats_along_the_machine_whatever_the_board_is_turned_to() -> None:
    panel = Panel(columns=2, rows=1, pitch_x_mm=50, pitch_y_mm=0)
    first, second = boards(Placing(rotate_deg=90, mirror="x", panel=panel), BOARD_MM)
    np.testing.assert_array_equal(second.apply(BOARD_MM) - first.apply(BOARD_MM), [[50, 0]] * 3)


def test_panel_on_a_measured_sheet_is_turned_with_the_sheet() -> None:
    turned = Affine.of([[0.0, -1.0], [1.0, 0.0]], (100.0, 0.0))
    panel = Panel(columns=2, rows=1, pitch_x_mm=50, pitch_y_mm=0)
    first, second = boards(Placing(alignment=turned, panel=panel), BOARD_MM)
    np.testing.assert_array_equal(first.matrix, turned.matrix)
    np.testing.assert_array_equal(second.apply(BOARD_MM), turned.apply(BOARD_MM + np.array([50.0, 0.0])))


@pytest.mark.parametrize(
    ("option", "name"),
    [
        ({"origin": "base"}, "origin"),
        ({"origin": "file"}, "origin"),
        ({"mirror": "x"}, "mirror"),
        ({"rotate_deg": 5.0}, "rotate"),
        ({"offset_mm": (0.0, 1.0)}, "offset"),
    ],
)
def test_alignment_decides_alone(option: dict[str, Any], name: str) -> None:
    with pytest.raises(PlacingError, match=f"^{name} given together with an alignment: the measured holes"):
        Placing(alignment=Affine.of(np.eye(2)), **option)


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: Placing(mirror="z"), "mirror 'z' is not known; give 'x' or 'y'"),
        (lambda: Placing(origin="corner"), "origin 'corner' is not known; give 'base' or 'file'"),
        (lambda: Placing(rotate_deg=float("nan")), "must be plain numbers"),
        (lambda: Placing(offset_mm=(0.0, float("inf"))), "must be plain numbers"),
        (lambda: Panel(0, 1, 10, 10), "has no board"),
        (lambda: Panel(1000, 1000, 10, 10), "1000 are the most"),
        (lambda: Panel(2, 1, 0, 10), "one board into another"),
        (lambda: Panel(1, 2, 10, 0), "one board into another"),
        (lambda: Panel(1, 1, 0, 0, order="spiral"), "panel order 'spiral' is not known"),
        (lambda: Affine.of([[1.0, 2.0], [2.0, 4.0]]).inverse(), "flattens the board"),
        (lambda: Affine(np.full((2, 3), np.nan)), "finite numbers"),
        (lambda: Affine(np.eye(2)), "finite numbers"),
    ],
)
def test_what_cannot_be_meant_is_refused(make: Callable[[], Any], reason: str) -> None:
    with pytest.raises(PlacingError, match=reason):
        make()


def test_a_map_cannot_be_changed_behind_its_owners_back() -> None:
    with pytest.raises(ValueError, match="read-only"):
        Affine.of(np.eye(2)).matrix[0, 0] = 2.0
