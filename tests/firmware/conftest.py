"""The simulator's host, compiled once for all tests."""

from pathlib import Path

import pytest

from tests.firmware import board


@pytest.fixture(scope="session")
def host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return board.build(tmp_path_factory.mktemp("host"))
