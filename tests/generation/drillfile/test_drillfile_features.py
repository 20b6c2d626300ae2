"""Each thing a drill file may say, on a file of a few lines."""

import numpy as np
import pytest

from drillctl.generation.drillfile import DrillFile, decode, read, summary

HEADER = "M48\nMETRIC,TZ,000.000\nT1C0.8\nT2C1.0\n%\nT1\n"


def holes(text: str | bytes, **options: object) -> list[tuple[float, float]]:
    return [tuple(xy) for xy in file_of(text, **options).hole_xy_mm.round(6).tolist()]


def file_of(text: str | bytes, **options: object) -> DrillFile:
    data = text.encode("latin-1") if isinstance(text, str) else text
    return decode(data, name="test.drl", **options)


def codes(text: str | bytes, **options: object) -> list[str]:
    return [remark.code for remark in file_of(text, **options).warnings]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        pytest.param("X1.5Y2.5\n", [(1.5, 2.5)], id="decimal"),
        pytest.param("X1500Y2500\n", [(1.5, 2.5)], id="leading zeros dropped"),
        pytest.param("X+1500Y-2500\n", [(1.5, -2.5)], id="signs"),
        pytest.param("X 1500 Y 2500 \n", [(1.5, 2.5)], id="inner spaces"),
        pytest.param("X1,5Y2,5\n", [(1.5, 2.5)], id="decimal comma"),
        pytest.param("x1.5y2.5\n", [(1.5, 2.5)], id="small letters"),
        pytest.param("Y2.5X1.5\n", [(1.5, 2.5)], id="Y before X"),
        pytest.param("X1.0Y2.0\nX3.0\nY5.0\n", [(1, 2), (3, 2), (3, 5)], id="modal axes"),
        pytest.param("G91\nX1.0Y1.0\nX1.0\nY1.0\n", [(1, 1), (2, 1), (2, 2)], id="G91"),
        pytest.param("G91\nX1.0Y1.0\nG90\nX1.0\n", [(1, 1), (1, 1)], id="G91 then G90"),
        pytest.param("X1.0Y1.0\nR3X2.0\n", [(1, 1), (3, 1), (5, 1), (7, 1)], id="R"),
        pytest.param("X1.0Y1.0\nR02X2.0Y1.0\nX0.0\n", [(1, 1), (3, 2), (5, 3), (0, 3)], id="R moves on"),
        pytest.param(
            "M25\nX1.0Y1.0\nX2.0\nM01\nM02X10.0\nM02Y5.0\nM08\n",
            [(1, 1), (2, 1), (11, 1), (12, 1), (11, 6), (12, 6)],
            id="pattern, each copy from the last",
        ),
        pytest.param("M25\nX1.0Y1.0\nM01\nR2M02X3.0\nM08\n", [(1, 1), (4, 1), (7, 1)], id="R with a pattern"),
        pytest.param("G93X0Y0\nX1.0Y1.0\n", [(1, 1)], id="G93 is no hole"),
        pytest.param("G05\nX1.0Y1.0;note\n", [(1, 1)], id="comment behind a hole"),
        pytest.param("(note)\nX1.0Y1.0\nM47,CHANGE IT\n", [(1, 1)], id="other comments"),
        pytest.param("G00X5.0Y5.0\nM15\nG01X6.0\nM16\nG05\nX1.0Y1.0\n", [(1, 1)], id="routs are no holes"),
        pytest.param("G00X9.0Y9.0\nG05\nX1.0\n", [(1, 9)], id="the router's way counts for modal axes"),
    ],
)
def test_bodies(body: str, expected: list[tuple[float, float]]) -> None:
    assert holes(HEADER + body + "M30\n") == expected


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\n\r"])
def test_line_ends(end: str) -> None:
    drill_file = file_of((HEADER + "X1.0Y2.0\nX3.0Y4.0\nM30\n").replace("\n", end))
    assert drill_file.hole_line.tolist() == [7, 8]


@pytest.mark.parametrize(
    ("before", "after"),
    [(b"\xef\xbb\xbf", b""), (b"\x00" * 50, b""), (b"\x7f" * 50, b"\x00" * 50), (b"", b"\x1a\x00junk"), (b"\n\n", b"")],
    ids=["UTF-8 mark", "NUL leader", "rubout leader", "DOS end of file", "blank lines"],
)
def test_wrapping(before: bytes, after: bytes) -> None:
    assert holes(before + (HEADER + "X1.0Y2.0\nM30\n").encode() + after) == [(1, 2)]


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf16(encoding: str) -> None:
    text = (HEADER + "X1.0Y2.0\nM30\n").encode(encoding)
    assert holes(text) == [(1, 2)] and codes(text) == ["utf-16"]


