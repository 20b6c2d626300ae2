"""No test reads or writes what the person who runs it keeps: journals, recent jobs, tables of one's own; and none fails
because the computer is busy, or because the catalogues were changed and not compiled yet.
"""

import os
import runpy
import signal
from pathlib import Path

import pytest
from hypothesis import settings

# A shell starts what runs in the background with these two ignored, and the programs under test would inherit that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if signal.getsignal(signal.SIGQUIT) is signal.SIG_IGN:
    signal.signal(signal.SIGQUIT, signal.SIG_DFL)

# The program is started hundreds of times; without kept bytecode each start compiles every module anew.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

ROOT = Path(__file__).resolve().parents[1]


def pytest_configure(config: pytest.Config) -> None:
    """Compiles the catalogues from their present sources, in the process that starts the others."""
    if not hasattr(config, "workerinput"):
        runpy.run_path(str(ROOT / "hatch_build.py"))["compiled_catalogues"](ROOT)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Marks what goes by the clock to be tried three times: a computer that gives the ticker no time makes a fault."""
    for item in items:
        if item.get_closest_marker("paced"):
            item.add_marker(pytest.mark.flaky(reruns=2, reruns_delay=1))


settings.register_profile("any computer", deadline=None)
settings.load_profile("any computer")


@pytest.fixture(autouse=True)
def own_folders(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty state and configuration folders."""
    folder = tmp_path_factory.mktemp("user")
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(folder / "config"))
    return folder
