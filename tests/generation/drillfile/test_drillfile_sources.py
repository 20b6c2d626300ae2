"""Sources that contradict each other, diameters that can't be, files cut short, and what stands behind the end."""

import pytest

from drillctl.generation.drillfile import DrillFile, DrillFileError, decode, read
from drillctl.generation.drillfile.intake import CHUNK_BYTES, LINE_LIMIT
from drillctl.generation.drillfile.sidefiles import BYTE_LIMIT

BODY = "X10.0Y10.0\nX30.0Y20.0\n"
HEADER = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nT1\n"


def board(definitions: str, select: str = "T1", units: str = "METRIC") -> str:
    return f"M48\n{units}\n{definitions}%\n{select}\n{BODY}M30\n"


def read_text(text: str, **options: object) -> DrillFile:
    return decode(text.encode(), name="test.drl", **options)


def refusal(text: str, **options: object) -> str:
    with pytest.raises(DrillFileError) as caught:
        read_text(text, **options)
    return caught.value.code


def codes(found: DrillFile) -> list[str]:
    return [remark.code for remark in found.warnings]


# -- tools ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("definitions", "select", "number", "diameter_mm"),
    [
        ("T01C0.8\nT03C1.2\n", "T0302", 3, 1.2),
        ("T01C0.8\n", "T0100", 1, 0.8),
        ("T0001C0.8\nT0002C1.2\n", "T0002", 2, 1.2),
        ("T10C0.5\nT1000C1.2\n", "T1", None, None),
        ("T10C0.5\nT999C0.8\nT1000C1.2\n", "T1000", 1000, 1.2),
        ("T10C0.5\n", "T1000", 10, 0.5),
        ("T1C0.8\nT0100C0.8\n", "T0100", 1, 0.8),
        ("T100C0.8\nT101C1.2\n", "T0101", 101, 1.2),
    ],
)
def test_four_digits(definitions: str, select: str, number: int | None, diameter_mm: float | None) -> None:
    if number is None:
        assert refusal(board(definitions, select)) == "tool-redefined"  # T1000 is tool 10 with index 0 here
        return
    tool = read_text(board(definitions, select)).tools
    used = read_text(board(definitions, select)).hole_tool[0]
    assert (tool[used].number, tool[used].diameter_mm) == (number, diameter_mm)


def test_four_digits_that_could_mean_two_tools() -> None:
    assert refusal(board("T1C0.8\nT100C3.2\n", "T0100")) == "ambiguous-tool"


def test_a_thousand_tools_in_sequence() -> None:
    definitions = "".join(f"T{number}C{0.5 + number / 1000:.3f}\n" for number in range(1, 1201))
    found = read_text(board(definitions, "T1000"))
    assert found.tools[found.hole_tool[0]].diameter_mm == 1.5 and not found.warnings


@pytest.mark.parametrize(
    ("units", "written", "diameter_mm"),
    [
        ("INCH", "C0.8mm", 0.8),
        ("INCH", "C0.8 MM", 0.8),
        ("METRIC", "C.03in", 0.762),
        ("METRIC", 'C.03"', 0.762),
        ("METRIC", "C30mil", 0.762),
        ("METRIC", "F200S65C0.03inchH100", 0.762),
    ],
)
def test_a_unit_behind_a_diameter_counts(units: str, written: str, diameter_mm: float) -> None:
    found = read_text(board(f"T1{written}\n", units=units))
    assert found.tools[0].diameter_mm == pytest.approx(diameter_mm) and "diameter-unlikely" not in codes(found)


@pytest.mark.parametrize(
    ("units", "written", "told"),
    [
        ("METRIC", "C0.031", True),
        ("METRIC", "C80.0", True),
        ("INCH", "C0.8", True),
        ("METRIC", "C6.5", False),
        ("METRIC", "C0.15", False),
        ("INCH", "C.0315", False),
    ],
)
def test_a_diameter_that_can_hardly_be(units: str, written: str, told: bool) -> None:
    assert ("diameter-unlikely" in codes(read_text(board(f"T1{written}\n", units=units)))) == told


