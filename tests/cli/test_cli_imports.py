"""What a fresh process imports: a command line that is only looked at pays for no array, terminal or serial line."""

import json
import subprocess
import sys

import pytest

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
