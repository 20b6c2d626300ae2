"""The next step: a sentence for every condition, with keys that work where it stands."""

import re
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any

import pytest
import urwid
from msgspec.structs import replace

from drillctl.language import words
from drillctl.ui.boiler_drum import menus as drum_menus
from drillctl.ui.next_step import step_line
from drillctl.ui.pcb_drill.menus import MENUS
from drillctl.ui.screens.board_steps import ACTIONS, ROWS
from drillctl.ui.screens.configuration import ConfigurationScreen
from drillctl.ui.screens.own_steps import shown_step
from drillctl.ui.screens.phase_editor import PhaseEditor
from drillctl.ui.screens.plant import PlantScreen
from drillctl.ui.screens.port import PortScreen
from drillctl.ui.screens.queue_editor import QueueEditor
from drillctl.ui.screens.ramp_editor import RampEditor
from drillctl.ui.screens.scope import Scope
from drillctl.ui.screens.shell import Step
from drillctl.ui.screens.signals import Signals
from drillctl.ui.screens.step_rows import Row
from drillctl.ui.screens.table_list import TableList
from drillctl.ui.widgets.menus import Item
from drillctl.ui.widgets.texts import width_of
from drillctl.viewmodel.console import MachineView, ToolWanted
from tests.ui.fake_console import BOARD, FAULT, VIEW, FakeConsole, Program

pytestmark = pytest.mark.usefixtures("idle")

drum_steps = import_module("drillctl.ui.boiler_drum.next_step")  # the package has the function of this name
FIELD = re.compile(r"\{(\w+)\}")
WITH_STEPS = (
    PhaseEditor, RampEditor, TableList, QueueEditor, Signals, ConfigurationScreen, PlantScreen, PortScreen, Scope,
)  # fmt: skip
CASES = {
    "position not known": ({"position_known": False}, True, "position not known: I initialises; S does, then drills"),
    "no board": ({}, False, "no board: F opens one, E shows the examples"),
    "ready": ({}, True, "ready: S drills the board, D goes over it"),
    "a tool": ({"at_work": True, "tool_wanted": ToolWanted(2, 1.0)}, True, "T2, 1.000 mm is wanted: put it in, then C"),
    "a fault": ({"condition": "latched", "fault": FAULT}, True, "FAULT EMERGENCY_STOP: put its cause right, then E"),
    "held": ({"condition": "held", "at_work": True}, True, "held: Space goes on, X ends the job"),
    "at work": ({"moving": True, "at_work": True}, True, "at work: Space holds, X ends the job"),
    "ending": ({"condition": "stopping", "at_work": True}, True, "the job is being ended"),
    "returning": ({"condition": "returning", "fault": FAULT}, True, "the machine returns to a known position"),
    "zero only": ({"condition": "zero_only"}, True, "only the return to zero is allowed: Alt-D R"),
    "paused": ({"paused": True}, True, "the clock is stopped"),
}  # fmt: skip


def shown(view: MachineView, board: bool, *keys: str) -> str:
    program = Program(FakeConsole(now=view, loaded=BOARD if board else None))
    program.press(*keys)
    return next(row for row in program.text().splitlines() if row.startswith((" Next ", " Dalej ")))


@pytest.mark.parametrize(("state", "board", "line"), CASES.values(), ids=CASES)
def test_the_next_step_is_told_with_its_key(state: dict[str, object], board: bool, line: str) -> None:
    assert line in shown(replace(VIEW, **state), board)


def test_every_row_is_tried() -> None:
    assert len(CASES) == len(ROWS)


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize(("state", "board"), [case[:2] for case in CASES.values()], ids=CASES)
def test_the_next_step_fits_on_a_small_terminal(language: str, state: dict[str, object], board: bool) -> None:
    words.use(language)
    for keys in ((), ("f",), ("esc", "f")):
        assert "…" not in shown(replace(VIEW, **state), board, *keys)


