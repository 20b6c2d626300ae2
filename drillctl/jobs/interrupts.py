"""What Ctrl-C, SIGTERM and SIGHUP do, and the exit code after them.

Rule: within a job they ask the machine to stop; anywhere else they end the verb by an exception, so that every
``finally`` on the way out is run.
"""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from drillctl.files import system

CAUGHT = system.signals("SIGINT", "SIGTERM", "SIGHUP")
Handler = Callable[[int, FrameType | None], None]


@contextmanager
def caught(handler: Handler) -> Iterator[None]:
    """Within it the signals of CAUGHT go to ``handler``, afterwards to what they went to before. In another thread
    than the main one, where Python allows no handler, they go where they went before.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    previous = {number: signal.signal(number, handler) for number in CAUGHT}
    try:
        yield
    finally:
        for number, before in previous.items():
            signal.signal(number, before)


def leave(number: int, frame: FrameType | None) -> None:
    """A handler: raises KeyboardInterrupt with the signal's number, for ``exit_code``."""
    raise KeyboardInterrupt(number)


@contextmanager
def remembered() -> Iterator[list[int]]:
    """Within it the signals are handled by ``leave``, and put into the list that it yields: a library may swallow the
    exception.
    """
    came: list[int] = []

    def handler(number: int, frame: FrameType | None) -> None:
        came.append(number)
        leave(number, frame)

    with caught(handler):
        try:
            yield came
        except OSError as error:  # a terminal that has gone can't be left as it was found
            if not came:
                raise
            raise KeyboardInterrupt(came[0]) from error


def exit_code(number: int = signal.SIGINT) -> int:
    """130 for Ctrl-C, 143 for SIGTERM, 129 for a closed terminal, as shells have it."""
    return 128 + number