@pytest.mark.parametrize("written", ["C00125", "C008", "C0008"])
def test_a_diameter_without_a_point_is_not_guessed(written: str) -> None:
    assert refusal(board(f"T1{written}\n")) == "diameter-without-point"


def test_header_and_body_with_two_diameters() -> None:
    assert refusal(board("T1C0.8\n", "T1C3.2")) == "tool-redefined"
    assert not read_text(board("T1C0.8\n", "T1C.80F200")).warnings
    assert not read_text(board("T1C0.8\n", "T1C0.0315in")).warnings


def test_two_diameters_in_the_body_are_told() -> None:
    found = read_text("M71\n%\nT1C0.8\nX1.0Y1.0\nT1C3.2\nX90.0Y90.0\nM30\n")
    assert [found.tools[tool].diameter_mm for tool in found.hole_tool] == [0.8, 3.2]
    assert codes(found) == ["tool-size-changes"]


# -- reports beside the file ----------------------------------------------------------------------


def test_a_report_with_another_diameter_is_told() -> None:
    found = read_text(board("T01C0.8\n", "T01"), side_files={"b.drr": b"T1  39mil (1mm)  2  3.4 Inch (86 mm)\n"})
    assert codes(found) == ["size-mismatch"] and found.tools[0].diameter_mm == 0.8


def test_a_report_in_other_units_gives_no_digits() -> None:
    """Of another export: what it says of digits must not place the point of this one."""
    header = "M48\nMETRIC,TZ\nT01C0.8\n%\nT01\nX10000Y10000\nX90000Y50000\nM30\n"
    found = read_text(header, side_files={"nc_param.txt": b"FORMAT 2.5\nOUTPUT-UNITS ENGLISH\n"})
    alone = read_text(header)
    assert found.hole_xy_mm.tolist() == alone.hole_xy_mm.tolist()
    assert codes(found)[0] == "contradictory-format"


def test_units_that_only_a_report_tells_are_told() -> None:
    text = "%\nT01C0.2\nX010000Y010000\nX090000Y050000\nM30\n"
    found = read_text(text, side_files={"nc_param.txt": b"FORMAT 2.4\nOUTPUT-UNITS ENGLISH\n"})
    assert "units-from-report" in codes(found)


def test_a_report_longer_than_what_is_read(tmp_path) -> None:
    (tmp_path / "b.drl").write_text(board("T01C0.8\n", "T01"))
    (tmp_path / "b.tol").write_bytes(b" " * (BYTE_LIMIT + 5))
    assert codes(read(tmp_path / "b.drl")) == ["side-file-cut"]


def test_allegro_without_t_words() -> None:
    """The comments list the tools in the order of use, M00 is the change between them; more changes are refused."""
    comments = "; Holesize 1. = 32.0 Tolerance = +3.0/-3.0 PLATED MILS Quantity = 1\n"
    comments += "; Holesize 2. = 126.0 Tolerance = +0.0/-0.0 NON_PLATED MILS Quantity = 1\n"
    text = f"{comments}%\nM72\nX1.0Y1.0\nM00\nX2.0Y2.0\n"
    found = read_text(text + "M30\n")
    assert [found.tools[tool].diameter_mm for tool in found.hole_tool] == pytest.approx([0.8128, 3.2004])
    assert refusal(text + "M00\nX3.0Y3.0\nM30\n") == "no-tool-selected"


# -- files cut short, limits ----------------------------------------------------------------------


@pytest.mark.parametrize("last", ["X5.0Y1", "X5", "X5.0Y1.0 ", "T2", "R3X1", "G85X5.0", "X5.0Y1\x1a", "X5.0Y1\x00\x00"])
def test_a_file_cut_in_its_last_line_is_refused(last: str) -> None:
    assert refusal(HEADER + BODY + last) == "cut-short"


@pytest.mark.parametrize(
    ("last", "told"),
    [("", ["no-end-of-program"]), ("; a note", ["no-end-of-program"]), ("M30", []), ("M30X0Y0", []), ("M30\x1a", [])],
)
def test_a_file_that_ends_on_a_whole_line(last: str, told: list[str]) -> None:
    assert codes(read_text(HEADER + BODY + last)) == told


