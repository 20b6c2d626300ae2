"""The eight-axis drill's screen: what the paper names is on it, its seven buttons, and the forms of its parameters."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from msgspec.structs import replace

from drillctl.language import Message, words
from drillctl.machine.library import user_tables
from drillctl.machine.parameter_table import GROUPS, PARAMETERS
from drillctl.ui.eight_axis.lines import coordinate_lines, magazine_lines, tool_in_use, tool_lines, work_lines
from drillctl.ui.eight_axis.machine import BUTTONS, MachineScreen
from drillctl.ui.eight_axis.parameters import ParameterForm
from drillctl.ui.widgets.texts import Line
from drillctl.viewmodel.job_options import JobOptions
from drillctl.viewmodel.production import PlaceRecord, Records, ToolRecord
from tests.ui.fake_console import BOARD, VIEW
from tests.ui.whole import Whole, at_home, show

SIZES = ((80, 24), (100, 32), (160, 50))


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Whole]:
    at_home(tmp_path, monkeypatch)
    found = Whole()
    show(found.app, "machine")
    yield found
    words.use("en")
    found.console.close()


def all_pages(program: Whole) -> str:
    """What the screen shows, with every page of its windows."""
    pages = []
    for _page in range(6):
        pages.append(program.text())
        program.press("tab")
    return "\n".join(pages)


def form(program: Whole, group: str) -> ParameterForm:
    machine = program.app.screens[0]
    assert isinstance(machine, MachineScreen)
    machine.form(group)
    found = program.app.screens[-1]
    assert isinstance(found, ParameterForm)
    return found


def go_to(program: Whole, found: ParameterForm, name: str) -> None:
    """Puts the cursor into a parameter's field, and empties it."""
    names = [view.name for view in program.console.production().parameters(found._group)]  # type: ignore[union-attr]
    found.go(-len(names))
    found.go(names.index(name))
    program.press("end", *["backspace"] * 12)


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_at_every_size_there_is_what_the_paper_names(program: Whole, language: str) -> None:
    words.use(language)
    view, records = program.console.view(), program.console.production().records()  # type: ignore[union-attr]
    for size in SIZES:
        program.paper.size = size
        first, whole = program.text(), all_pages(program)
        for axis in view.axes:
            assert re.search(rf"^│?{axis.name.upper():3} +0\.000 +0\.000", first, re.M)
        for label in ("Stroke", "Bottom", "Tool", "Diameter", "Offset +-", "Holes", "absolute", "relative"):
            assert words._(label) in first
        assert "40.000 mm" in first  # the bottom dead centre, [drill] down
        named = [name for name, _now in (*view.sensors, *view.outputs, *view.words)]
        for name in (*named, words._("Magazine"), words._("place")):
            assert name in whole
        assert all(f"T{tool.number} " in whole for tool in records.tools)


def test_the_seven_buttons_do_the_same_by_key_and_by_click(program: Whole, monkeypatch: pytest.MonkeyPatch) -> None:
    screen = program.app.screens[-1]
    calls: list[str] = []
    for key in BUTTONS:
        monkeypatch.setattr(screen, key.method, lambda method=key.method: calls.append(method))
    program.press(*(key.names[0] for key in BUTTONS))
    rows = program.text().splitlines()
    for key in BUTTONS:
        label = f"[{key.printed} {key.short}]"
        row = next(number for number, text in enumerate(rows) if label in text)
        program.press(("mouse press", 1, rows[row].index(label) + 1, row))
    assert calls == 2 * [key.method for key in BUTTONS]
    assert [key.short for key in BUTTONS] == ["Start", "Home", "Park", "Import", "Tools", "Magazine", "Parameters"]


def test_a_form_for_each_group_shows_each_parameter_with_its_help(program: Whole) -> None:
    assert {row.group for row in PARAMETERS} == set(GROUPS)
    for number, group in enumerate(GROUPS, start=1):
        program.press("7", str(number))
        text = program.text()
        first = program.console.production().parameters(group)[0]  # type: ignore[union-attr]
        assert GROUPS[group] in text and first.name in text and first.meaning in text
        program.press("esc")
        assert isinstance(program.app.screens[-1], MachineScreen)


def test_what_cannot_be_is_said_as_it_is_typed_and_not_saved(program: Whole) -> None:
    found = form(program, "machining")
    go_to(program, found, "machining.feed_mm_min")
    program.press(*"60001")
    assert "feed_mm_min can't be 60001: the greatest is 60000 mm/min" in program.text()
    program.press("f2")
    assert "Not saved" in program.text()
    program.press("enter", "esc")
    assert "Leave without saving?" in program.text()
    program.press("y")
    assert not user_tables().exists()


