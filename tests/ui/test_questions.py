"""Questions and habits: y and n, the safe answer, the word that every answer leaves."""

from pathlib import Path
from typing import Any

import pytest
import urwid
from msgspec.structs import replace

from drillctl.language import words
from drillctl.ui.explanations import EXPLAINED, SIGNS
from drillctl.ui.pcb_drill.drilling import Drilling
from drillctl.ui.pcb_drill.files import Files
from drillctl.ui.widgets.dialogs import WIDEST
from drillctl.viewmodel.console import ToolWanted
from tests.ui.fake_console import BOARD, FAULT, VIEW, FakeConsole, Program
from tests.ui.whole import SCREENS, Whole, at_home, show

pytestmark = pytest.mark.usefixtures("idle")

YES_KEYS = [("en", "y"), ("en", "Y"), ("pl", "t"), ("pl", "T"), ("pl", "y")]
NO_KEYS = [("en", "n"), ("en", "enter"), ("en", "esc"), ("en", "q"), ("pl", "n"), ("pl", "N"), ("pl", "esc")]


def asked(language: str) -> Program:
    words.use(language)
    program = Program(FakeConsole(loaded=BOARD))
    program.press("s")
    return program


@pytest.mark.parametrize(("language", "key"), YES_KEYS)
def test_the_letter_of_yes_answers_yes(language: str, key: str) -> None:
    program = asked(language)
    program.press(key)
    assert program.console.asked == [("start", False)] and program.app.layers.top is None
    assert words._("answered yes") in program.text()


@pytest.mark.parametrize(("language", "key"), NO_KEYS)
def test_every_other_way_out_answers_no_and_says_so(language: str, key: str) -> None:
    program = asked(language)
    program.press(key)
    assert not program.console.asked and program.app.layers.top is None
    assert words._("answered no: nothing was started or changed") in program.text()
    program.press("+")
    assert words._("answered no: nothing was started or changed") not in program.text()


@pytest.mark.parametrize(("language", "labels"), [("en", ("No (N)", "Yes (Y)")), ("pl", ("Nie (N)", "Tak (T)"))])
def test_a_question_names_both_keys_and_the_safe_answer(language: str, labels: tuple[str, str]) -> None:
    text = asked(language).text()
    assert all(label in text for label in labels) and words._("Enter and Esc mean no.") in text


def test_another_letter_answers_nothing() -> None:
    program = asked("en")
    program.press("x", "s", "t")
    assert "Drill 4 holes" in program.text() and not program.console.asked


@pytest.mark.parametrize(("key", "done"), [("y", [("tool_changed",)]), ("n", [])])
def test_the_tool_change_is_answered_by_letters_too(key: str, done: list[tuple[str]]) -> None:
    program = Program(FakeConsole(now=replace(VIEW, tool_wanted=ToolWanted(2, 1.0), at_work=True), loaded=BOARD))
    program.app.turn()
    program.press(key)
    assert program.console.asked == done


@pytest.mark.parametrize("box", ["tool", "f1", "?"])
@pytest.mark.parametrize("key", ["x", "X"])
def test_x_stops_the_job_over_a_box_too(box: str, key: str) -> None:
    tool = ToolWanted(2, 1.0) if box == "tool" else None
    program = Program(FakeConsole(now=replace(VIEW, tool_wanted=tool, at_work=True), loaded=BOARD))
    program.app.turn()
    program.press(*([box] if tool is None else []))
    assert program.app.layers.top is not None
    program.press(key)
    assert program.console.asked == [("stop",)]


PLACES = {  # keys that lead there, and whether a text field has the cursor then
    "drilling": ((), False), "a menu": (("meta f",), False), "the finder": (("ctrl p",), True),
    "a form": (("t",), True), "the files": (("f",), False), "a filter": (("f", "/"), True),
}  # fmt: skip


