"""What a fresh process imports: a command line that is only looked at pays for no array, terminal or serial line."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
PARTS = "import sys, json; print(json.dumps(sorted({name.split('.')[0] for name in sys.modules})))"
SCREEN = "drillctl.cli.screen, drillctl.console.machine_console, drillctl.ui.app"
OF_OTHERS = {"serial", "gpiod", "matplotlib", "PIL", "dask", "hypothesis", "pytest", "multiprocessing", "sqlite3"}


@pytest.mark.parametrize(
    ("modules", "unwanted"),
    [
        ("drillctl.cli", OF_OTHERS | {"numpy", "msgspec", "urwid", "tomlkit", "asyncio"}),
        ("drillctl.cli.ports, drillctl.portio.registry", OF_OTHERS | {"numpy", "urwid", "tomlkit", "asyncio"}),
        (SCREEN, OF_OTHERS | {"tomlkit"}),
    ],
)
def test_a_process_imports_what_it_needs(modules: str, unwanted: set[str]) -> None:
    found = subprocess.run(
        [sys.executable, "-c", f"import {modules}; {PARTS}"], capture_output=True, check=True, timeout=60
    )
    assert not unwanted & set(json.loads(found.stdout))


@pytest.mark.parametrize(
    ("call", "unwanted"),
    [
        (["inspect", "examples/blinker.drl"], {"numpy.ma", "drillctl.execution", "drillctl.portio"}),
        (["run", "examples/blinker.drl", "-q"], {"numpy.ma", "serial", "drillctl.portio.firmata", "drillctl.ui.app"}),
        (["run", "examples/square.kmd", "--plant", "dynamic"], {"numpy.ma", "urwid", "drillctl.plant.dynamic.fleet"}),
    ],
    ids=lambda each: each[0] if isinstance(each, list) else "",
)
def test_a_verb_imports_what_it_needs(call: list[str], unwanted: set[str]) -> None:
    """Half of a short verb's time is imports."""
    code = f"import sys; from drillctl.cli import main; main({call}); print(*sys.modules, file=sys.stderr)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, timeout=60, cwd=TOP)
    assert not unwanted & set(found.stderr.decode().splitlines()[-1].split())
