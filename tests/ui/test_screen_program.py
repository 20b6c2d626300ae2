"""The real program on a pseudo-terminal: open a file, initialise, go over the board dry, and leave."""

import os
import shutil
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytestmark = pytest.mark.paced

terminals = pytest.importorskip("tests.support.terminal", reason="pyte (the dev extra) reads what the program draws")

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"


@pytest.fixture(params=["real"])
def terminal(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator["terminals.Terminal"]:
    shutil.copy(BLINKER, tmp_path)
    made = terminals.Terminal("--pace", request.param, "--lang", "en", folder=tmp_path, size=(100, 40))
    yield made
    made.close()


@pytest.mark.parametrize("terminal", ["free"], indirect=True)
def test_a_board_is_gone_over_dry(terminal: "terminals.Terminal") -> None:
    terminal.wait_for("Files  Drilling  Tests  Configuration", "No board is loaded", "E-STOP", "position not known")
    terminal.press("f")
    terminal.wait_for("blinker.drl")
    terminal.press("Down", "Enter")
    terminal.wait_for("26 holes, 33.00 x 20.00 mm", "T3", "Estimate")
    terminal.press("Esc")
    terminal.wait_for("jog step")
    terminal.press("i")
    terminal.wait_for("at rest | position known")
    terminal.settle()
    terminal.press("d")
    terminal.wait_for("26 done", "at rest")
    terminal.press("F4")
    assert terminal.exit_code() == 0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_leaves_cleanly(terminal: "terminals.Terminal", number: signal.Signals) -> None:
    terminal.wait_for("No board is loaded")
    os.kill(terminal.pid, number)
    assert terminal.exit_code() == 128 + number


def test_a_terminal_that_takes_no_utf8_has_a_screen_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    made = terminals.Terminal("--lang", "pl", folder=tmp_path, size=(80, 24))
    try:
        made.wait_for("Nie wczytano plytki")
        made.press("F1")
        made.wait_for("wierci plytke; najpierw pyta")
    finally:
        made.close()
