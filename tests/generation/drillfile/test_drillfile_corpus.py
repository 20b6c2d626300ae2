"""Every real file exactly as several independent readers agree, every broken one refused by name."""

import time

import pytest

from drillctl.generation.drillfile import DrillFileError, read, summary

BBOX_MM = 0.01
DIAMETER_MM = 0.002


def test_a_real_file_is_read_exactly(real: dict) -> None:
    truth = real["truth"]
    found = summary(read(real["path"]))
    assert (found["holes"], found["slots"], found["routs"]) == (truth["holes"], truth["slots"], truth["routs"])
    assert found["bbox_mm"] == (truth["bbox_mm"] and pytest.approx(truth["bbox_mm"], abs=BBOX_MM))
    assert found["units"] == truth["units"]


def test_every_tool_drills_what_it_should(real: dict) -> None:
    truth = {tool["number"]: tool for tool in real["truth"]["tools"]}
    tools = summary(read(real["path"]))["tools"]
    assert set(truth) <= {tool["number"] for tool in tools}
    for tool in tools:
        expected = truth.get(tool["number"], {"count": 0, "slots": 0})
        assert (tool["count"], tool["slots"]) == (expected["count"], expected["slots"])
        if expected.get("diameter_mm") is not None:
            assert tool["diameter_mm"] == pytest.approx(expected["diameter_mm"], abs=DIAMETER_MM)


def test_the_format_is_named(real: dict) -> None:
    """As the truth names it, or by a name that means the same for this file's numbers."""
    truth = real["truth"]
    found = summary(read(real["path"]))
    if truth["format"] is None:
        assert (found["format"], found["zeros"]) == ("decimal", None)
        return
    if "none" not in (found["zeros"], truth["zeros_suppressed"]):  # equally long numbers go by any name
        assert found["zeros"] == truth["zeros_suppressed"]
    place = 0 if found["zeros"] == "trailing" else 1  # the digit count that places the point
    assert found["format"].split(":")[place] == truth["format"].split(":")[place]


def test_a_broken_file_gets_its_verdict(malformed: dict) -> None:
    started = time.process_time()
    try:
        drill_file = read(malformed["path"])
    except DrillFileError as error:
        verdict, remarks = "reject", error.problems[:1]
        assert len(str(error)) < 300 and "\n" not in str(error)
    else:
        verdict, remarks = "accept_warn" if drill_file.warnings else "accept", drill_file.warnings
        assert len(drill_file.hole_xy_mm) == malformed["holes"]
    assert time.process_time() - started < 1.0
    assert verdict == malformed["verdict"]
    if malformed["reason"]:
        lines = {remark.line for remark in remarks if remark.code == malformed["reason"]}
        assert lines, [remark.code for remark in remarks]
        assert not isinstance(malformed.get("line"), int) or malformed["line"] in lines