def test_what_is_saved_is_the_machine_s_and_an_unset_parameter_refuses_the_start(program: Whole) -> None:
    found = form(program, "machining")
    go_to(program, found, "machining.feed_mm_min")
    program.press(*"999")
    go_to(program, found, "machining.lift_mm_min")
    program.press("f2")
    assert "started anew" in program.text()
    assert (user_tables() / "machines" / "eight-axis.toml").is_file()
    parameters = program.console.machine.parameters
    assert parameters is not None and parameters.value("machining", "feed_mm_min") == 999
    assert parameters.missing() == ("machining.lift_mm_min",)
    program.press("esc")
    assert "machining.lift_mm_min" in all_pages(program)
    refused = program.console.load("any", JobOptions())
    assert [str(problem).partition(": ")[2] for problem in refused] == [
        "parameter machining.lift_mm_min is unset; it must be entered first"
    ]


def test_where_the_position_is_known_a_change_that_costs_it_is_asked_for(program: Whole) -> None:
    program.press("2", "y")
    for _ in range(2000):
        program.go_on(1)
        if not program.console.at_work:
            break
    assert program.console.view().position_known
    found = form(program, "machining")
    go_to(program, found, "machining.feed_mm_min")
    program.press(*"800", "f2")
    assert "Save? The machine is started anew" in program.text()
    program.press("n")
    assert program.console.view().position_known and not user_tables().exists() and found.changed
    program.press("f2", "y")
    assert not program.console.view().position_known and user_tables().exists()


def test_tools_are_added_and_removed(program: Whole) -> None:
    found = form(program, "tool")
    program.press("insert", *"17", "enter")
    assert any(row.name == "tool.17.diameter_mm" for row in program.console.production().parameters("tool"))  # type: ignore[union-attr]
    go_to(program, found, "tool.17.kind")
    program.press(*"unset")
    assert not found.changed
    program.press("delete")
    assert "Remove tool.17?" in program.text()
    program.press("y")
    assert not any(row.name.startswith("tool.17.") for row in program.console.production().parameters("tool"))  # type: ignore[union-attr]


RECORDS = Records(
    stroke_mm=6.0, bottom_mm=40.0, absolute_mm=(10.0, 0.0), relative_mm=None, cycle_s=0.1,
    tools=(ToolRecord(1, 0.1, 0.05, 3000, 1), ToolRecord(4, 0.78, 0.05, 90, 2), ToolRecord(5, 0.81, 0.05, None, 0)),
    places=(PlaceRecord(1, 1, (True, False, None)), PlaceRecord(2, 4)), chucks=(4, 0, None), missing=(),
)  # fmt: skip


def plain(lines: list[Line]) -> list[str]:
    return ["".join(part if isinstance(part, str) else part[1] for part in line) for line in lines]


def test_the_tool_in_use_is_that_which_serves_the_code_of_the_file() -> None:
    """BOARD's T1 has 0.8 mm: the machine's own T1 does not fit, the nearest one does."""
    in_use = tool_in_use(VIEW, RECORDS, BOARD)
    assert in_use is not None and in_use.number == 5
    assert next(line for line in plain(tool_lines(VIEW, RECORDS, BOARD)) if line.startswith(">")).split()[1] == "T5"
    stepping = replace(VIEW, change_step=13, command="KMD_RUCH x=5")
    for shown in (stepping, replace(stepping, command="")):
        assert f"Command   change, step 13{': ' * bool(shown.command)}{shown.command}" in plain(
            work_lines(shown, RECORDS, BOARD, None, 60)
        )
    assert "Diameter  0.800 mm" in plain(work_lines(VIEW, RECORDS, BOARD, None, 36))
    assert tool_in_use(VIEW, RECORDS, None) is RECORDS.tools[0]


def test_the_magazine_says_what_is_there_what_is_not_and_what_is_unknown() -> None:
    shown = "\n".join(plain(magazine_lines(RECORDS, 34)))
    assert "1 T1  o.?" in shown and "2 T4" in shown
    assert "1:T4" in shown and "2:-" in shown and "3:?" in shown
    lost = plain(magazine_lines(replace(RECORDS, trouble=Message("can't be read")), 34))
    assert "can't be read" in lost


def test_coordinates_count_from_the_origins_of_the_parameters_or_from_the_base() -> None:
    """The axes of VIEW stand at 3.175 mm, which is also their place from the working base."""
    at_base = plain(coordinate_lines(VIEW, RECORDS))
    assert [line.split() for line in at_base[1:3]] == [["X", "-6.825", "3.175"], ["Y", "3.175", "3.175"]]
    own = plain(coordinate_lines(VIEW, replace(RECORDS, relative_mm=(1.0, 2.0))))
    assert [line.split() for line in own[1:3]] == [["X", "-6.825", "2.175"], ["Y", "3.175", "1.175"]]


def test_a_long_command_is_told_in_as_many_words_as_there_is_room_for() -> None:
    lifting = replace(VIEW, command="KMD_GORA_X_Y 1401 1782 z1=1 z2=1 z3=1 z4=1 z5=1 z6=1")
    assert "Command   KMD_GORA_X_Y 1401 1782 .." in plain(work_lines(lifting, RECORDS, BOARD, None, 36))
