"""Each word owns its arguments: what coordinates behind it mean, what may stand where, and what is refused."""

import re
from pathlib import Path

import pytest

from drillctl.generation.drillfile import DrillFile, DrillFileError, decode
from drillctl.generation.drillfile.codes import CODES, FORMAT_ONE, UNSUPPORTED

HEADER = "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nT1\n"  # the body begins in line 7
DOCS = Path(__file__).resolve().parents[3] / "docs" / "DRILL-FILES.md"


def read_text(text: str) -> DrillFile:
    return decode(text.encode(), name="test.drl")


def holes(found: DrillFile) -> list[tuple[int, float, float]]:
    """Tool number, x and y, in file order."""
    places = found.hole_xy_mm.round(6).tolist()
    return [(found.tools[tool].number, x, y) for tool, (x, y) in zip(found.hole_tool.tolist(), places, strict=True)]


def refusal(text: str) -> tuple[str, int | None]:
    with pytest.raises(DrillFileError) as caught:
        read_text(text)
    return caught.value.code, caught.value.line


@pytest.mark.parametrize("stop", ["M00", "M06", "M09", "M30"])
def test_where_the_table_stops_is_no_hole(stop: str) -> None:
    found = read_text(f"{HEADER}X1.0Y2.0\nX5.0Y2.0\n{stop}X90.0Y80.0\n" + "M30\n" * (stop != "M30"))
    assert holes(found) == [(1, 1.0, 2.0), (1, 5.0, 2.0)] and not found.warnings


@pytest.mark.parametrize("word", ["M01", "M08", "M14", "M15", "M18", "M25", "M48", "M60", "M62", "M71", "M72", "M95"])
def test_a_word_without_axes_refuses_them(word: str) -> None:
    assert refusal(f"{HEADER}X1.0Y2.0\n{word}X9.0Y9.0\nM30\n") == ("misplaced-word", 8)


@pytest.mark.parametrize("word", ["M16", "M17", "G40", "G41", "G42"])
def test_a_routers_word_takes_axes_in_rout_mode_only(word: str) -> None:
    found = read_text(f"{HEADER}G00X1.0Y1.0\nM15\nG01X2.0\n{word}X50.0Y50.0\nG05\nX3.0Y3.0\nM30\n")
    assert holes(found) == [(1, 3.0, 3.0)]
    assert "rout-move" in [remark.code for remark in found.warnings]
    assert refusal(f"{HEADER}X1.0Y2.0\n{word}X9.0Y9.0\nM30\n") == ("misplaced-word", 8)


@pytest.mark.parametrize("word", sorted(CODES))
def test_no_word_makes_a_hole_that_its_meaning_does_not_name(word: str) -> None:
    """Every word of the table with a place behind it, in drill mode: a hole, none, or a refusal; by its meaning."""
    try:
        found = read_text(f"{HEADER}X0.0Y0.0\n{word}X40.0Y40.0\nG05\nX2.0Y2.0\nM30\n")
    except DrillFileError:
        assert "a hole" not in CODES[word].meaning
        return
    drilled = (1, 40.0, 40.0) in holes(found)
    assert drilled == ("a hole" in CODES[word].meaning)


@pytest.mark.parametrize("word", sorted(UNSUPPORTED))
@pytest.mark.parametrize("place", ["{}X5.0Y5.0", "X5.0Y5.0{}X1.0", "{}"])
def test_what_is_not_drilled_is_refused_by_name(word: str, place: str) -> None:
    with pytest.raises(DrillFileError, match=f"unsupported-command: .*{word}"):
        read_text(f"{HEADER}X1.0Y2.0\n{place.format(word)}\nM30\n")


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("X9.0Y9.0M30", "misplaced-word"),
        ("X9.0Y9.0M06", "misplaced-word"),
        ("X9.0Y9.0T2", "misplaced-word"),
        ("X9.0Y9.0R2X1.0", "misplaced-word"),
        ("X9.0Y9.0G85X12.0M30", "misplaced-word"),
        ("R2X1.0T2", "misplaced-word"),
        ("T1T2", "misplaced-word"),
        ("X9.0Y9.0A5.0", "bad-number"),
        ("G04X1.5Y2.0", "bad-number"),
        ("X1 0Y1.0", "torn-number"),
        ("T1 2", "torn-number"),
        ("M", "unknown-command"),
        ("G", "unknown-command"),
        ("N", "unknown-command"),
        ("T3C0.8C1.2", "bad-diameter"),
        ("T2\nR2X1.0", "repeat-without-hole"),
        ("M06X9.0Y9.0\nR2X1.0", "repeat-without-hole"),
        ("G00X2.0\nR2X1.0", "repeat-without-hole"),
        ("G93X5.0Y5.0", "zero-moved"),
        ("G91\nM25\nX1.0\nM01\nM02X5.0", "unsupported-command"),
        ("M25\nX1.0\nM01\nM02X5.0\nM02\nM02X5.0", "bad-pattern"),
        ("P3X10.0", "unsupported-command"),
        ("G00X1.0\nM15\nG01X2.0\nM16\nT2\nX5.0Y5.0", "rout-or-hole"),
    ],
)
def test_what_can_not_stand_there(line: str, code: str) -> None:
    assert refusal(f"{HEADER}X1.0Y1.0\n{line}\nM30\n") == (code, 8 + line.count("\n"))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        pytest.param("G05X1.0Y2.0", [(1, 1, 2)], id="G05 and a hole"),
        pytest.param("T2X1.0Y2.0", [(2, 1, 2)], id="T and a hole"),
        pytest.param("G54T2\nX1.0Y2.0", [(2, 1, 2)], id="G54 before T"),
        pytest.param("N10X1.0Y2.0F200", [(1, 1, 2)], id="block number and feed"),
        pytest.param("X1.0Y2.0\nG04X9.0", [(1, 1, 2)], id="dwell"),
        pytest.param("1/2/3\nX1.0Y2.0", [(1, 1, 2)], id="tool links"),
        pytest.param("Z+0.05\nX1.0Y2.0", [(1, 1, 2)], id="depth offset"),
        pytest.param("M47,AT X9Y9\nX1.0Y2.0", [(1, 1, 2)], id="message"),
        pytest.param("M45,A ;B\\\nX8.0Y8.0\\\nX9.0Y9.0\nX1.0Y2.0", [(1, 1, 2)], id="long message"),
        pytest.param("X1.0Y2.0\nM08M30", [(1, 1, 2)], id="M08 and M30"),
        pytest.param(
            "M25\nX1.0Y2.0\nM01\nM02X10.0\nM02\nM01\nM02Y20.0\nM02\nM08",
            [(1, 1, 2), (1, 11, 2), (1, 1, 22), (1, 11, 22)], id="nested patterns",
        ),
        pytest.param("X0Y0.0\n%\nX1.0Y2.0\nM01\nM02X9.0\nM08", [(1, 0, 0), (1, 1, 2), (1, 10, 2)], id="% as M25"),
        pytest.param("X1.0Y2.0\n%\nX3.0", [(1, 1, 2), (1, 3, 2)], id="% alone"),
    ],
)  # fmt: skip
def test_what_is_drilled(body: str, expected: list[tuple[int, float, float]]) -> None:
    found = read_text(f"{HEADER}{body}\nM30\n")
    assert holes(found) == expected


