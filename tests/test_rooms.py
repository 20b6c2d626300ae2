"""The walls of the house: which room imports which. The table is the one in docs/ARCHITECTURE.md."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "drillctl"


def rooms_table() -> dict[str, set[str]]:
    """The Markdown table under "## Rooms": room -> rooms that it may import."""
    text = (ROOT / "docs" / "ARCHITECTURE.md").read_text("utf-8")
    section = text.split("## Rooms")[1].split("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return {room: set(filter(None, re.split(r",\s*", allowed))) for room, _, allowed in rows[2:]}


def room_of(module: str, rooms: set[str]) -> str:
    """``drillctl.portio.simulated`` is a room of its own, ``drillctl.portio.playback`` is in ``portio``."""
    parts = module.split(".")[1:]
    names = [".".join(parts[:length]) for length in range(len(parts), 0, -1)]
    return next((name for name in names if name in rooms), names[-1] if names else "")


def imported_modules(source: str, package: str) -> set[str]:
    """Every drillctl module that a source text imports, wherever in the text; relative imports resolved."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            names = [alias.name for alias in node.names if not alias.name.startswith("__")]
            found |= {f"{module}.{name}" if module == "drillctl" else module for name in names}
    return {name for name in found if name.split(".")[0] == "drillctl"}


def violations(module: str, source: str, is_package: bool, rooms: dict[str, set[str]]) -> list[str]:
    package = module if is_package else module.rpartition(".")[0]
    own = room_of(module, set(rooms))
    if not own:  # the map imports nothing
        return [f"{module} imports {name}" for name in imported_modules(source, package)]
    wanted = {room_of(name, set(rooms)) for name in imported_modules(source, package)} - {own, ""}
    allowed = rooms[own]
    return [
        f"{module} (room {own}) imports room {name}"
        for name in sorted(wanted)
        if name not in allowed and name.split(".")[0] not in allowed | {own}
    ]


def modules() -> list[tuple[str, Path]]:
    files = sorted(PACKAGE.rglob("*.py"))
    names = [".".join(file.relative_to(ROOT).with_suffix("").parts) for file in files]
    return [(name.removesuffix(".__init__"), file) for name, file in zip(names, files, strict=True)]


@pytest.mark.parametrize(("module", "file"), modules(), ids=lambda value: value if isinstance(value, str) else "")
def test_module_imports_only_what_its_room_may(module: str, file: Path) -> None:
    if module == "drillctl.__main__":
        return
    assert not violations(module, file.read_text("utf-8"), file.name == "__init__.py", rooms_table())


def test_every_room_is_in_the_table_and_every_row_is_a_room() -> None:
    rooms = rooms_table()
    there = {file.stem for file in PACKAGE.glob("*.py")} | {p.parent.name for p in PACKAGE.glob("*/__init__.py")}
    assert there - {"__init__", "__main__"} == {room for room in rooms if "." not in room}


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("drillctl.execution.tick", "from drillctl.generation import job"),
        ("drillctl.ui.progress", "import drillctl.execution.axis"),
        ("drillctl.portio.playback", "from drillctl.plant import IdealPlant"),
        ("drillctl.plant.ideal", "def f():\n    from drillctl.kmd import Queue"),
        ("drillctl.trace.record", "from ..machine import Machine"),
        ("drillctl.kmd.text", "from drillctl import panel"),
        ("drillctl", "from drillctl.kmd import Queue"),
    ],
)
def test_a_planted_violation_is_seen(module: str, source: str) -> None:
    is_package = module == "drillctl"
    assert violations(module, source, is_package, rooms_table())


def test_what_is_allowed_is_no_violation() -> None:
    rooms = rooms_table()
    assert not violations("drillctl.portio.simulated", "from drillctl.plant import IdealPlant", False, rooms)
    assert not violations("drillctl.execution.tick", "from drillctl.execution.guard import guard", False, rooms)


def test_nobody_above_the_queue_sees_below_it() -> None:
    """The wall that matters most, written out: layers never import each other."""
    rooms = rooms_table()
    layers = {"ui", "generation", "execution", "portio"}
    assert all(not rooms[layer] & layers for layer in layers)
