"""Values changed in a table's text: the value is there afterwards, and nothing else has moved."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.machine import Library, TableError, shipped_tables
from drillctl.machine.edit import set_pattern, set_reverse, set_state_row, set_value, with_states, without_states
from drillctl.machine.ramp_file import parse_ramp, proposals, ramp_rows
from drillctl.machine.source import Source

PHASE = (shipped_tables() / "phase" / "two-phase-forced.toml").read_text("utf-8")
RAMP = (shipped_tables() / "ramp" / "seven-state.toml").read_text("utf-8")
MACHINE = (shipped_tables() / "machines" / "pcb-drill.toml").read_text("utf-8")
WIRES = [row["name"] for row in tomllib.loads(PHASE)["wire"]]
PATTERNS = st.text("x.", min_size=2, max_size=96)


def changed_lines(before: str, after: str) -> list[tuple[str, str]]:
    pairs = zip(before.split("\n"), after.split("\n"), strict=True)
    return [(old, new) for old, new in pairs if old != new]


@given(st.sampled_from(WIRES), PATTERNS)
def test_a_pattern_comes_back_as_it_was_set_and_undoes(wire: str, pattern: str) -> None:
    old = next(row["pattern"] for row in tomllib.loads(PHASE)["wire"] if row["name"] == wire)
    edited = set_pattern(PHASE, wire, pattern)
    rows = {row["name"]: row["pattern"] for row in tomllib.loads(edited)["wire"]}
    assert rows[wire] == pattern
    assert len(changed_lines(PHASE, edited)) == (pattern != old)
    assert set_pattern(edited, wire, old) == PHASE


@given(st.lists(PATTERNS, min_size=len(WIRES), max_size=len(WIRES)))
def test_reverse_rows_come_and_go_without_a_trace(patterns: list[str]) -> None:
    wanted = dict(zip(WIRES, patterns, strict=True))
    edited = set_reverse(PHASE, wanted)
    assert {row["name"]: row["pattern"] for row in tomllib.loads(edited)["reverse"]} == wanted
    assert set_reverse(edited, {}) == PHASE


def test_reverse_rows_that_stand_keep_their_comments() -> None:
    first = set_reverse(PHASE, dict.fromkeys(WIRES, "x.")).replace('"x."', '"x." # looked at', 1)
    second = set_reverse(first, dict.fromkeys(WIRES, ".x"))
    assert '".x" # looked at' in second and '"x."' not in second


@pytest.mark.parametrize("state", range(-3, 4))
def test_a_state_is_found_by_its_number(state: int) -> None:
    edited = set_state_row(RAMP, state, "interval", 99)
    found = {row["state"]: row["interval"] for row in tomllib.loads(edited)["state"]}
    assert found[state] == 99 and list(found.values()).count(99) == 1
    assert len(changed_lines(RAMP, edited)) == 1


@pytest.mark.parametrize(
    ("place", "value", "line"),
    [
        pytest.param(("configuration", "card_address"), 0x300, "card_address = 0x300", id="hexadecimal stays so"),
        pytest.param(("axis", 0, "range", 1), 2588, "range = [-10, 2588]", id="one end of a range"),
        pytest.param(("tick_hz",), 1000, "tick_hz = 1000", id="at the top"),
        pytest.param(("configuration", "tool_change"), "MANUAL",
                     'tool_change = "MANUAL" # inactive in the paper: nobody had built a tool changer', id="comment"),
        pytest.param(("configuration", "longest_drilling_s"), 2.5, "longest_drilling_s = 2.5", id="a fraction"),
    ],
)  # fmt: skip
def test_one_line_changes(place: tuple[str | int, ...], value: int | str | float, line: str) -> None:
    changes = changed_lines(MACHINE, set_value(MACHINE, place, value))
    assert [new for _, new in changes] == [line]


@pytest.mark.parametrize("place", [("description",), ("configuration", "mode")])
def test_a_key_that_is_not_written_yet_is_added_where_it_belongs(place: tuple[str, ...]) -> None:
    lines = MACHINE.split("\n")
    bare = "\n".join(line for line in lines if not line.startswith((place[-1], "[configuration]", "card", "longest",
                                                                   "mode", "tool_change")))  # fmt: skip
    edited = set_value(bare, place, "REAL")
    machine = Library((shipped_tables(),)).check_source(Source(Path("machines/m.toml"), edited))
    inner: Any = tomllib.loads(edited)
    for part in place:
        inner = inner[part]
    assert inner == "REAL" and machine == []


@pytest.mark.parametrize(
    ("place", "reason"),
    [
        (("axis", 7, "range", 0), "no axis.7.range"),
        (("axis", 0, "range", 2), "no axis.0.range.2"),
        (("tick_hz", "x"), "no tick_hz"),
    ],
)
def test_a_place_that_is_not_there_is_refused(place: tuple[str | int, ...], reason: str) -> None:
    with pytest.raises(TableError, match=reason):
        set_value(MACHINE, place, 1)


def test_unknown_wires_states_and_text_that_is_no_toml_are_refused() -> None:
    with pytest.raises(TableError, match=r"no \[\[wire\]\] has name 9z"):
        set_pattern(PHASE, "9z", "x.")
    with pytest.raises(TableError, match=r"no \[\[state\]\] has state 9"):
        set_state_row(RAMP, 9, "interval", 1)
    with pytest.raises(TableError, match="not TOML"):
        set_value("a = = 1", ("a",), 1)


def test_windows_line_ends_stay() -> None:
    assert set_value("a = 1\r\nb = 2 # c\r\n", ("b",), 3) == "a = 1\r\nb = 3 # c\r\n"


@pytest.mark.parametrize("name", ["seven-state", "drive-servo"])
def test_states_come_and_go_without_a_trace_and_what_is_proposed_lands(name: str) -> None:
    text = (shipped_tables() / "ramp" / f"{name}.toml").read_text("utf-8")
    top = ramp_rows(Source(Path("ramp"), text))[-1]
    grown = [with_states(text, *row) for row in proposals(top)]
    assert any(lands(changed, top[0] + 1) for changed in grown)
    for changed in grown:
        assert [row[0] for row in ramp_rows(Source(Path("ramp"), changed))] == list(range(-top[0] - 1, top[0] + 2))
        assert "\n\n[[state]]" in changed and "\n[[state]]" not in changed.replace("\n\n[[state]]", "")
        assert without_states(changed, top[0] + 1) == text


def lands(text: str, top: int) -> bool:
    try:
        return parse_ramp(Source(Path("ramp"), text)).top == top
    except TableError:
        return False


def test_comments_of_the_states_that_stay_are_kept() -> None:
    noted = RAMP.replace("state = 3\n", "state = 3 # the fastest\n").replace("state = 2\n", "state = 2 # nearly\n")
    shorter = without_states(noted, 3)
    assert "# nearly" in shorter and "# the fastest" not in shorter and shorter.startswith("# The acceleration")
    assert parse_ramp(Source(Path("ramp"), shorter)).top == 2
