"""A forked process: started, watched, and ended by its id.

Rule: a child runs its body and nothing else of this program, in a session of its own: the signals of a terminal
(Ctrl-C, Ctrl-\\, Ctrl-Z) reach the parent alone, which decides what comes of them.
"""

import os
import signal
import sys
import time
import traceback
from collections.abc import Callable

LOOK_EVERY_S = 0.002


class ChildProcess:
    """A process that runs ``body``, started when this is made. Raises OSError where the system grants no more."""

    def __init__(self, body: Callable[[], None]):
        sys.stdout.flush()
        sys.stderr.flush()
        self.pid = os.fork()
        self._gone = False
        if self.pid == 0:
            _run(body)

    @property
    def gone(self) -> bool:
        """Whether the process has ended; then also reaps it."""
        if not self._gone:
            self._gone = os.waitpid(self.pid, os.WNOHANG) != (0, 0)
        return self._gone

    def end(self, patience_s: float, meanwhile: Callable[[], object] = lambda: None) -> None:
        """Waits until it has ended, calling ``meanwhile`` over and over; kills it after ``patience_s``."""
        until_s = time.monotonic() + patience_s
        while not self.gone:
            if time.monotonic() > until_s:
                os.kill(self.pid, signal.SIGKILL)
            meanwhile()
            time.sleep(LOOK_EVERY_S)


def _run(body: Callable[[], None]) -> None:
    """What the child does from the fork to its exit."""
    code = 1
    try:
        os.setsid()
        body()
        code = 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code)
