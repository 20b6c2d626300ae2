"""Pictures of numbers: in characters, and as files where matplotlib is."""

import sys

import numpy as np
import pytest

from drillctl.ui.terminal.charts import LEAST_COLUMNS, MARGIN, ChartLook, picture_lines
from drillctl.ui.terminal.image_file import PictureRefused, check_format, picture_bytes
from drillctl.viewmodel.reports import Chart, Curve, Picture, Style


def picture(*curves: Curve, to_scale: bool = False) -> Picture:
    return Picture("title", (Chart("across", "up", curves, to_scale),), ("a note",))


RAMP = Curve.of("ramp", [0, 1, 2, 3], [0, 1, 2, 3])


def body(lines: list[str]) -> list[str]:
    return [line.split("|", 1)[1] for line in lines if "|" in line]


def test_a_line_goes_from_corner_to_corner() -> None:
    lines = picture_lines(picture(RAMP), ChartLook(40, 5, plain=True))
    rows = body(lines)
    assert lines[0] == "title" and lines[-1] == "a note" and "-- ramp" in lines[2]
    assert [len(row) for row in rows] == [30] * 5
    assert rows[0].strip() == rows[0].lstrip() and rows[-1][0] == "*" and rows[0][-1] == "*"
    assert all(any(row[column] == "*" for row in rows) for column in range(30)), "the line has a gap"
    assert any(line.split() == ["0", "3"] for line in lines)


def test_a_value_that_is_no_number_breaks_the_line() -> None:
    broken = Curve.of("broken", [0, 1, 2, 3, 4, 5], [1, 1, np.nan, np.nan, 1, 1])
    row = next(row for row in body(picture_lines(picture(broken), ChartLook(50, 5, plain=True))) if row.strip())
    assert row[0] == row[-1] == "*" and row[len(row) // 2] == " "


def test_stairs_hold_their_value_up_to_the_next_point() -> None:
    stairs = Curve.of("stairs", [0, 1], [0, 1], Style.STAIRS)
    rows = body(picture_lines(picture(stairs), ChartLook(30, 5, plain=True)))
    assert rows[-1].rstrip() == "*" * 20 and [row.strip() for row in rows[:-1]] == ["*"] * 4


def test_points_alone_are_not_joined() -> None:
    points = Curve.of("points", [0, 1], [0, 1], Style.POINTS)
    rows = body(picture_lines(picture(points), ChartLook(40, 6, plain=True)))
    assert sum(row.count("*") for row in rows) == 2


def test_to_scale_a_square_is_square_in_dots() -> None:
    square = Curve.of("square", [0, 10, 10, 0], [0, 0, 10, 10], Style.POINTS)
    rows = body(picture_lines(picture(square, to_scale=True), ChartLook(80, 10, plain=True)))
    assert len(rows) * 4 == len(rows[0]) * 2


@pytest.mark.parametrize("curve", [Curve.of("still", [1, 2], [5, 5]), Curve.of("one", [7], [7])], ids=["still", "one"])
def test_what_has_no_extent_is_drawn(curve: Curve) -> None:
    assert "*" in "".join(body(picture_lines(picture(curve), ChartLook(40, 5, plain=True))))


def test_nothing_to_draw_is_said() -> None:
    lines = picture_lines(picture(Curve.of("none", [1], [np.nan])), ChartLook(40, 5))
    assert "up: nothing to be drawn" in lines


def test_colours_are_for_terminals_and_a_narrow_one_is_too_narrow() -> None:
    plain, coloured = (picture_lines(picture(RAMP, RAMP), ChartLook(1, 3, coloured)) for coloured in (False, True))
    assert not any("\x1b" in line for line in plain) and any("\x1b[33m" in line for line in coloured)
    assert max(len(row) for row in body(plain)) == LEAST_COLUMNS - MARGIN


def test_several_curves_are_told_apart_without_colours() -> None:
    curves = [Curve.of(f"level {level}", [0, 9], [level, level]) for level in range(4)]
    lines = picture_lines(picture(*curves), ChartLook(60, 8, plain=True))
    assert [name in lines[2] for name in ("a level 0", "b level 1", "c level 2", "d level 3")] == [True] * 4
    rows = body(lines)
    assert ["".join(filter(str.isalpha, row)) for row in rows if row.strip()] == ["d", "c", "b", "a"]
    same = [Curve.of(name, [0, 9], [1, 1]) for name in ("this one", "the other")]
    line = next(row for row in body(picture_lines(picture(*same), ChartLook(60, 8, plain=True))) if row.strip())
    assert line.strip("*").replace("*", "") == "ab", "curves that cover each other have both their letters"


def test_a_legend_without_room_beside_stands_below() -> None:
    curves = [Curve.of("a very long name of a curve " * 2, [0, 1], [0, 1]) for _ in range(2)]
    lines = picture_lines(picture(*curves), ChartLook(80, 5))
    assert lines[2] == "up" and lines[3].startswith("a a very") and lines[4].startswith("b a very")


def test_curves_have_as_many_values_as_places() -> None:
    with pytest.raises(ValueError, match="odd"):
        Curve.of("odd", [1, 2], [1])


@pytest.mark.parametrize(("suffix", "begin"), [(".png", b"\x89PNG"), (".SVG", b"<?xml")])
def test_files_are_the_same_bytes_each_time(suffix: str, begin: bytes) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is an extra: pip install '.[plot]'")
    first, second = (picture_bytes(picture(RAMP, to_scale=True), check_format(suffix)) for _ in range(2))
    assert first == second and first.startswith(begin)


def test_another_kind_of_file_is_refused() -> None:
    with pytest.raises(PictureRefused, match=r"a \.png or a \.svg, not '\.pdf'"):
        check_format(".pdf")


def test_without_matplotlib_it_is_said_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(PictureRefused, match=r"pip install 'matplotlib"):
        check_format(".png")