@pytest.mark.parametrize("filler", [" ", "\t", " \t"])
@pytest.mark.parametrize("length", [LINE_LIMIT - 3, LINE_LIMIT + 1, 2 * LINE_LIMIT, CHUNK_BYTES + LINE_LIMIT])
def test_blanks_never_hide_the_rest_of_a_line(filler: str, length: int) -> None:
    assert refusal(f"{HEADER}X2.0{filler * length}Y7.0\nM30\n") == "line-too-long"


def test_a_line_of_blanks_within_the_limit_is_read_whole() -> None:
    found = read_text(f"{HEADER}X2.0{' ' * 4000}Y7.0\nX9.0Y9.0\nM30\n")
    assert found.hole_xy_mm.tolist() == [[2.0, 7.0], [9.0, 9.0]]


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_utf_16_has_the_same_limit_in_letters(encoding: str) -> None:
    long = "\ufeff" + HEADER + f";{'n' * 3000}\nX2.0{' ' * 3000}Y7.0\nX9.0Y9.0\nM30\n"
    assert decode(long.encode(encoding), name="t").hole_xy_mm.tolist() == [[2.0, 7.0], [9.0, 9.0]]
    with pytest.raises(DrillFileError, match="line-too-long"):
        decode(long.replace(" " * 3000, " " * 5000).encode(encoding), name="t")


def test_a_tape_row_that_is_none_is_refused() -> None:
    from drillctl.generation.drillfile.eia import encode

    tape = bytearray(encode(HEADER + BODY * 60_000 + "M30\n"))
    tape[-200] = 0xFF
    with pytest.raises(DrillFileError, match=r"not-text: .*0xff"):
        decode(bytes(tape), name="t")


def test_line_numbers_with_two_carriage_returns() -> None:
    text = (HEADER + "X1.0Y1.0\nT9\nM30\n").replace("\n", "\r\r\n")
    with pytest.raises(DrillFileError) as caught:
        read_text(text)
    assert caught.value.line == 8


# -- behind the end -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "tail", ["X5.0Y5.0\nX6.0Y6.0\n", "T2\nX5.0Y5.0\n", "M48\nX5.0Y5.0\n", "X5.0Y5.0\nM30\n", "R9X1.0\n"]
)
def test_a_program_behind_the_end(tail: str) -> None:
    text = HEADER + BODY + "M30\n" + tail
    assert refusal(text) == "holes-after-end"
    left_out = read_text(text, after_end="ignore")
    assert len(left_out.hole_xy_mm) == 2 and codes(left_out) == ["data-after-end"]


def test_each_program_by_its_own_header() -> None:
    second = "M48\nINCH\nT1C0.125\n%\nT1\nX1.0Y1.0\nX2.0Y1.0\nM30\n"
    found = read_text(HEADER + BODY + "M30\n%\n" + second, after_end="drill")
    assert found.hole_xy_mm.round(4).tolist() == [[10, 10], [30, 20], [25.4, 25.4], [50.8, 25.4]]
    assert [found.tools[tool].diameter_mm for tool in found.hole_tool] == pytest.approx([0.8, 0.8, 3.175, 3.175])
    assert set(codes(found)) == {"second-header", "units-change-in-body"}


def test_the_next_program_starts_anew() -> None:
    """Modes, places and the tool of the first do not reach into the second."""
    first = HEADER + "G91\nX10.0Y10.0\nG00X5.0\nM30\n"
    with pytest.raises(DrillFileError, match="no-tool-selected"):
        read_text(first + "X7.0Y7.0\nX8.0\nM30\n", after_end="drill")
    found = read_text(first + "T2\nX7.0\nY8.0\nM30\n", after_end="drill")
    assert found.hole_xy_mm.tolist() == [[10, 10], [7, 0], [7, 8]]


@pytest.mark.parametrize("tail", ["%\n", "M30\n", "\n\n%\n", "; a note\n", "thank you\n", "X5.0Y5.0\n"])
def test_what_editors_leave_behind_the_end(tail: str) -> None:
    found = read_text(HEADER + BODY + "M30\n" + tail)
    assert len(found.hole_xy_mm) == 2 and set(codes(found)) <= {"data-after-end"}
