"""A folder with the board that journal and resume are tried with; the tests run in it."""

from pathlib import Path

import pytest

from tests.support.journalled import BOARD


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "job.drl").write_text(BOARD)
    monkeypatch.chdir(tmp_path)
    return tmp_path
