"""The key tables of all screens together: what has a meaning everywhere has no other on any screen."""

import importlib
import pkgutil
from collections.abc import Iterator

import pytest

from drillctl.ui import boiler_drum, pcb_drill, screens
from drillctl.ui.widgets.keys import FRAME_KEYS, Key

# Keys that have one meaning, whichever method of a screen carries it out.
UP_OR_DOWN = {"jog_on", "jog_back", "row", "upwards", "downwards", "go"}
SIDEWAYS = {"jog_back", "jog_on", "sideways", "step"}
MORE_OR_LESS = {"zoom", "step_size", "next_cell"}
MEANINGS = {
    **dict.fromkeys(("up", "down", "page up", "page down"), UP_OR_DOWN),
    **dict.fromkeys(("left", "right"), SIDEWAYS),
    **dict.fromkeys(("+", "=", "-"), MORE_OR_LESS),
    "enter": {"choose", "toggle", "edit", "ask", "found", "go", "upwards"},  # what the cursor stands on is done
    "delete": {"remove", "delete", "fewer"},
    "insert": {"insert", "more"},
    "f2": {"save", "use"},  # what was edited holds from now on
    "f5": {"run_all", "test", "try_out", "choose"},  # what is shown is run
    "g": {"go_to", "go_there"},
    "/": {"filter", "search"},  # what has a text in it
}
# Keys that still have several meanings, by the methods that they call. A key may leave this table, and none may come.
# The panel of the boiler drum has the letters of that machine's own keyboard: its digits A to F, MEM, PROG.
SEVERAL = {
    " ": {"follow", "hold_or_resume", "pause", "toggle"},
    "a": {"acknowledge", "add", "mark", "more", "typed_digit"},
    "b": {"change_bit", "mark", "set_base", "typed_digit"},
    "c": {"copy", "find_on", "tool_changed", "typed_digit"},
    "d": {"compare", "dry_run", "typed_digit"},
    "e": {"examples", "find_on", "typed_digit"},
    "f": {"files", "find_on", "typed_digit"},
    "f3": {"diff", "open"},
    "f6": {"cycle", "run_to_cursor", "swap"},
    "f7": {"copy", "run_line"},
    "f8": {"reset", "tick"},
    "g": {"go_there", "go_to", "resume"},
    "h": {"go_to_hole", "hide"},
    "k": {"acknowledge", "cycle", "isolate"},
    "l": {"find_on", "list_workpieces", "recent"},
    "m": {"cycle", "jog_unit", "memory", "mirror", "show_machine"},
    "n": {"choose_format", "find_on"},
    "o": {"cycle", "open_file"},
    "p": {"call_workpiece", "panel"},
    "r": {"cycle", "find_on", "go_real", "reset"},
    "s": {"find_on", "go_simulated", "start"},
    "t": {"cycle", "test", "type_place"},
    "tab": {"complete", "go", "next_motor", "other_side", "sideways", "turn_page"},
    "v": {"offset", "show_all", "tool_numbers"},
    "w": {"how_to_drill", "whole", "whole_board"},
    "z": {"return_to_zero", "zoom_board"},
}
# These call one method, on every screen that has them.
ALONE = {"i": "initialise", "x": "stop", "u": "unfinished", "ctrl u": "undo", "ctrl r": "redo"}


def tables() -> Iterator[tuple[str, tuple[Key, ...]]]:
    for package in (screens, pcb_drill, boiler_drum):
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
    """What each key calls, on all screens together."""
    found: dict[str, set[str]] = {}
    for keys in TABLES.values():
        for key in keys:
            for name in key.names:
                found.setdefault(name, set()).add(key.method)
    return found


def test_a_key_has_one_meaning_on_all_screens() -> None:
    several = {name: methods for name, methods in methods_by_key().items() if not is_one(name, methods)}
    assert several == SEVERAL


def is_one(name: str, methods: set[str]) -> bool:
    return len(methods) == 1 or methods <= MEANINGS.get(name, set())


def test_a_second_meaning_is_seen() -> None:
    assert not is_one("i", {"initialise", "insert"}) and not is_one("up", {"row", "start"}) and is_one("p", {"panel"})


def test_these_keys_call_one_method_everywhere() -> None:
    found = methods_by_key()
    assert {name: found.get(name) for name in ALONE} == {name: {method} for name, method in ALONE.items()}


def test_all_screens_are_looked_at() -> None:
    assert {"Drilling", "Files", "Panel", "PhaseEditor", "RampEditor", "QueueEditor", "Signals", "Scope"} <= set(TABLES)


def test_the_letters_that_command_the_machine_mean_nothing_else_where_boards_are_chosen() -> None:
    commands = {"start", "dry_run", "acknowledge", "set_base", "tool_changed", "initialise", "stop", "files"}
    letters = {name for key in TABLES["Drilling"] if key.method in commands for name in key.names}
    assert len(letters) == len(commands)
    assert not letters & {name for key in TABLES["Files"] for name in key.names}
