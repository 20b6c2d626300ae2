"""Files: formats by name, recent jobs, panel, how to drill, example boards and lab sheets."""

import re
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from drillctl.ui.pcb_drill import examples
from drillctl.ui.pcb_drill.drilling import Drilling
from drillctl.ui.pcb_drill.files import Files
from drillctl.ui.pcb_drill.typed import FORMATS
from drillctl.viewmodel.job_options import JobOptions, MeasuredHole, PanelOf, PinsOf
from drillctl.viewmodel.jobs import RecentJob
from tests.ui.fake_console import VIEW, FakeConsole, Program
from tests.ui.opened_board import asked, opened, typed

pytestmark = pytest.mark.usefixtures("idle", "folder")  # the list of files is drawn behind each box


@pytest.mark.parametrize("index", range(len(FORMATS)))
def test_a_format_is_chosen_by_its_name(folder: Path, index: int) -> None:
    program = opened()
    program.press("f6", str(index + 1))
    assert asked(program).format == (FORMATS[index].option or None)


def test_the_papers_four_formats_are_named_and_any_other_can_be_typed(folder: Path) -> None:
    program = opened()
    program.press("f6")
    for name in ("ASCII drill format", "EXCELLON decimal", "EXCELLON adding zero", "EXCELLON metric"):
        assert name in program.text()
    program.press(*["down"] * len(FORMATS), "enter")
    assert "Units, digits and zeros left out" in program.text()
    program.press(*"mm,4:4,none", "enter")
    assert asked(program).format == "mm,4:4,none"


def test_the_reason_and_the_runner_up_are_shown(folder: Path) -> None:
    text = opened(size=(160, 50)).text()
    assert "Excellon decimal, mm decimal (90%): the numbers carry points" in text and "else: inch decimal" in text


def test_a_panel_is_asked_checked_and_shown(folder: Path) -> None:
    program = opened()
    program.press("p")
    typed(program, "2", "three", "40", "30,5")
    program.press("enter")
    assert "'three' is not a number of boards" in program.text()
    program.press("up", "up", "up")
    typed(program, "3")
    program.console.answer = ("a panel of 2 x 3 boards; 1000 are the most",)
    program.press("enter")
    assert "1000 are the most" in program.text()
    program.console.answer = ()
    program.press("enter")
    assert asked(program).panel == PanelOf(2, 3, 40.0, 30.5)
    assert "Panel: 2 x 3, 40 by 30.5 mm" in program.text()
    program.press("p")
    typed(program, "1", "1")
    program.press("enter")
    assert asked(program).panel is None


def test_how_to_drill_is_asked_and_shown(folder: Path) -> None:
    program = opened(size=(100, 40))
    program.press("h")
    typed(program, "0.5", "0,2", "T3 2", "drills.toml", "3:left-right:6", "yes")
    program.press("enter")
    pins = PinsOf(3.0, "left-right", 6.0)
    wanted = JobOptions(peck_mm=0.5, spot_mm=0.2, skip_tools=(2, 3), drills=str(folder / "drills.toml"), pins=pins,
                        mill=True)  # fmt: skip
    assert asked(program) == wanted
    for told in ("In pecks of 0.5 mm", "A spot of 0.2 mm first", "Without tools T2 T3", "Drills at hand: ",
                 "Pins of 3 mm, 6 mm outside", "Slots are milled"):  # fmt: skip
        assert told in program.text()
    program.press("h")
    typed(program, "", "", "", "", "", "", wiped=120)
    program.press("enter")
    assert asked(program) == JobOptions()


@pytest.mark.parametrize(("field", "text"), [(0, "deep"), (1, "inf"), (2, "T1 x")])
def test_what_cannot_be_read_is_said_in_the_form(folder: Path, field: int, text: str) -> None:
    program = opened()
    before = len(program.console.asked)
    program.press("h", *["down"] * field)
    typed(program, text)
    program.press("enter")
    assert f"{text!r} is not a l" in program.text() and len(program.console.asked) == before
    program.press("esc")
    assert "is not a l" not in program.text()


def test_recent_jobs_are_opened_with_their_settings_by_one_key(folder: Path) -> None:
    settings = JobOptions(mirror="x", panel=PanelOf(2, 1, 40.0, 0.0))
    jobs = [RecentJob(str(folder / "four.drl"), settings), RecentJob("/gone/two.drl", JobOptions())]
    program = Program(FakeConsole(recent_jobs=jobs))
    program.press("f", "l")
    assert "1 four.drl  in X  Panel: 2 x 1" in program.text() and "2 two.drl" in program.text()
    program.press("1")
    assert program.console.asked == [("load", str(folder / "four.drl"), settings)]
    assert "4 holes, 40.00 x 20.00 mm" in program.text()
    program.console.answer = ("/gone/two.drl: can't be read: No such file or directory",)
    program.press("l", "down", "enter")
    assert "Refused" in program.text() and asked(program) == JobOptions()


