"""The operator's keys while a job runs: Space holds it and lets it go on, x stops it, ! is an emergency stop.

Rule: never waits longer than a moment. The terminal gives single keys only while this program is in its foreground,
and is as it was on every way out: at the end, by an exception, before Ctrl-Z and Ctrl-\\ do what they do. A kill alone
can't be foreseen. Opened by the verbs, asked by desk at every turn.
"""

import os
import select
import signal
import termios
import time
from types import FrameType, TracebackType
from typing import Any, TextIO

from drillctl.kmd import Request

HELP = "keys: Space holds the job and lets it go on, x stops it, ! is an emergency stop"
HOLD, ENTER = " ", "\n"
REQUESTS = {"x": Request.STOP, "!": Request.ESTOP}
HANDED_ON = (signal.SIGTSTP, signal.SIGQUIT)  # nobody else in this program catches them
MOMENT_S = 0.05  # well below the silence that the ticker bears
MOST_KEYS = 64  # read at once
INPUT_FLAGS, LOCAL_FLAGS, CHARACTERS = 0, 3, 6  # where termios has them


class TerminalKeys:
    """A desk.Operator at a terminal. As a context manager it takes the single keys, and gives them back.

    held  whether the machine is to be held: turned over by each Space
    """

    def __init__(self, keyboard: TextIO):
        self._keyboard = keyboard.fileno()
        self.held = False
        self._asked: list[Request] = []
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

    def requests(self) -> list[Request]:
        """Stops and emergency stops, as often as they were asked for since the last call."""
        self._look(0.0)
        asked, self._asked = self._asked, []
        return asked

    def entered(self) -> bool:
        """Whether Enter was pressed since the last call; waits a moment for it."""
        self._look(MOMENT_S)
        entered, self._entered = self._entered, False
        return entered

    def _look(self, wait_s: float) -> None:
        for key in self._typed(wait_s):
            if key == HOLD:
                self.held = not self.held
            elif key == ENTER:
                self._entered = True
            elif key in REQUESTS:
                self._asked.append(REQUESTS[key])

    def _typed(self, wait_s: float) -> str:
        """The keys that came. A program in the background that reads its terminal is stopped, so it doesn't."""
        if not self._in_foreground():
            time.sleep(wait_s)
            return ""
        try:
            self._take()
            ready, _, _ = select.select([self._keyboard], [], [], wait_s)
            return os.read(self._keyboard, MOST_KEYS).decode("latin-1") if ready else ""
        except (OSError, termios.error):  # the terminal was closed: SIGHUP tells
            return ""

    def _in_foreground(self) -> bool:
        try:
            return os.tcgetpgrp(self._keyboard) == os.getpgrp()
        except OSError:
            return False

    def _take(self) -> None:
        """Single keys, not shown; again after a shell has had the terminal meanwhile. Ctrl-S is a key like any other:
        a terminal that stands still would silence the desk, and so hold the machine.
        """
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
            termios.tcsetattr(self._keyboard, termios.TCSANOW, before)

    def _hand_on(self, number: int, frame: FrameType | None) -> None:
        """The signal does what it did before us; where it only suspends, the next look takes the keys again."""
        self._give_back()
        signal.signal(number, self._handlers[number])
        os.kill(os.getpid(), number)
        signal.signal(number, self._hand_on)


def has_keys(keyboard: TextIO) -> bool:
    """Whether somebody may sit there: a terminal, and this process in its session."""
    try:
        return keyboard.isatty() and os.tcgetpgrp(keyboard.fileno()) > 0
    except OSError:
        return False
