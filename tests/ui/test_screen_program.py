"""The real program on a pseudo-terminal: open a file, initialise, go over the board dry, and leave."""

import fcntl
import os
import pty
import select
import shutil
import signal
import struct
import sys
import termios
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pyte = pytest.importorskip("pyte", reason="pyte (the dev extra) reads what the program draws")

BLINKER = Path(__file__).resolve().parents[2] / "examples" / "blinker.drl"
COLUMNS, ROWS = 100, 40
PATIENCE_S = 40.0
KEYS = {"F4": "\x1bOS", "Down": "\x1b[B", "Enter": "\r", "Esc": "\x1b"}


class Terminal:
    """A program on a terminal of its own; what it draws is kept as lines."""

    def __init__(self, *arguments: str, folder: Path):
        self._screen = pyte.Screen(COLUMNS, ROWS)
        self._stream = pyte.ByteStream(self._screen)
        self.pid, self._line = pty.fork()
        if not self.pid:
            os.chdir(folder)
            surroundings = {**os.environ, "TERM": "xterm", "LANG": "C.UTF-8", "LC_ALL": "C.UTF-8"}
            os.execve(sys.executable, [sys.executable, "-m", "drillctl", *arguments], surroundings)
        fcntl.ioctl(self._line, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, COLUMNS, 0, 0))

    @property
    def text(self) -> str:
        return "\n".join(self._screen.display)

    def press(self, *keys: str) -> None:
        for key in keys:
            os.write(self._line, KEYS.get(key, key).encode())
            self._read(0.1)

    def wait_for(self, *told: str) -> None:
        until_s = time.monotonic() + PATIENCE_S
        while not all(part in self.text for part in told):
            assert time.monotonic() < until_s, f"{told} never came:\n{self.text}"
            self._read(0.1)

    def exit_code(self) -> int:
        until_s = time.monotonic() + PATIENCE_S
        while time.monotonic() < until_s:
            self._read(0.05)
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self.pid = 0
                return os.waitstatus_to_exitcode(status)
        raise AssertionError(f"it never ended:\n{self.text}")

    def close(self) -> None:
        if self.pid:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self._line)

    def _read(self, patience_s: float) -> None:
        while select.select([self._line], [], [], patience_s)[0]:
            try:
                self._stream.feed(os.read(self._line, 65536))
            except OSError:  # the program has gone
                return
            patience_s = 0.0


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Terminal]:
    shutil.copy(BLINKER, tmp_path)
    made = Terminal("--tick-hz", "20000", "--lang", "en", folder=tmp_path)
    yield made
    made.close()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
def test_a_board_is_gone_over_dry(terminal: Terminal) -> None:
    terminal.wait_for("Files  Drilling  Tests  Configuration", "No board is loaded", "E-STOP", "position not known")
    terminal.press("f")
    terminal.wait_for("blinker.drl")
    terminal.press("Down", "Enter")
    terminal.wait_for("26 holes, 33.00 x 20.00 mm", "T3", "Estimate")
    terminal.press("Esc")
    terminal.wait_for("jog step")
    terminal.press("i")
    terminal.wait_for("at rest | position known")
    terminal.press("d")
    terminal.wait_for("26 done", "at rest")
    terminal.press("F4")
    assert terminal.exit_code() == 0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="real pace needs Linux")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_leaves_cleanly(terminal: Terminal, number: signal.Signals) -> None:
    terminal.wait_for("No board is loaded")
    os.kill(terminal.pid, number)
    assert terminal.exit_code() == 128 + number