def test_holes_behind_the_end_can_be_asked_for(folder: Path) -> None:
    program = opened(size=(130, 40))
    assert "Behind M30: refuse holes" in program.text()
    for choice, word in (("ignore", "leave out"), ("drill", "drill too"), ("refuse", "refuse holes")):
        program.press(">")
        assert asked(program).after_end == choice and f"Behind M30: {word}" in program.text()


def test_a_list_of_recent_jobs_with_a_value_that_is_not_known_is_shown(folder: Path) -> None:
    settings = JobOptions(rotate_deg=33.0)
    program = Program(FakeConsole(recent_jobs=[RecentJob(str(folder / "four.drl"), settings)]), (130, 40))
    program.press("f", "l")
    assert "four.drl  33.0" in program.text()
    program.press("1", "r")
    assert asked(program).rotate_deg == 0.0


def test_another_board_is_not_placed_by_what_was_measured_on_the_last(folder: Path) -> None:
    (folder / "more.drl").write_text("M48\n")
    settings = JobOptions(mirror="x", align=(MeasuredHole(0, 0, 1, 1),), skip_tools=(2,))
    jobs = [RecentJob(str(folder / "four.drl"), settings)]
    program = Program(FakeConsole(recent_jobs=jobs))
    program.press("f", "l", "1", "down", "enter")
    assert asked(program) == JobOptions(mirror="x")


def test_an_exclamation_mark_is_typed_at_rest_and_stops_otherwise(folder: Path) -> None:
    program = opened()
    program.press("/")
    program.press("!", "enter")
    assert ("emergency_stop",) not in program.console.asked
    program.press("!")
    assert program.console.asked.pop() == ("emergency_stop",)
    states: tuple[dict[str, Any], ...] = ({"moving": True}, {"command": "KMD_CZEKAJ 100"}, {"queued": 3})
    for busy in states:
        program = opened()
        program.press("/")
        program.console.now = replace(VIEW, **busy)
        program.press("!")
        assert program.console.asked[-1] == ("emergency_stop",)


def test_f10_stops_in_a_field_at_rest_too(folder: Path) -> None:
    program = opened()
    program.press("h", "f10")
    assert program.console.asked[-1] == ("emergency_stop",)


@pytest.mark.parametrize("first", [(), ("f",)], ids=["from Drilling", "from Files"])
def test_an_example_board_is_loaded_by_its_number(first: tuple[str, ...]) -> None:
    program = Program(FakeConsole())
    program.press(*first, "e")
    board = examples.boards()[0]
    assert f"1 board {board.name}" in program.text()
    program.press("1")
    assert program.console.asked == [("load", str(board), JobOptions())]
    assert isinstance(program.app.screens[-1], Drilling)


def test_a_lab_sheet_is_opened_to_be_read() -> None:
    program = Program(FakeConsole())
    program.press("e", *["down"] * len(examples.boards()), "enter")
    assert "# 1. Phase sequences" in program.text()
    program.press("page down", "q")
    assert isinstance(program.app.screens[-1], Drilling) and not program.console.asked


def test_an_installation_without_examples_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    empty = tmp_path / "empty"
    empty.mkdir()
    monkeypatch.setattr(examples, "shipped", lambda name, in_checkout: empty)
    program = Program(FakeConsole())
    program.press("e")
    assert "not part of this installation" in program.text()


def test_a_large_window_has_options_by_their_keys_and_a_small_one_above_the_facts(folder: Path) -> None:
    large = opened(size=(160, 50)).text().splitlines()
    list_side = [row[:62] for row in large]
    for key in Files.keys:
        if key.method in ("cycle", "offset", "panel", "align", "how_to_drill", "choose_format"):
            assert any(re.match(rf"\W*{re.escape(key.printed)} +\w", row) for row in list_side), key.printed
    picture = [row for row in large if re.search("[\u2801-\u28ff]", row)]
    assert len(picture) >= 24 and any("█" in row and "T1" in row for row in large)
    small = opened(size=(80, 24)).text()
    assert "Behind M30: refuse holes" in small and "4 holes, 40.00 x 20.00 mm" in small


def test_a_file_is_drawn_before_it_is_loaded_and_read_only_when_it_is_shown(folder: Path) -> None:
    (folder / "seen.drl").write_text("M48\nMETRIC\n")
    program = Program(FakeConsole(), (160, 50))
    program.press("f")
    program.text()
    program.console.glanced.clear()
    program.app.loop.process_input(["down", "down"])  # with no picture between
    assert program.console.glanced == []
    text = program.text()
    assert program.console.glanced == [(str(folder / "seen.drl"), JobOptions())]
    assert "seen.drl: 4 holes, 40.00 x 20.00 mm; Enter loads it" in text and "METRIC" in text and " 5 mm" in text
    assert "no board: Enter opens one, E shows the examples" in text
    program.text()
    assert len(program.console.glanced) == 1 and program.console.loaded is None
    program.press("up")
    assert " 5 mm" not in program.text() and "No board is loaded." in program.text()