@pytest.mark.parametrize("language", words.LANGUAGES)
@pytest.mark.parametrize(
    ("rows", "actions", "menus"),
    [(ROWS, ACTIONS, MENUS), (drum_steps.ROWS, drum_steps.ACTIONS, drum_menus.MENUS)], ids=["pcb_drill", "boiler_drum"],
)  # fmt: skip
def test_every_row_fits_by_the_letters_of_the_menus_too(
    rows: Sequence[Row[Any]], actions: Mapping[str, tuple[str, str]], menus: Sequence[Item], language: str
) -> None:
    words.use(language)
    values = {"fault": FAULT.name, "tool": "T12, 10.000 mm"}
    for row in rows:
        line = step_line(Step(row.attribute, row.text, actions, values), urwid.SolidFill(), menus)
        assert width_of(line) <= 80, line


def test_on_another_screen_the_letters_of_the_menu_are_named() -> None:
    view = replace(VIEW, position_known=False)
    assert "Alt-D I initialises" in shown(view, True, "f")
    program = Program(FakeConsole(now=view, loaded=BOARD))
    program.press("f", "meta d", "i")
    assert program.console.asked == [("initialise",)]


def test_a_fault_whose_box_was_closed_still_names_the_key() -> None:
    assert "A acknowledges" in shown(replace(VIEW, condition="latched", fault=FAULT), True, "esc")


def test_a_fault_whose_box_is_open_names_enter() -> None:
    assert "Enter acknowledges" in shown(replace(VIEW, condition="latched", fault=FAULT), True)


def test_a_row_names_actions_that_the_menus_have() -> None:
    """On the screen that has the keys, and on one that has not."""
    values = {"fault": "LIMIT", "tool": "T1"}
    for row in ROWS:
        step = Step(row.attribute, row.text, ACTIONS, values)
        for screen in (Program(FakeConsole()).app.screens[-1], urwid.SolidFill()):
            named = [part[1] for part in step_line(step, screen, MENUS)[1:] if isinstance(part, tuple)]
            assert len(named) == len(FIELD.findall(row.text)) and all(named)


@pytest.mark.parametrize("screen", WITH_STEPS)
@pytest.mark.parametrize("language", words.LANGUAGES)
def test_the_steps_of_a_screen_name_its_own_keys_and_fit(language: str, screen: Any) -> None:
    words.use(language)
    for row in screen.own_steps:
        actions = {name: ("", name) for name in FIELD.findall(row.text)}
        line = step_line(Step(row.attribute, row.text, actions), screen, ())
        named = [part[1] for part in line[1:] if isinstance(part, tuple)]
        assert len(named) == len(FIELD.findall(row.text)) and all(named) and width_of(line) <= 80, line


class Edited:
    """A table's editor as its steps see it."""

    own_steps = PhaseEditor.own_steps
    has_problem = changed = tried = loses = False


@pytest.mark.parametrize(
    ("state", "begins"),
    [
        ({}, "change what"), ({"tried": True}, "change what"), ({"changed": True}, "changed:"),
        ({"changed": True, "tried": True}, "no step is lost"),
        ({"changed": True, "tried": True, "loses": True}, "steps are lost: "),
        ({"tried": True, "loses": True}, "steps are lost with"), ({"changed": True, "has_problem": True}, "a problem"),
    ],
)  # fmt: skip
def test_an_editor_says_what_comes_next_but_not_before_what_the_machine_waits_for(
    state: dict[str, bool], begins: str
) -> None:
    editor: Any = Edited()
    vars(editor).update(state)
    machine, urgent = Step("warning", "no board"), Step("danger", "a fault", refuses="a fault is latched")
    assert shown_step(machine, editor, VIEW).text.startswith(begins)
    assert shown_step(urgent, editor, VIEW) is urgent
    assert shown_step(machine, editor, replace(VIEW, paused=True)) is machine
    assert shown_step(machine, urwid.SolidFill(), VIEW) is machine


def test_the_screen_with_the_clock_s_keys_names_them_while_it_is_stopped() -> None:
    screen: Any = QueueEditor
    step = shown_step(Step("warning", "the clock is stopped"), screen, replace(VIEW, paused=True))
    assert FIELD.findall(step.text) == ["tick", "run_all"]