@pytest.mark.parametrize(
    ("header", "body", "expected"),
    [
        ("M48\nINCH,LZ,00.0000\nT1C0.03\n%\n", "T1\nX01Y0125\n", (25.4, 31.75)),
        ("M48\nINCH,TZ\n;FILE_FORMAT=2:3\nT1C0.03\n%\n", "T1\nX1000Y1250\n", (25.4, 31.75)),
        ("M48\n;FILE_FORMAT = 2:2\n;FILE_FORMAT=4:4\nMETRIC,LZ\nT1C0.8\n%\n", "T1\nX00254Y0031750\n", (25.4, 31.75)),
        ("M48\n; FORMAT={3:3/ absolute / metric / keep zeros}\nT1C0.8\n%\n", "T1\nX025400Y031750\n", (25.4, 31.75)),
        ("M48\n; Format  : 2.4 / Absolute / Inch / Trailing\nT1C0.03\n%\n", "T1\nX01Y0125\n", (25.4, 31.75)),
        ("M48\nMETRIC,TZ,4.2\nT1C0.8\n%\n", "T1\nX2540Y3175\n", (25.4, 31.75)),
        ("M72\nM48\nT1C0.03\n%\n", "T1\nX1.0Y1.25\n", (25.4, 31.75)),
        ("M48\nT1C0.8\nM95\n", "M71\nT1\nX25.4Y31.75\n", (25.4, 31.75)),
        ("M48\nM71\nT1C0.8\n%\n", "M72\nT1\nX1.0Y1.25\n", (25.4, 31.75)),
    ],
)
def test_declarations(header: str, body: str, expected: tuple[float, float]) -> None:
    assert holes(header + body + "M30\n") == [pytest.approx(expected)]


def test_slots_keep_their_place_among_the_holes() -> None:
    body = "X1.0Y1.0\nX2.0Y2.0G85X3.0\nG85X3.0Y9.0\nX4.0Y4.0\nT2\nX5.0Y5.0G85Y6.0\n"
    drill_file = file_of(HEADER + body + "M30\n")
    assert drill_file.slot_mm.tolist() == [[2, 2, 3, 2], [3, 2, 3, 9], [5, 5, 5, 6]]
    assert drill_file.slot_at.tolist() == [1, 1, 2]
    assert drill_file.slot_line.tolist() == [8, 9, 12]
    assert [tool["slots"] for tool in summary(drill_file)["tools"]] == [2, 1]
    assert drill_file.bbox_mm == (1, 1, 5, 9)


def test_routs_are_counted() -> None:
    drill_file = file_of(HEADER + "G00X5.0Y5.0\nM15\nG01X6.0\nX7.0\nM16\nG00X1.0\nM15\nG02X2.0Y2.0A1.0\nM17\nM30\n")
    assert drill_file.routs == 2 and not len(drill_file.hole_xy_mm) and drill_file.bbox_mm is None


def test_a_run_and_single_lines_are_one_grammar() -> None:
    """A comment behind every hole takes each line off the fast way; the holes stay the same."""
    lines = ["X1500Y2500", "X-20", "Y700", "X1Y2G85X30Y4", "X.5Y0.25"]
    run = file_of(HEADER + "\n".join(lines) + "\nM30\n")
    single = file_of(HEADER + "".join(f"{line};\n" for line in lines) + "M30\n")
    assert np.array_equal(run.hole_xy_mm, single.hole_xy_mm) and np.array_equal(run.slot_mm, single.slot_mm)


