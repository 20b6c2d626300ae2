"""Processes of ours beside the one that was started: forked, watched and ended by their ids.

Rule: a child runs its body and nothing else of this program, in a session of its own: what a terminal sends to
everybody (Ctrl-C, Ctrl-\\, Ctrl-Z) reaches its parent alone, who decides. Called by paced and lab/latency.
"""

import os
import signal
import sys
import time
import traceback
from collections.abc import Callable

LOOK_EVERY_S = 0.002


class Child:
    """A process of ours, begun here. Raises OSError where the system gives no more."""

    def __init__(self, body: Callable[[], None]):
        sys.stdout.flush()
        sys.stderr.flush()
        self.pid = os.fork()
        self._gone = False
        if self.pid == 0:
            _be(body)

    @property
    def gone(self) -> bool:
        """Whether it has ended; collects it then."""
        if not self._gone:
            self._gone = os.waitpid(self.pid, os.WNOHANG) != (0, 0)
        return self._gone

    def end(self, patience_s: float, meanwhile: Callable[[], object] = lambda: None) -> None:
        """Waits until it has ended, doing ``meanwhile`` now and then; kills it when that takes too long."""
        until_s = time.monotonic() + patience_s
        while not self.gone:
            if time.monotonic() > until_s:
                os.kill(self.pid, signal.SIGKILL)
            meanwhile()
            time.sleep(LOOK_EVERY_S)


def _be(body: Callable[[], None]) -> None:
    """The child's whole life."""
    code = 1
    try:
        os.setsid()
        body()
        code = 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code)
