"""``drillctl scope`` on a pseudo-terminal, and refused where there is none."""

import sys
from pathlib import Path

import pytest

from drillctl.cli import main

pytest.importorskip("pyte", reason="pyte (the dev extra) reads what the program draws")
from tests.support.terminal import Terminal

pytestmark = pytest.mark.paced

SQUARE = Path(__file__).resolve().parents[2] / "examples" / "square.kmd"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
def test_a_trace_is_looked_through_and_then_the_machines_own_run(tmp_path: Path) -> None:
    assert main(["run", str(SQUARE), "--trace", str(tmp_path / "square.trace")]) == 0
    terminal = Terminal("scope", "square.trace", "--lang", "en", "--tick-hz", "5000", folder=tmp_path)
    try:
        terminal.wait_for("square.trace (pcb-drill)", "1 KMD_INICJALIZACJA", "x.position", "at cursor")
        terminal.until(lambda: "being found" not in terminal.text, "the columns were never found")
        terminal.press("Tab", "Tab", "n")
        terminal.wait_for("2 KMD_GOTO_X_Y 600 600", ">command")
        terminal.press("F6")
        terminal.wait_for("the machine's own run")
        terminal.press("1")
        terminal.wait_for("Nothing was run yet.")
        terminal.press("Esc")
        terminal.wait_for("Command")
        terminal.press("i")
        terminal.wait_for("position known")
        terminal.press("F9", "Right", "Right")
        terminal.wait_for("Queue of commands")
        terminal.press("c", "t")
        terminal.wait_for("KMD_INICJALIZACJA", "following", "5000 Hz")
        terminal.press("F4")
        assert terminal.exit_code() == 0
    finally:
        terminal.close()


def test_without_a_terminal_it_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scope", str(tmp_path / "none.trace")]) == 2
    assert "needs a terminal" in capsys.readouterr().err


def test_a_file_that_is_no_trace_is_refused_before_anything_is_drawn(tmp_path: Path) -> None:
    (tmp_path / "bad.trace").write_text("hello\n")
    terminal = Terminal("scope", "bad.trace", folder=tmp_path)
    try:
        terminal.until(lambda: "bad.trace:1: not a trace" in terminal.text, "no reason was given")
        assert terminal.exit_code() == 2
    finally:
        terminal.close()
