"""Small drill files with one trait of the field each: right, or told, or refused; never silently wrong.

field/index.json says for each file what must come of it: `verdict` (alternatives joined by |), and where it is accepted
the holes, slots, tools and extent.
"""

import json
from collections import Counter
from pathlib import Path

import pytest

from drillctl.generation.drillfile import DrillFile, DrillFileError, read, summary

FIELD = Path(__file__).parent / "field"
CASES = json.loads((FIELD / "index.json").read_text(encoding="utf-8"))
LENGTH_MM = 0.01
DIAMETER_MM = 0.002


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["file"])
def test_a_field_file_gets_its_verdict(case: dict) -> None:
    expected = case["expected"]
    try:
        found = read(FIELD / case["file"])
    except DrillFileError:
        assert "reject" in expected["verdict"].split("|")
        return
    verdict = "accept_warn" if found.warnings else "accept"
    assert verdict in expected["verdict"].split("|"), [remark.reason for remark in found.warnings]
    if "alt_hole_list" in expected and not_as_first_read(found, expected):
        assert holes(found) == approx_rows(expected["alt_hole_list"])
        return
    told = summary(found)
    assert (told["holes"], told["slots"]) == (expected["holes"], expected["slots"])
    assert told["routs"] == expected.get("routs", told["routs"])
    if "hole_list" not in expected:
        return
    assert told["bbox_mm"] == pytest.approx(expected["bbox_mm"], abs=LENGTH_MM)
    assert tools(told, "count") == approx_rows([tool["diameter_mm"], tool["count"]] for tool in expected["tools"])
    assert tools(told, "slots") == approx_rows([tool["diameter_mm"], tool["count"]] for tool in expected["slot_tools"])
    assert holes(found) == approx_rows(expected["hole_list"])
    assert slots(found) == approx_rows(expected["slot_list"])


def not_as_first_read(found: DrillFile, expected: dict) -> bool:
    return holes(found) != approx_rows(expected["hole_list"])


def holes(found: DrillFile) -> list[list[float]]:
    """Diameter, x and y of every hole, sorted."""
    numbers = found.hole_tool.tolist()
    return sorted([size(found, tool), *xy] for tool, xy in zip(numbers, found.hole_xy_mm.tolist(), strict=True))


def slots(found: DrillFile) -> list[list[float]]:
    """Diameter and both ends of every slot, sorted."""
    numbers = found.slot_tool.tolist()
    return sorted([size(found, tool), *ends] for tool, ends in zip(numbers, found.slot_mm.tolist(), strict=True))


def size(found: DrillFile, tool: int) -> float:
    return round(found.tools[tool].diameter_mm or 0.0, 4)


def tools(told: dict, field: str) -> list[list[float]]:
    """Diameter and count of every tool that drills, sorted; tools of one diameter count together."""
    count: Counter[float] = Counter()
    for tool in told["tools"]:
        count[round(tool["diameter_mm"] or 0.0, 4)] += tool[field]
    return sorted([diameter, number] for diameter, number in count.items() if number)


def approx_rows(rows) -> list:
    return [pytest.approx(row, abs=DIAMETER_MM) for row in sorted(rows)]


def test_every_file_is_in_the_index() -> None:
    assert {case["file"] for case in CASES} == {path.name for path in FIELD.glob("*.drl")}


def test_odd_bytes_survive() -> None:
    """Line ends, the DOS end mark and EBCDIC must reach the reader as they were written."""
    assert b"\r\r\n" in (FIELD / "64-crcrlf.drl").read_bytes()
    assert b"\x1a" in (FIELD / "65-ctrlz-garbage.drl").read_bytes()
    assert (FIELD / "67-ebcdic.drl").read_bytes().startswith("M48".encode("cp037"))
