"""The key tables of all screens together: what has a meaning everywhere has no other on any screen."""

import importlib
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.ui import boiler_drum, eight_axis, pcb_drill, screens
from drillctl.ui.boiler_drum.programming import HEX_KEYS
from drillctl.ui.widgets.keys import FRAME_KEYS, STOP, Key

# What each key means, for the keys that call several methods. Any other key calls one method, on every screen that has
# it. In words, for the user: docs/KEYS.md.
UP_OR_DOWN = {"jog_on", "jog_back", "row", "upwards", "downwards", "go"}
SIDEWAYS = {"jog_back", "jog_on", "sideways", "step"}
MORE_OR_LESS = {"zoom", "step_size", "next_cell"}
MEANINGS = {
    **dict.fromkeys(("up", "down", "page up", "page down"), UP_OR_DOWN),
    **dict.fromkeys(("left", "right"), SIDEWAYS),
    **dict.fromkeys(("+", "=", "-"), MORE_OR_LESS),
    # what the cursor is on
    "enter": {"choose", "toggle", "edit", "ask", "found", "go", "upwards", "isolate", "try_out"},
    " ": {"hold_or_resume", "pause", "follow", "toggle"},  # switches between two states
    "tab": {"go", "next_motor", "next_kind", "other_side", "sideways", "turn_page", "complete"},  # on to the next
    "delete": {"remove", "delete", "fewer", "hide"},  # what the cursor is on is taken away
    "insert": {"insert", "more", "add", "show_all"},  # something comes to what is there
    "f2": {"save", "use"},  # what was edited holds from now on
    "f3": {"diff", "compare"},  # what differs
    "f5": {"run_all", "test", "try_out", "choose"},  # what is shown is run
    # asks what else to use
    "f6": {"choose_value", "change_bit", "choose_format", "choose_plant", "choose_port", "choose_run"},
    "g": {"go_to", "go_there", "go_to_hole"},  # goes to a hole or a tick
    "l": {"recent", "list_workpieces"},  # the list of what can be loaded
    "m": {"cycle", "mirror"},  # mirrored; in Files it is one of the options
    "w": {"whole", "whole_board"},  # the whole of what is shown
    "y": {"curve", "tool_numbers"},  # as a picture, or in numbers
    "/": {"filter", "search"},  # what has a text in it
}
# The keyboard of the boiler drum's machine has its digits A to F, and these: MEM, PROG, CONT, ZERO, RESET.
PAPER_KEYS = {*HEX_KEYS, "m", "p", "g", "z", "r"}
# These call one method, on every screen that has them.
ALONE = {"i": "initialise", "s": "start", "a": "acknowledge", "u": "unfinished", "ctrl u": "undo", "ctrl r": "redo"}
KEYS_PAGE = Path(__file__).resolve().parents[2] / "docs" / "KEYS.md"


def tables() -> Iterator[tuple[str, tuple[Key, ...]]]:
    for package in (screens, pcb_drill, boiler_drum, eight_axis):
        for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
            for name, value in vars(importlib.import_module(found.name)).items():
                if isinstance(value, type) and value.__module__ == found.name and hasattr(value, "keys"):
                    yield name, value.keys


TABLES = dict(tables())


@pytest.mark.parametrize("screen", TABLES)
def test_no_screen_takes_a_key_of_the_frame(screen: str) -> None:
    frames = {name for key in FRAME_KEYS for name in key.names}
    assert not {name for key in TABLES[screen] for name in key.names} & frames


@pytest.mark.parametrize("screen", TABLES)
def test_no_screen_has_a_key_twice(screen: str) -> None:
    names = [name for key in TABLES[screen] for name in key.names]
    assert len(names) == len(set(names))


def methods_by_key() -> dict[str, set[str]]:
    """What each key calls, on all screens together; without the keyboard of the boiler drum's machine."""
    found: dict[str, set[str]] = {}
    for screen, keys in TABLES.items():
        for key in keys:
            for name in key.names:
                if not (screen == "Panel" and name in PAPER_KEYS):
                    found.setdefault(name, set()).add(key.method)
    return found


def test_a_key_has_one_meaning_on_all_screens() -> None:
    assert not {name: methods for name, methods in methods_by_key().items() if not is_one(name, methods)}


def test_the_panel_has_its_exceptions_for_the_keys_of_the_machine_alone() -> None:
    methods = {key.method for key in TABLES["Panel"] if PAPER_KEYS.intersection(key.names)}
    assert methods == {"typed_digit", "memory", "call_workpiece", "resume", "return_to_zero", "reset"}


def test_the_page_of_the_keys_names_each_key_once() -> None:
    printed = {key.printed for table in (*TABLES.values(), FRAME_KEYS) for key in table if key.names}
    rows = [line for line in KEYS_PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| `")]
    named = [sign.strip("`") for row in rows for sign in row.split(" | ")[0].removeprefix("| ").split(" · ")]
    assert printed == {*named} and len(named) == len({*named})


def is_one(name: str, methods: set[str]) -> bool:
    return len(methods) == 1 or methods <= MEANINGS.get(name, set())


def test_a_second_meaning_is_seen() -> None:
    assert not is_one("i", {"initialise", "insert"}) and not is_one("up", {"row", "start"}) and is_one("p", {"panel"})


def test_these_keys_call_one_method_everywhere() -> None:
    found = methods_by_key()
    assert {name: found.get(name) for name in ALONE} == {name: {method} for name, method in ALONE.items()}
    assert STOP.method == "stop" and STOP in FRAME_KEYS


def test_all_screens_are_looked_at() -> None:
    assert {"Drilling", "Files", "Panel", "PhaseEditor", "RampEditor", "QueueEditor", "Signals", "Scope"} <= set(TABLES)


def test_the_letters_that_command_the_machine_mean_nothing_else_where_boards_are_chosen() -> None:
    commands = {"start", "dry_run", "acknowledge", "set_base", "tool_changed", "initialise", "files"}
    letters = {name for key in TABLES["Drilling"] if key.method in commands for name in key.names}
    assert len(letters) == len(commands)
    assert not letters & {name for key in TABLES["Files"] for name in key.names}
