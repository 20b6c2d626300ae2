"""No test reads or writes what the person who runs it keeps: journals, recent jobs, tables of one's own; and none fails
because the computer is busy.
"""

from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("any computer", deadline=None)
settings.load_profile("any computer")


@pytest.fixture(autouse=True)
def own_folders(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty state and configuration folders."""
    folder = tmp_path_factory.mktemp("user")
    monkeypatch.setenv("XDG_STATE_HOME", str(folder / "state"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(folder / "config"))
    return folder
