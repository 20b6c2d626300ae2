"""The key tables of all screens together: what has a meaning everywhere has no other on any screen."""

import importlib
import pkgutil
from collections.abc import Iterator

import pytest

from drillctl.ui import boiler_drum, pcb_drill, screens
from drillctl.ui.widgets.keys import FRAME_KEYS, Key

# The key, and what it means wherever it means anything: it sets the machine going or stops it without a question,
# or it keeps or takes away what was typed.
MEANINGS = {
    "i": {"initialise"},
    "x": {"stop"},
    "f2": {"save", "use"},  # what was edited holds from now on
    "delete": {"remove", "delete", "fewer"},
    "insert": {"insert", "more"},
    "u": {"undo", "unfinished"},
    "/": {"filter", "search"},  # what has a text in it
    "left": {"jog_back", "sideways", "step"},
    "right": {"jog_on", "sideways", "step"},
}


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


@pytest.mark.parametrize("screen", TABLES)
def test_a_key_that_means_something_everywhere_means_nothing_else_here(screen: str) -> None:
    for key in TABLES[screen]:
        for name in key.names:
            assert key.method in MEANINGS.get(name, {key.method}), (name, key.method)


def test_all_screens_are_looked_at() -> None:
    assert {"Drilling", "Files", "Panel", "PhaseEditor", "RampEditor", "QueueEditor", "Signals", "Scope"} <= set(TABLES)


def test_the_letters_that_command_the_machine_mean_nothing_else_where_boards_are_chosen() -> None:
    commands = {"start", "dry_run", "acknowledge", "set_base", "tool_changed", "initialise", "stop", "files"}
    letters = {name for key in TABLES["Drilling"] if key.method in commands for name in key.names}
    assert len(letters) == len(commands)
    assert not letters & {name for key in TABLES["Files"] for name in key.names}
