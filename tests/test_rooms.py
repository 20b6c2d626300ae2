"""The walls of the house: which room imports which. The table is the one in docs/ARCHITECTURE.md."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "drillctl"
MOST_ROWS = 25  # a table with more exceptions than rooms says nothing


def rooms_table() -> dict[str, tuple[str, ...]]:
    """The Markdown table under "## Rooms", top row first: room -> rooms that it may import."""
    text = (ROOT / "docs" / "ARCHITECTURE.md").read_text("utf-8")
    section = text.split("## Rooms")[1].split("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return {room: tuple(filter(None, re.split(r",\s*", allowed))) for room, _, allowed in rows[2:]}


ROOMS = rooms_table()


def room_of(module: str) -> str:
    """``drillctl.portio.simulated`` is a room of its own, ``drillctl.portio.playback`` is in ``portio``."""
    parts = module.split(".")[1:]
    names = [".".join(parts[:length]) for length in range(len(parts), 0, -1)]
    return next((name for name in names if name in ROOMS), names[-1] if names else "")


def imported_modules(source: str, package: str) -> set[str]:
    """Every drillctl name that a source text imports, wherever in the text; relative imports resolved.

    A name out of a module counts as ``module.name``: ``from drillctl import kmd`` and
    ``from drillctl.execution import fastforward`` each import a module.
    """
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            found |= {f"{module}.{alias.name}" for alias in node.names if not alias.name.startswith("__")}
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in DYNAMIC:
            found |= {str(argument.value) for argument in node.args if isinstance(argument, ast.Constant)}
    return {name for name in found if name.split(".")[0] == "drillctl"}


DYNAMIC = ("import_module", "__import__")


def rooms_imported(module: str, source: str, is_package: bool) -> set[str]:
    """The rooms, other than its own, that a module imports."""
    package = module if is_package else module.rpartition(".")[0]
    return {room_of(name) for name in imported_modules(source, package)} - {room_of(module), ""}


def violations(module: str, source: str, is_package: bool = False) -> list[str]:
    own = room_of(module)
    allowed = ROOMS[own] if own else ("api",)  # the package itself gives the public names, and nothing else
    wanted = sorted(rooms_imported(module, source, is_package))
    return [f"{module} (room {own}) imports room {name}" for name in wanted if name not in allowed]


def modules() -> list[tuple[str, Path]]:
    files = sorted(PACKAGE.rglob("*.py"))
    names = [".".join(file.relative_to(ROOT).with_suffix("").parts) for file in files]
    return [(name.removesuffix(".__init__"), file) for name, file in zip(names, files, strict=True)]


@pytest.mark.parametrize(("module", "file"), modules(), ids=lambda value: value if isinstance(value, str) else "")
def test_module_imports_only_what_its_room_may(module: str, file: Path) -> None:
    if module == "drillctl.__main__":
        return
    assert not violations(module, file.read_text("utf-8"), file.name == "__init__.py")


def test_every_room_is_in_the_table_and_every_row_is_a_room() -> None:
    there = {file.stem for file in PACKAGE.glob("*.py")} | {p.parent.name for p in PACKAGE.glob("*/__init__.py")}
    assert there - {"__init__", "__main__"} == {room for room in ROOMS if "." not in room}
    names = {module.removeprefix("drillctl.") for module, _file in modules()}
    assert set(ROOMS) <= names


def test_the_table_is_short() -> None:
    assert len(ROOMS) <= MOST_ROWS


def test_a_room_imports_only_rooms_below_it() -> None:
    order = list(ROOMS)
    assert [(room, name) for room in order for name in ROOMS[room] if order.index(name) <= order.index(room)] == []


@pytest.mark.parametrize("room", ROOMS)
def test_what_a_row_allows_is_used(room: str) -> None:
    used: set[str] = set()
    for module, file in modules():
        if module != "drillctl" and room_of(module) == room:
            used |= rooms_imported(module, file.read_text("utf-8"), file.name == "__init__.py")
    assert set(ROOMS[room]) <= used


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("drillctl.execution.tick", "from drillctl.generation import job"),  # another layer
        ("drillctl.ui.app", "import drillctl.execution.axis"),
        ("drillctl.execution.tick", "from drillctl.execution.fastforward import engine"),  # a room within the own one
        ("drillctl.execution.tick", "from drillctl.execution import fastforward"),
        ("drillctl.execution.tick", "from .fastforward.engine import run"),
        ("drillctl.portio.registry", "from drillctl.portio.simulated import SimulatedCard"),
        ("drillctl.ui.widgets.keys", "from drillctl.ui.app import Program"),  # the room around the own one
        ("drillctl.ui.models.viewport", "from drillctl.ui.screens import scope"),  # a room beside it
        ("drillctl.portio.playback", "from drillctl.plant import IdealPlant"),  # a neighbour's right is not its own
        ("drillctl.portio.playback", "from drillctl.plant.ideal import IdealPlant"),
        ("drillctl.plant.ideal", "def f():\n    from drillctl.kmd import Queue"),  # within a function
        ("drillctl.plant.ideal", "if TYPE_CHECKING:\n    from drillctl.kmd import Queue"),
        ("drillctl.trace.record", "from ..machine import Machine"),  # relative
        ("drillctl.trace.record", "from .. import machine"),
        ("drillctl.kmd.text", "from drillctl import viewmodel"),
        ("drillctl.kmd.text", 'importlib.import_module("drillctl.viewmodel.words")'),  # by its name
        ("drillctl.kmd.text", '__import__("drillctl.viewmodel")'),
        ("drillctl.kmd.text", "import drillctl.viewmodel as p, os"),
        ("drillctl", "from drillctl.kmd import Queue"),
    ],
)
def test_a_planted_violation_is_seen(module: str, source: str) -> None:
    assert violations(module, source, is_package=module == "drillctl")


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("drillctl.portio.simulated", "from drillctl.plant import IdealPlant"),
        ("drillctl.execution.tick", "from drillctl.execution.axis import Axis"),
        ("drillctl.execution.fastforward.engine", "from drillctl.execution import Controller"),
        ("drillctl.kmd.text", "import os, json.decoder"),
    ],
)
def test_what_is_allowed_is_no_violation(module: str, source: str) -> None:
    assert not violations(module, source)


def test_layers_never_import_each_other() -> None:
    """The wall that matters most, written out: nobody above the queue sees below it."""
    layers = {"ui", "generation", "execution", "portio"}
    inside = {room: {name.split(".")[0] for name in ROOMS[room]} for room in ROOMS if room.split(".")[0] in layers}
    assert {
        room: above & layers - {room.split(".")[0]}
        for room, above in inside.items()
        if above & layers - {room.split(".")[0]}
    } == {}
