"""Alignment from measured holes: known maps must be found again, and doubtful measurements must be named."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.generation.alignment import decompose, fit, load
from drillctl.generation.measured import AlignmentError, parse
from drillctl.generation.placing import Affine, Placing, transform

SQUARE_MM = np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 80.0], [0.0, 80.0]])
turns_deg = st.floats(-179, 179)
shifts_mm = st.tuples(st.floats(-200, 200), st.floats(-200, 200))


def placed(
    turn_deg: float = 0.0,
    scale: tuple[float, float] = (1.0, 1.0),
    shear: float = 0.0,
    mirrored: bool = False,
    shift_mm: tuple[float, float] = (0.0, 0.0),
) -> Affine:
    """The map with these parts, in the order that `decompose` documents."""
    angle_rad = math.radians(turn_deg)
    turn = np.array([[math.cos(angle_rad), -math.sin(angle_rad)], [math.sin(angle_rad), math.cos(angle_rad)]])
    mirror = np.diag([-1.0 if mirrored else 1.0, 1.0])
    return Affine.of(turn @ [[scale[0], shear * scale[1]], [0.0, scale[1]]] @ mirror, shift_mm)


@given(turns_deg, shifts_mm, st.booleans(), st.sampled_from([2, 3, 4]))
def test_a_shift_and_turn_is_found_from_any_number_of_holes(
    turn_deg: float, shift_mm: tuple[float, float], mirrored: bool, holes: int
) -> None:
    truth = placed(turn_deg, mirrored=mirrored, shift_mm=shift_mm)
    found = fit(SQUARE_MM[:holes], truth.apply(SQUARE_MM[:holes]), mirrored=mirrored)
    np.testing.assert_allclose(found.affine.matrix, truth.matrix, atol=1e-9)
    assert found.kind == ("rigid" if holes == 2 else "affine")
    assert found.rms_mm < 1e-9 and abs(found.length_error_mm) < 1e-9 and not found.warnings


@given(turns_deg, st.floats(0.985, 1.015), st.floats(0.985, 1.015), st.floats(-0.015, 0.015), st.booleans())
def test_scale_and_shear_are_found_and_taken_apart(
    turn_deg: float, scale_x: float, scale_y: float, shear: float, mirrored: bool
) -> None:
    truth = placed(turn_deg, (scale_x, scale_y), shear, mirrored, (3.0, 4.0))
    found = fit(SQUARE_MM, truth.apply(SQUARE_MM), mirrored=mirrored)
    parts = decompose(found.affine)
    assert (parts.scale_x, parts.scale_y, parts.shear) == pytest.approx((scale_x, scale_y, shear), abs=1e-9)
    assert parts.turn_deg == pytest.approx(turn_deg, abs=1e-6)
    assert parts.mirrored == mirrored and not found.warnings


def test_two_holes_share_the_length_error() -> None:
    found = fit([[0.0, 0.0], [100.0, 0.0]], [[10.0, 5.0], [110.4, 5.0]])
    assert found.length_error_mm == pytest.approx(0.4)
    assert found.residual_mm == pytest.approx([0.2, 0.2])
    assert found.rms_mm == pytest.approx(0.2)
    assert decompose(found.affine).scale_x == pytest.approx(1.0)  # the size is not stretched to fit


def test_least_squares_beats_every_neighbouring_map() -> None:
    measured_mm = SQUARE_MM + np.random.default_rng(1996).normal(0, 0.1, SQUARE_MM.shape)
    found = fit(SQUARE_MM, measured_mm)
    for entry in np.ndindex(2, 3):
        for change in (1e-4, -1e-4):
            matrix = found.affine.matrix.copy()
            matrix[entry] += change
            worse_mm = np.hypot(*(Affine(matrix).apply(SQUARE_MM) - measured_mm).T)
            assert np.sum(worse_mm**2) > np.sum(found.residual_mm**2)


def test_residuals_name_the_hole_that_was_mistaken() -> None:
    measured_mm = np.vstack([SQUARE_MM, [[50.0, 40.0]]])
    measured_mm[4] += (0.0, 3.0)
    found = fit(np.vstack([SQUARE_MM, [[50.0, 40.0]]]), measured_mm)
    assert found.residual_mm.argmax() == 4
    assert found.warnings == ("measured hole 5 is 2.400 mm off; was it another hole?",)


def test_spare_holes_tell_how_far_the_residuals_can_be_trusted() -> None:
    assert fit(SQUARE_MM[:3], SQUARE_MM[:3]).spare_holes == 0
    assert fit(SQUARE_MM, SQUARE_MM).spare_holes == 1


def test_holes_on_one_line_give_shift_and_turn_and_say_so() -> None:
    line_mm = np.array([[0.0, 0.0], [30.0, 30.01], [90.0, 90.0]])
    found = fit(line_mm, placed(12.0).apply(line_mm))
    assert found.kind == "rigid" and decompose(found.affine).turn_deg == pytest.approx(12.0)
    assert any("one line" in warning for warning in found.warnings)


@pytest.mark.parametrize(
    ("truth", "holes", "mirrored", "words"),
    [
        (placed(scale=(1.03, 1.0)), 4, False, "scale in x is 1.0300"),
        (placed(scale=(1.0, 0.97)), 4, False, "scale in y is 0.9700"),
        (placed(scale=(25.4, 25.4)), 2, False, "scale along the holes is 25.4"),
        (placed(shear=0.05), 4, False, "shear is 0.0500"),
        (placed(mirrored=True), 4, False, "show the board face down, but face up was asked"),
        (placed(), 3, True, "show the board face up, but face down was asked"),
    ],
)
def test_implausible_maps_are_warned_about(truth: Affine, holes: int, mirrored: bool, words: str) -> None:
    found = fit(SQUARE_MM[:holes], truth.apply(SQUARE_MM[:holes]), mirrored=mirrored)
    assert any(words in warning for warning in found.warnings)


def test_holes_close_together_are_warned_about() -> None:
    assert "the turn is uncertain" in fit([[0, 0], [5, 0]], [[0, 0], [5, 0]]).warnings[0]


@pytest.mark.parametrize(
    ("file_mm", "machine_mm", "reason"),
    [
        ([[0, 0]], [[0, 0]], "a turn needs two"),
        ([], [], "a turn needs two"),
        ([[0, 0], [1, 1]], [[0, 0]], "2 holes of the file but 1 measured"),
        ([[7, 7], [7, 7.05]], [[0, 0], [9, 9]], "all file coordinates are the same place"),
        ([[0, 0], [9, 9]], [[7, 7], [7, 7]], "all machine coordinates are the same place"),
        ([[0, 0], [90, 0], [0, 90]], [[0, 0], [90, 0], [45, 0]], "lie on one line"),
        ([[0, 0], [90, 0], [90, 90], [0, 90]], [[0, 0], [90, 90], [0, 0], [90, 90]], "lie on one line"),
    ],
)
def test_measurements_that_settle_nothing_are_refused(
    file_mm: list[list[float]], machine_mm: list[list[float]], reason: str
) -> None:
    with pytest.raises(AlignmentError, match=reason):
        fit(file_mm, machine_mm)


@given(st.lists(st.tuples(*[st.sampled_from([0.0, 1e-3, 1.0, 50.0, -80.0, 1e4])] * 4), max_size=6))
def test_any_measurements_are_fitted_or_refused(rows: list[tuple[float, float, float, float]]) -> None:
    measured_mm = np.array(rows).reshape(-1, 4)
    try:
        found = fit(measured_mm[:, :2], measured_mm[:, 2:])
    except AlignmentError:
        return
    np.testing.assert_allclose(found.affine.then(found.affine.inverse()).linear, np.eye(2), atol=1e-6)
    assert np.isfinite([found.rms_mm, *vars(decompose(found.affine)).values()]).all()


def test_a_file_is_read_fitted_and_places_the_board(tmp_path: Path) -> None:
    path = tmp_path / "board.align"
    path.write_bytes(b"\xef\xbb\xbf# measured\r\n\r\n0 0  10 20 # corner\r\n 100 0 10 120\r\n")
    found = load(path)
    affine = transform(Placing(alignment=found.affine), [[0, 0]])
    np.testing.assert_allclose(affine.apply([[50.0, 10.0]]), [[0.0, 70.0]], atol=1e-9)


@pytest.mark.parametrize(
    ("data", "where", "reason"),
    [
        (b"0 0 1 1\n0 0 1\n", "2:6", "3 numbers where file_x file_y machine_x machine_y are expected"),
        (b"0 0 1 1 7\n", "1:9", "5 numbers"),
        (b"# x\n0  1,5 1 1\n", "2:4", "file_y '1,5' is not a number; write a point, not a comma"),
        (b"0 0 nan 1\n", "1:5", "machine_x 'nan' is not a number"),
        (b"0 0 1_0 1\n", "1:5", "machine_x '1_0' is not a number"),
        (b"0 0 0 -1e9\n", "1:7", "machine_y -1e9 is not within 10000 mm"),
        (b"0 0 1 1\n\xff\xfe\n", "2:1", "not a text file"),
        (b"0 0 1 " + b"9" * 5000 + b"x\n", "1:7", "is not a number"),
        (b" " * 1_000_001, "1:1", "longer than"),
    ],
)
def test_wrong_lines_are_named_by_file_line_and_column(data: bytes, where: str, reason: str) -> None:
    with pytest.raises(AlignmentError) as caught:
        parse(data, name="x.align")
    assert str(caught.value).startswith(f"x.align:{where}: ") and reason in str(caught.value)
    assert len(str(caught.value)) < 200


def test_a_file_that_is_not_there_or_says_too_little_is_named(tmp_path: Path) -> None:
    with pytest.raises(AlignmentError, match=r"none\.align: cannot be read: No such file"):
        load(tmp_path / "none.align")
    (tmp_path / "one.align").write_text("0 0 1 1\n")
    with pytest.raises(AlignmentError, match=r"one\.align: 1 measured"):
        load(tmp_path / "one.align")


@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused_by_name(data: bytes) -> None:
    try:
        measured = parse(data, name="x")
    except AlignmentError as error:
        assert str(error).startswith("x:")
    else:
        assert measured.file_xy_mm.shape == measured.machine_xy_mm.shape
