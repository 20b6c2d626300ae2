"""Keys while a job runs, on a pseudo-terminal: what they ask for, and that the terminal is given back on every way out.

The keys belong to a program of a few lines that prints what it is asked, begun by a shell of a few lines: that only
brings it to the foreground again after Ctrl-Z, and leaves the terminal's mode alone.
"""

import os
import pty
import signal
import sys
import termios
import time
from collections.abc import Callable, Iterator
from contextlib import suppress

import pytest

pytestmark = pytest.mark.paced

PATIENCE_S = 10.0
PROGRAM = """
import signal, sys, time
from drillctl.jobs.keys import TerminalKeys
held = False
with TerminalKeys(sys.stdin) as keys:
    keys.requests(held)
    print("ready", flush=True)
    ends_s = time.monotonic() + 60  # it is in a group of its own, which a closed terminal may not reach
    while time.monotonic() < ends_s:
        for request in keys.requests(held):
            if request.name in ("HOLD", "RESUME"):
                held = request.name == "HOLD"
                print("held" if held else "not held", flush=True)
                continue
            print(request.name, flush=True)
            if request.name == "ESTOP":
                raise RuntimeError("as an error of ours")
        if keys.entered():
            print("entered", flush=True)
"""
SHELL = """
import os, signal, sys
pid = os.fork()
if pid == 0:
    os.setpgid(0, 0)
    os.tcsetpgrp(0, os.getpid())  # allowed: SIGTTOU is ignored
    signal.signal(signal.SIGTTOU, signal.SIG_DFL)
    os.execv(sys.executable, [sys.executable, "-c", sys.argv[1]])
while True:
    _, status = os.waitpid(pid, os.WUNTRACED)
    os.tcsetpgrp(0, os.getpgrp())
    if not os.WIFSTOPPED(status):
        break
    print("suspended", flush=True)
    in_foreground = sys.stdin.readline() != "bg\\n"
    if in_foreground:
        os.tcsetpgrp(0, pid)
    os.kill(pid, signal.SIGCONT)
    print("continued", flush=True)
    if not in_foreground:
        sys.stdin.readline()
        os.tcsetpgrp(0, pid)
print("ended", os.waitstatus_to_exitcode(status), flush=True)
"""


class Line:
    """A terminal with the shell on it."""

    def __init__(self) -> None:
        self._told = ""
        self._pid, self._line = pty.fork()
        if not self._pid:
            signal.signal(signal.SIGTTOU, signal.SIG_IGN)
            os.execv(sys.executable, [sys.executable, "-c", SHELL, PROGRAM])
        os.set_blocking(self._line, False)
        self.mode = termios.tcgetattr(self._line)

    def type(self, keys: str) -> None:
        os.write(self._line, keys.encode())

    def wait_for(self, word: str) -> None:
        """Until it was printed; what came before it is forgotten."""

        def came() -> bool:
            with suppress(OSError):  # nothing yet, or the end
                self._told += os.read(self._line, 4096).decode()
            return word in self._told

        self.until(came, word)
        self._told = self._told.partition(word)[2]

    def until(self, holds: Callable[[], bool], what: str) -> None:
        ends_s = time.monotonic() + PATIENCE_S
        while not holds():
            assert time.monotonic() < ends_s, f"never {what}: {self._told}"
            time.sleep(0.01)

    def has_its_own_mode(self) -> bool:
        return termios.tcgetattr(self._line) == self.mode

    def gives_keys(self) -> bool:
        flags = termios.tcgetattr(self._line)[3]
        return not flags & (termios.ICANON | termios.ECHO) and bool(flags & termios.ISIG)

    def close(self) -> None:
        """A closed terminal ends whoever is on it."""
        os.close(self._line)
        os.kill(self._pid, signal.SIGKILL)
        os.waitpid(self._pid, 0)


@pytest.fixture
def line() -> Iterator[Line]:
    opened = Line()
    try:
        opened.wait_for("ready")
        assert opened.gives_keys()
        yield opened
    finally:
        opened.close()


def test_keys_are_requests(line: Line) -> None:
    line.type(" ")
    line.wait_for("held")
    line.type("x")
    line.wait_for("STOP")
    line.type(" ?Xq")
    line.wait_for("not held")
    line.type("\r")
    line.wait_for("entered")
    line.type("!")
    line.wait_for("ESTOP")


@pytest.mark.parametrize(
    ("key", "code"),
    [("!", "1"), ("\x03", str(-signal.SIGINT)), ("\x1c", str(-signal.SIGQUIT))],
    ids=["an error", "Ctrl-C", "Ctrl-backslash"],
)
def test_the_terminal_is_as_it_was_at_the_end(key: str, code: str, line: Line) -> None:
    line.type(key)
    line.wait_for(f"ended {code}")
    assert line.has_its_own_mode()


def test_ctrl_z_gives_the_terminal_back_and_the_foreground_takes_it_again(line: Line) -> None:
    for _ in range(2):
        line.type("\x1a")
        line.wait_for("suspended")
        assert line.has_its_own_mode()
        line.type("fg\n")
        line.wait_for("continued")
        line.until(line.gives_keys, "keys again")
    line.type(" ")
    line.wait_for("held")


def test_in_the_background_the_keys_are_the_shells(line: Line) -> None:
    line.type("\x1a")
    line.wait_for("suspended")
    line.type("bg\n")
    line.wait_for("continued")
    time.sleep(0.3)
    assert line.has_its_own_mode()
    line.type("fg, and nothing of this is a key: ! x\n")
    line.until(line.gives_keys, "keys again")
    line.type(" ")
    line.wait_for("held")


def test_a_shell_that_took_the_terminal_unasked_gives_it_back(line: Line) -> None:
    """After SIGSTOP, which can't be foreseen, some shells set the mode that they want."""
    mode = line.mode
    termios.tcsetattr(line._line, termios.TCSANOW, mode)
    line.until(line.gives_keys, "keys again")
    line.type("\x03")
    line.wait_for(f"ended {-signal.SIGINT}")
    assert line.has_its_own_mode()