@pytest.mark.parametrize(
    ("body", "code"),
    [
        ("X1.0Y1.0\nM00\nX2.0Y2.0", "holes-after-stop"),
        ("X1.0Y1.0\nM02\nX2.0Y2.0", "holes-after-stop"),
        ("X1.0Y1.0\nM06X9.0Y9.0\nX2.0", "place-from-before"),
        ("M25\nX1.0Y1.0\nM01\nM02X9.0\nM08\nX2.0", "place-from-before"),
        ("X1.0Y1.0\nM60", "scaling-ignored"),
        ("/X1.0Y1.0", "block-not-deleted"),
        ("X1.0Y1.0G85X1.0Y1.0", "slot-without-length"),
    ],
)
def test_what_is_told(body: str, code: str) -> None:
    assert [remark.code for remark in read_text(f"{HEADER}{body}\nM30\n").warnings] == [code]


@pytest.mark.parametrize(
    ("setting", "code"),
    [
        ("INCHES", "unknown-command"),
        ("METRICS,TZ", "unknown-command"),
        ("METRIC,ABC", "bad-setting"),
        ("ICI", "bad-setting"),
        ("ICI,YES", "bad-setting"),
        ("BLKD,", "bad-setting"),
        ("FMAT,3", "bad-setting"),
    ],
)
def test_a_setting_that_is_not_understood(setting: str, code: str) -> None:
    with pytest.raises(DrillFileError, match=f"'{setting.partition(',')[0]}") as caught:
        read_text(HEADER.replace("METRIC", f"METRIC\n{setting}") + "X1.0Y1.0\nM30\n")
    assert (caught.value.code, caught.value.line) == (code, 3)


@pytest.mark.parametrize(
    ("setting", "code"),
    [("VER,2", "axis-version"), ("ICI,ON", "contradictory-mode"), ("BLKD,ON", "block-deleted")],
)
def test_a_setting_that_is_told(setting: str, code: str) -> None:
    text = (
        HEADER.replace("METRIC", f"METRIC\n{setting}") + "G90\nX1.0Y1.0\n" + "/X9.0Y9.0\n" * (code == "block-deleted")
    )
    found = read_text(text + "M30\n")
    assert [remark.code for remark in found.warnings] == [code] and holes(found) == [(1, 1.0, 1.0)]


def test_a_slot_without_length_is_a_hole() -> None:
    found = read_text(f"{HEADER}X1.0Y1.0G85X1.0Y1.0\nX5.0Y5.0G85X6.0\nM30\n")
    assert holes(found) == [(1, 1.0, 1.0)] and found.slot_mm.tolist() == [[5.0, 5.0, 6.0, 5.0]]


def test_format_one_has_other_names() -> None:
    body = "G81\nM25\nX1.0Y2.0\nM24\nM26X10.0\nM26\nM27\nM00\nM02\n"
    found = read_text(HEADER.replace("METRIC", "METRIC\nFMAT,1") + body)
    assert holes(found) == [(1, 1.0, 2.0), (1, 11.0, 2.0)] and not found.warnings
    assert set(FORMAT_ONE.values()) <= set(CODES) | set(UNSUPPORTED)


def test_one_warning_a_kind_with_count_and_first_line() -> None:
    found = read_text(HEADER + "X1.0Y1.0\n" * 4 + "X9.0Y9.0\nX9.2Y9.0\nM30\n")
    warnings = [(remark.code, remark.line, remark.alike) for remark in found.warnings]
    assert warnings == [("overlapping-holes", 12, 1), ("duplicate-hole", 8, 3)]
    assert found.warnings[1].reason.endswith("; 3 in all")


def test_the_documents_table_is_the_codes() -> None:
    text = DOCS.read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `([GM]\d\d)` \| (.+?) \|$", text, re.M))
    assert rows == {name: code.meaning for name, code in CODES.items()}
    assert all(name in " ".join(text.split()) for name in UNSUPPORTED.values())