@pytest.mark.parametrize("state", [{"at_work": True}, {"moving": True}, {"queued": 3}])
@pytest.mark.parametrize("place", PLACES)
def test_the_job_is_stopped_from_everywhere_by_the_key_that_the_next_step_names(
    place: str, state: dict[str, Any]
) -> None:
    keys, typing = PLACES[place]
    program = Program(FakeConsole(now=replace(VIEW, **state), loaded=BOARD))
    program.press(*keys)
    program.app.turn()
    if not state.get("queued"):
        assert f"{'Ctrl-X' if typing else 'X'} ends the job" in program.text()
    program.press("x")
    assert program.app.layers.typing == typing and program.console.asked == ([] if typing else [("stop",)])
    program.press("ctrl x")
    assert program.console.asked[-1] == ("stop",) and "stop; the position is kept" in program.text()


@pytest.mark.parametrize("box", ["ctrl p", "t", "f9"])
def test_a_terminal_that_is_too_small_shows_x_and_x_stops(box: str) -> None:
    program = Program(FakeConsole(now=replace(VIEW, at_work=True), loaded=BOARD))
    program.press(box)
    program.paper.size = (40, 12)
    program.press("window resize")
    assert "X ends the job" in " ".join(program.text().split())
    program.press("x")
    assert program.console.asked == [("stop",)]


def test_a_stop_with_nothing_under_way_says_so() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("f", "x")
    assert "nothing is under way that could be stopped" in program.text()


def test_letters_are_typed_where_text_is_typed() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("t", *"qyn?")
    assert "qyn?" in program.text() and program.app.layers.top is not None


BUSY = {
    "latched": {"condition": "latched", "fault": FAULT}, "held": {"condition": "held", "at_work": True},
    "a tool": {"tool_wanted": ToolWanted(2, 1.0), "at_work": True}, "at work": {"at_work": True, "moving": True},
    "returning": {"condition": "returning", "fault": FAULT}, "stopping": {"condition": "stopping"},
    "zero only": {"condition": "zero_only"},
}  # fmt: skip


@pytest.mark.parametrize("state", BUSY.values(), ids=BUSY)
@pytest.mark.parametrize("key", ["s", "d"])
def test_what_can_not_be_granted_is_not_asked_and_the_reason_is_told(key: str, state: dict[str, object]) -> None:
    program = Program(FakeConsole(now=replace(VIEW, **state), loaded=BOARD))
    program.press("esc", key)
    assert program.app.layers.top is None and not program.console.asked
    assert "refused: " in program.text() and "Drill 4 holes" not in program.text()


def test_q_leaves_what_is_on_top_and_at_last_the_program() -> None:
    program = Program(FakeConsole(loaded=BOARD))
    program.press("f", "f1", "q")
    assert program.app.layers.top is None and isinstance(program.app.screens[-1], Files)
    program.press("meta d", "q")
    assert program.app.layers.top is None and isinstance(program.app.screens[-1], Files)
    program.press("q")
    assert isinstance(program.app.screens[-1], Drilling)
    program.console.now = replace(VIEW, at_work=True)
    program.press("q")
    assert "at work. Stop it" in program.text()
    program.press("n")
    program.console.now = VIEW
    with pytest.raises(urwid.ExitMainLoop):
        program.press("q")


@pytest.mark.parametrize("language", words.LANGUAGES)
def test_no_line_of_an_explanation_is_wider_than_its_dialog(language: str) -> None:
    words.use(language)
    assert all(len(lines) <= 10 for lines in EXPLAINED.values())
    for lines in (*EXPLAINED.values(), *SIGNS.values()):
        assert all(len(words._(line)) <= WIDEST - 4 for line in lines)


def test_every_screen_is_explained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    at_home(tmp_path, monkeypatch)
    program = Whole((100, 60))
    try:
        for name in SCREENS:
            screen = show(program.app, name)
            program.press("?" if name not in ("queue_editor", "parameters") else "f1")
            assert words._(EXPLAINED[screen.title][0]) in program.text(), name
            program.press("q")
            program.press("enter")  # opens an editor from a list
            opened = program.app.screens[-1]
            assert opened.title in EXPLAINED
            while program.app.layers.top:
                program.app.layers.pop()
    finally:
        program.console.close()


def test_every_sign_of_the_drilling_screen_is_explained() -> None:
    program = Program(FakeConsole(loaded=BOARD), (80, 80))
    program.press("?")
    for sign in ("12 +0", "[24a]", "○", "◎", "+ the drill"):
        assert sign in program.text()
