"""The real program on a pseudo-terminal: keys go in, and what it draws is kept as a screen of cells by pyte.

Rule: nothing waits for a time, everything for what the screen shows, and every wait ends. Used by tests/ui, by the
pictures in docs and by the screen's benchmark.
"""

import fcntl
import os
import pty
import select
import signal
import struct
import sys
import termios
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

import pyte

PATIENCE_S = 40.0
FRAME = b"\x1b[?25l"  # urwid hides the cursor at the beginning of each
QUIET_S = 0.5  # a screen that has not changed for so long is taken as finished: ten beats of the program
KEYS = {
    "Ctrl-U": "\x15",
    "Enter": "\r", "Esc": "\x1b", "Tab": "\t", "Backspace": "\x7f", "Up": "\x1b[A", "Down": "\x1b[B",
    "Right": "\x1b[C", "Left": "\x1b[D", "Home": "\x1b[H", "End": "\x1b[F", "PgUp": "\x1b[5~", "PgDn": "\x1b[6~",
    "F1": "\x1bOP", "F2": "\x1bOQ", "F3": "\x1bOR", "F4": "\x1bOS", "F5": "\x1b[15~", "F6": "\x1b[17~",
    "F7": "\x1b[18~", "F8": "\x1b[19~", "F9": "\x1b[20~", "F10": "\x1b[21~", "Del": "\x1b[3~",
}  # fmt: skip


class Act(NamedTuple):
    """Keys by their names (of KEYS, or as typed); what the screen shows after them, and shows no more."""

    keys: tuple[str, ...]
    shows: tuple[str, ...]
    gone: tuple[str, ...] = ()


class Terminal:
    """``drillctl ARGUMENTS`` in a folder that is its home too, on a terminal of ``size`` columns and rows, of sixteen
    colours or of 24 bits of them.
    """

    def __init__(
        self, *arguments: str, folder: Path, size: tuple[int, int] = (80, 24), true_colours: bool = False
    ):  # fmt: skip
        columns, rows = size
        self.screen = pyte.Screen(columns, rows)
        self._stream = pyte.ByteStream(self.screen)
        self.begun_s = time.monotonic()
        self._code: int | None = None
        self.pid, self._line = pty.fork()
        if not self.pid:
            fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
            os.chdir(folder)
            surroundings = _surroundings(folder, true_colours)
            os.execve(sys.executable, [sys.executable, "-m", "drillctl", *arguments], surroundings)

    @property
    def text(self) -> str:
        """The screen, row by row."""
        return "\n".join(self.screen.display)

    def press(self, *keys: str) -> None:
        """Names of KEYS, or text as it is typed. A lone Esc is one only if nothing follows it at once."""
        os.write(self._line, "".join(KEYS.get(key, key) for key in keys).encode())

    def play(self, acts: Iterable[Act]) -> None:
        """One after the other."""
        for act in acts:
            self.press(*act.keys)
            self.wait_for(*act.shows, gone=act.gone)

    def wait_for(self, *told: str, gone: tuple[str, ...] = ()) -> None:
        """Until all of this is on the screen and none of that; fails at once where the program has ended."""

        def shown() -> bool:
            return all(part in self.text for part in told) and not any(part in self.text for part in gone)

        self.until(lambda: shown() or self._ended(), f"{told} never came")
        assert shown(), f"it ended before {told} came:\n{self.text}"

    def until(self, holds: Callable[[], bool], otherwise: str) -> None:
        """Reads on until something holds; fails with the screen as it is then."""
        until_s = time.monotonic() + PATIENCE_S
        while not holds():
            assert time.monotonic() < until_s, f"{otherwise}:\n{self.text}"
            self._read(0.05)

    def settle(self) -> None:
        """Until nothing more is drawn."""
        until_s = time.monotonic() + PATIENCE_S
        before = ""
        while (now := self.text) != before:
            assert time.monotonic() < until_s, f"it never comes to rest:\n{self.text}"
            before = now
            self._read(QUIET_S)

    def frames(self, seconds: float) -> int:
        """Reads for so long; how many frames the program drew."""
        came = self.collected(seconds)
        self.show(came)
        return came.count(FRAME)

    def collected(self, seconds: float) -> bytes:
        """What comes within this time. Not drawn here meanwhile, which would take time from the program."""
        until_s = time.monotonic() + seconds
        came = []
        while (left_s := until_s - time.monotonic()) > 0:
            if select.select([self._line], [], [], left_s)[0]:
                came.append(os.read(self._line, 65536))
        return b"".join(came)

    def show(self, came: bytes) -> None:
        """Draws what was collected."""
        self._stream.feed(came)

    def exit_code(self) -> int:
        """Waits for the end, and says how it was: below zero by a signal."""
        self.until(self._ended, "it never ended")
        return self._code

    def close(self) -> None:
        """Ends what has not ended: as if the terminal were closed, and by force where that does not help."""
        if not self._ended():
            os.kill(self.pid, signal.SIGHUP)
            try:
                self.exit_code()
            except AssertionError:
                os.kill(self.pid, signal.SIGKILL)
                os.waitpid(self.pid, 0)
                raise
            finally:
                os.close(self._line)

    def _ended(self) -> bool:
        if self._code is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            self._code = os.waitstatus_to_exitcode(status) if pid else None
        return self._code is not None

    def _read(self, patience_s: float) -> bool:
        """What comes within this time, and whatever follows at once; whether anything came."""
        came = False
        while select.select([self._line], [], [], patience_s)[0]:
            try:
                self._stream.feed(os.read(self._line, 65536))
            except OSError:  # the program has gone
                return came
            came, patience_s = True, 0.0
        return came


def _surroundings(home: Path, true_colours: bool) -> dict[str, str]:
    """Nothing of the user's: tables, lists, language and colours are the folder's own."""
    of_the_user = ("XDG_", "LC_", "LANG", "COLORTERM", "NO_COLOR")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(of_the_user)}
    colours = {"TERM": "xterm-256color", "COLORTERM": "truecolor"} if true_colours else {"TERM": "xterm"}
    return {**kept, **colours, "HOME": str(home), "LANG": "C.UTF-8"}
