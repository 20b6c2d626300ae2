"""Where only the unit is declared its default digits hold: METRIC 000.000, INCH 00.0000."""

import pytest

from drillctl.generation.drillfile import DrillFile, decode


def board(header: str, drill: str, *lines: str, body: str = "") -> DrillFile:
    text = "\n".join(["M48", header, f"T1C{drill}", "%", *([body] if body else []), "T1", *lines, "M30", ""])
    return decode(text.encode(), name="board.drl")


def codes(found: DrillFile) -> set[str]:
    return {remark.code for remark in found.warnings}


SLOT = [f"X{30000 + 200 * hit}Y20000" for hit in range(11)]


@pytest.mark.parametrize(
    ("header", "drill", "lines", "bbox_mm"),
    [
        ("METRIC,LZ", "3.2", ["X005Y005", "X165Y005", "X005Y105", "X165Y105"], (5, 5, 165, 105)),
        ("METRIC,LZ", "3.2", ["X01Y02", "X1Y2"], (10, 20, 100, 200)),
        ("METRIC,LZ", "3.2", ["X010Y020", "X150Y020"], (10, 20, 150, 20)),
        ("METRIC,TZ", "0.8", ["X5000Y5000", "X105000Y5000"], (5, 5, 105, 5)),
        ("METRIC,TZ", "1.0", SLOT, (30, 20, 32, 20)),
        ("METRIC,TZ", "1.0", [*SLOT, *(line.replace("Y20", "Y25") for line in SLOT)], (30, 20, 32, 25)),
        ("METRIC", "1.0", ["X030000Y020000", "X030500Y020000"], (30, 20, 30.5, 20)),
        ("INCH,TZ", "0.0315", ["X9Y9", "X10000Y20000"], (0.02286, 0.02286, 25.4, 50.8)),
        ("INCH,LZ", "0.0315", ["X01Y02", "X015Y02"], (25.4, 50.8, 38.1, 50.8)),
        ("M72,TZ", "0.0315", ["X10000Y20000", "X15000Y20000"], (25.4, 50.8, 38.1, 50.8)),
        ("M71,LZ", "0.8", ["X01Y02", "X15Y02"], (10, 20, 150, 20)),
    ],
)
def test_the_units_default_digits(header: str, drill: str, lines: list[str], bbox_mm: tuple[float, ...]) -> None:
    assert board(header, drill, *lines).bbox_mm == pytest.approx(bbox_mm)


def test_the_rule_alone_is_no_guess() -> None:
    found = board("INCH,LZ", "0.031", "X01Y01", "X015Y01", "X02Y02")
    assert (found.warnings, found.confidence, found.runner_up) == ((), 1.0, None)
    assert "inch without digits is 2:4" in found.reason


@pytest.mark.parametrize(
    ("header", "line", "digits"),
    [
        ("METRIC,TZ", "X1000000Y12345", "four decimals: longer than 000.000"),
        ("INCH,TZ", "X01000Y02000", "full width of another format"),
    ],
)
def test_default_digits_that_can_not_be_are_left_and_told(header: str, line: str, digits: str) -> None:
    found = board(header, "0.8" if header.startswith("M") else "0.03", line, line.replace("2", "3"))
    assert "default-digits-left" in codes(found), digits


def test_a_metric_file_never_has_two_integer_digits() -> None:
    found = board("METRIC,LZ", "0.8", *(f"X{x:02}Y{y:02}" for x in range(1, 30, 7) for y in range(1, 30, 7)))
    assert found.format.digits == (3, 3)


@pytest.mark.parametrize(
    ("header", "drill", "lines"),
    [
        ("METRIC,TZ,000.000", "3.2", ["X1000Y1000", "X11000Y8000"]),  # declared, and absurd all the same
        ("METRIC", "3.2", ["X1.0Y1.0", "X11.0Y8.0"]),
        ("METRIC,TZ", "0.8", ["X1000Y1000", "X5000Y5000"]),
        ("METRIC,TZ", "0.8", ["X1000Y1000", "X700000Y5000"]),
    ],
)
def test_a_board_that_is_absurd_for_its_drills_is_told(header: str, drill: str, lines: list[str]) -> None:
    assert "odd-board" in codes(board(header, drill, *lines))


def test_digits_of_one_unit_do_not_carry_to_the_other() -> None:
    found = board("METRIC,TZ,000.000", "0.8", "X10000Y10000", "X20000Y10000", body="M72")
    assert found.bbox_mm == pytest.approx((25.4, 25.4, 50.8, 25.4))
    assert {"units-change-in-body", "digits-of-other-unit"} <= codes(found)


@pytest.mark.parametrize("header", ["METRIC,TZ", "M71"])
def test_units_that_change_where_no_digits_were_declared_have_their_defaults(header: str) -> None:
    found = board(header, "0.8", "X1.0Y1.0", "X10000Y20000", "M72", "X1.0", "X010000Y005000")
    assert "units-change-in-body" in codes(found) and "digits-of-other-unit" not in codes(found)
    assert found.hole_xy_mm[-1].tolist() == pytest.approx([25.4, 12.7])


def test_units_that_change_between_holes() -> None:
    found = board("METRIC,TZ,000.000", "0.8", "X10000Y10000", "X20000Y10000", "M72", "X10000Y20000", "Y30000")
    assert found.hole_xy_mm.tolist() == [[10, 10], [20, 10], [25.4, 50.8], [25.4, pytest.approx(76.2)]]
    assert {"units-change-in-body", "digits-of-other-unit"} <= codes(found)


def test_an_axis_keeps_its_place_when_the_units_change() -> None:
    found = board("METRIC,TZ,000.000", "0.8", "X10000Y10000", "M72", "X10000")
    assert found.hole_xy_mm[1].tolist() == [25.4, pytest.approx(10)]


@pytest.mark.parametrize("kept", ["TZ", "LZ"])
def test_keep_zeros_contradicts_neither(kept: str) -> None:
    header = f";FORMAT={{2:4/ absolute / inch / keep zeros}}\nINCH,{kept}"
    found = board(header, "0.035", "X010000Y005000", "X011000Y005000")
    assert (found.warnings, found.bbox_mm) == ((), pytest.approx((25.4, 12.7, 27.94, 12.7)))


def test_few_places_that_leave_the_zeros_open_are_told() -> None:
    found = board("INCH", "0.126", "X11811Y11811", "X21811Y21811")
    assert "format-guessed" in codes(found)
