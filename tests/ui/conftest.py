"""What the tests of the screens share: English to begin with, and a program that does not wait for its console."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from drillctl.language import words
from drillctl.ui import app


@pytest.fixture(autouse=True)
def english() -> Iterator[None]:
    """Whatever a test spoke, the next one begins in English."""
    words.use("en")
    yield
    words.use("en")


@pytest.fixture
def idle(monkeypatch: pytest.MonkeyPatch) -> None:
    """A console without a machine needs no time to get on."""
    monkeypatch.setattr(app, "TURNING_S", 0.0)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with one drill file, which the program is started in."""
    (tmp_path / "four.drl").write_text("M48\nT1C0.8\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path