@pytest.mark.parametrize(
    ("text", "tools"),
    [
        pytest.param(HEADER + "X1.0Y1.0\n", [(1, 0.8, 1), (2, 1.0, 0)], id="header"),
        pytest.param("M48\nMETRIC\nT0C0.6\n%\nT0\nX1.0Y1.0\n", [(0, 0.6, 1)], id="T0 is a tool"),
        pytest.param(HEADER + "X1.0Y1.0\nT0\n", [(1, 0.8, 1), (2, 1.0, 0)], id="T0 unloads"),
        pytest.param("%\nT1C.8F095S3\nX1.0Y1.0\nT2S3F9C1.\nX5.0Y5.0\n", [(1, 0.8, 1), (2, 1.0, 1)], id="in the body"),
        pytest.param("M48\nMETRIC\nT01F00S00C0.8\n%\nT0101\nX1.0Y1.0\n", [(1, 0.8, 1)], id="tool and offset"),
        pytest.param("M48\nMETRIC\nT120C0.8\n%\nT120\nX1.0Y1.0\n", [(120, 0.8, 1)], id="more than 99"),
        pytest.param("%\nT01\nX1.0Y1.0\nM00\n", [(1, None, 1)], id="never defined"),
        pytest.param("M48\n%\nX1.0Y1.0\nX9.0\nM30\n", [(1, None, 2)], id="never selected"),
        pytest.param(
            HEADER + "X1.0Y1.0\nM48\nT1C0.9\n%\nT1\nX9.0\n", [(1, 0.8, 1), (2, 1.0, 0), (1, 0.9, 1)], id="again"
        ),
    ],
)
def test_tools(text: str, tools: list[tuple[int, float | None, int]]) -> None:
    found = summary(file_of(text, fmt="mm,decimal"))["tools"]
    assert [(tool["number"], tool["diameter_mm"], tool["count"]) for tool in found] == tools


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (HEADER + "X1.0Y1.0\nX1.0Y1.0\nM30\n", "duplicate-hole"),
        (HEADER + "X1.0Y1.0\nX1.2Y1.0\nM30\n", "overlapping-holes"),
        (HEADER + "X1.0Y1.0\n", "no-end-of-program"),
        (HEADER + "X1.0Y1.0\nM30\nX2.0Y2.0\n", "data-after-end"),
        (HEADER + "M30\n", "no-holes"),
        (HEADER + "G93X1.0Y0\nX1.0Y1.0\nM30\n", "zero-set-ignored"),
        (HEADER + "G00X1.0Y1.0\nX5.0\nG05\nX2.0\nM30\n", "rout-move"),
        (HEADER + "X 1.0Y1.0\nM30\n", "inner-spaces"),
        (HEADER + "X1,0Y1,0\nM30\n", "comma-decimal"),
        (HEADER + "X1.0Y1.0\nX90000Y10000\nM30\n", "mixed-decimal-implied"),
        (HEADER.replace("T2C1.0\n%", "T3C0.0") + "X1.0Y1.0\nM30\n", "header-not-closed"),
        (HEADER.replace("T2C1.0", "T2C0.0") + "X1.0Y1.0\nM30\n", "bad-diameter-unused"),
        ("M48\nT1C0.8\n%\nT1\nX1.0Y1.0\nX9.0\nM30\n", "missing-units"),
        ("M48\nMETRIC\n%\nT1\nX1.0Y1.0\nX9.0\nM30\n", "missing-diameter"),
        ("M48\nMETRIC,000.000\n;FILE_FORMAT=2:4\nT1C1.0\n%\nT1\nX001000Y001000\nM30\n", "contradictory-format"),
        (
            "M48\nMETRIC\n;T01 Holesize 1. = 0.8 Tolerance = +0.1/-0.1 PLATED MM Quantity = 3\n%\nT01\nX1.0Y1.0\nM30\n",
            "count-mismatch",
        ),
    ],
)
def test_warnings(text: str, code: str) -> None:
    assert code in codes(text)


@pytest.mark.parametrize(
    ("name", "report"),
    [
        ("BOARD.DRR", "NCDrill File Report For: b.pcb\n\nT1     31mil (0.7874mm)     2     3.4 Inch (86 mm)\n"),
        ("board.drr", "T1      31mil (0.7874mm)    +/-3mil (0.076mm)   Round   2   PTH  2.26inch (57.52mm)\n"),
        ("board.tol", "T1 0.0310 2\n"),
        ("board.dri", "Data Mode : Absolute\nUnits : 1/10000 Inch\nT01 0.031inch 2\n"),
        ("board.rep", "Coord format : NNDDDD\nUnits : IMPERIAL\nTool Diam Holes\n1 0.7874 mm 2\n"),
    ],
)
def test_sizes_from_reports_beside_the_file(tmp_path, name: str, report: str) -> None:
    (tmp_path / "board.txt").write_text("M48\nINCH,TZ,00.0000\nT01F00S00\n%\nT01\nX10000Y10000\nX20000\nM30\n")
    (tmp_path / name).write_text(report)
    drill_file = read(tmp_path / "board.txt")
    assert drill_file.tools[0].diameter_mm == pytest.approx(0.7874) and not drill_file.warnings


def test_allegro_parameters_beside_the_file(tmp_path) -> None:
    (tmp_path / "board.drl").write_text(
        ";T01 Holesize 1. = 8.0 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 2\n%\nG90\nT01\n"
        "X00100000Y00125000\nR01X00100000\nM30\n"
    )
    (tmp_path / "nc_param.txt").write_text("INTEGER-PLACES 3\nDECIMAL-PLACES 5\nOUTPUT-UNITS ENGLISH\n")
    drill_file = read(tmp_path / "board.drl")
    assert drill_file.hole_xy_mm.tolist() == [[25.4, 31.75], [50.8, 31.75]]
    assert drill_file.tools[0].diameter_mm == pytest.approx(0.2032) and drill_file.format.format == "3:5"
    assert not drill_file.warnings


def test_summary_has_the_promised_fields() -> None:
    fields = {"holes", "slots", "routs", "tools", "bbox_mm", "units", "format", "zeros"}
    fields |= {"confidence", "runner_up", "reason", "warnings"}
    assert fields <= set(summary(file_of(HEADER + "X1.0Y1.0\nM30\n")))
