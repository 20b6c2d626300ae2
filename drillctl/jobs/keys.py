"""The operator's keys while a job runs: Space holds it and lets it go on, x stops it, ! is an emergency stop.

Rule: reading keys waits for MOMENT_S at most. The terminal's mode is changed only while this program is in its
foreground, and given back on every way out: at the end, by an exception, before Ctrl-Z and Ctrl-\\ act. Only SIGKILL
leaves it changed.
"""

import os
import select
import signal
import time
from types import FrameType, TracebackType
from typing import Any, TextIO

from drillctl.files import system
from drillctl.kmd import Request

HELP = "keys: Space holds the job and lets it go on, x stops it, ! is an emergency stop"
HOLD_OR_RESUME, ENTER = " ", "\n"
REQUESTS = {"x": Request.STOP, "!": Request.ESTOP}
HANDED_ON = system.signals("SIGTSTP", "SIGQUIT")  # nobody else in this program catches them
MOMENT_S = 0.05  # well below the silence that the ticker bears
MOST_KEYS = 64  # read at once
INPUT_FLAGS, LOCAL_FLAGS, CHARACTERS = 0, 3, 6  # where termios has them


class TerminalKeys:
    """An Operator (jobs/operator.py) at a terminal. As a context manager it changes the terminal to single keys, and
    gives its mode back.
    """

    def __init__(self, keyboard: TextIO):
        self._keyboard = keyboard.fileno()
        self._keys: list[str] = []  # pressed since the last ``requests``
        self._entered = False
        self._before: list[Any] | None = None  # the terminal's mode, while it has ours
        self._ours: list[Any] = []
        self._handlers: dict[int, Any] = {}

    def __enter__(self) -> "TerminalKeys":
        self._handlers = {number: signal.signal(number, self._hand_on) for number in HANDED_ON}
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._give_back()
        for number, handler in self._handlers.items():
            signal.signal(number, handler)

    def requests(self, held: bool) -> list[Request]:
        """The requests of all keys pressed since the last call. Space resumes a job that is ``held``, else holds it."""
        self._look(0.0)
        keys, self._keys = self._keys, []
        found = []
        for key in keys:
            if key == HOLD_OR_RESUME:
                held = not held
                found.append(Request.HOLD if held else Request.RESUME)
            else:
                found.append(REQUESTS[key])
        return found

    def entered(self) -> bool:
        """Whether Enter was pressed since the last call; waits a moment for it."""
        self._look(MOMENT_S)
        entered, self._entered = self._entered, False
        return entered

    def _look(self, wait_s: float) -> None:
        for key in self._typed(wait_s):
            if key == ENTER:
                self._entered = True
            elif key == HOLD_OR_RESUME or key in REQUESTS:
                self._keys.append(key)

    def _typed(self, wait_s: float) -> str:
        """The keys pressed, waiting so long for one. In the background none are read: that would stop this program."""
        if not self._in_foreground():
            time.sleep(wait_s)
            return ""
        try:
            self._take()
            ready, _, _ = select.select([self._keyboard], [], [], wait_s)
            return os.read(self._keyboard, MOST_KEYS).decode("latin-1") if ready else ""
        except system.TERMINAL_ERRORS:  # the terminal was closed: SIGHUP tells
            return ""

    def _in_foreground(self) -> bool:
        try:
            return os.tcgetpgrp(self._keyboard) == os.getpgrp()
        except OSError:
            return False

    def _take(self) -> None:
        """Single keys, not shown; again after a shell has had the terminal meanwhile. Ctrl-S is a key like any other:
        a terminal that it stops would stop this process too, and the ticker would hold the machine.
        """
        termios = system.terminal()
        mode = termios.tcgetattr(self._keyboard)
        if mode == self._ours:
            return
        self._before = mode
        ours = [*mode[:CHARACTERS], list(mode[CHARACTERS])]
        ours[INPUT_FLAGS] &= ~termios.IXON
        ours[LOCAL_FLAGS] &= ~(termios.ICANON | termios.ECHO)
        ours[CHARACTERS][termios.VMIN], ours[CHARACTERS][termios.VTIME] = 1, 0
        termios.tcsetattr(self._keyboard, termios.TCSANOW, ours)
        self._ours = termios.tcgetattr(self._keyboard)

    def _give_back(self) -> None:
        before, self._before, self._ours = self._before, None, []
        if before is not None and self._in_foreground():
            termios = system.terminal()
            termios.tcsetattr(self._keyboard, termios.TCSANOW, before)

    def _hand_on(self, number: int, frame: FrameType | None) -> None:
        """A handler: gives the terminal back and lets the signal act as it did before; where it only suspends, the next
        look at the keys changes the mode again.
        """
        self._give_back()
        signal.signal(number, self._handlers[number])
        os.kill(os.getpid(), number)
        signal.signal(number, self._hand_on)


def has_keys(keyboard: TextIO) -> bool:
    """Whether an operator can press keys there: it is a terminal, and this process belongs to its session."""
    try:
        return keyboard.isatty() and os.tcgetpgrp(keyboard.fileno()) > 0
    except OSError:
        return False
