"""The line that a person at a terminal sees during a wait of over a second: what is done, and how long it will take.

Rule: written to one stream, only where that is a terminal, and wiped out at the end. A thread draws the line, so a part
that never calls with how far it is (a long file that is read) is shown too.
"""

import time
from threading import Event, Thread
from types import TracebackType
from typing import TextIO

from drillctl.language import Message
from drillctl.ui.widgets.work_part import WorkPart

SHOWN_AFTER_S = 1.0
DRAWN_EVERY_S = 0.2


class Wait:
    """A call begins a part of the work, and returns what is called with how far that is. Used as a context manager."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self._part: WorkPart | None = None
        self._over = Event()
        self._thread = Thread(target=self._draw, daemon=True) if stream.isatty() else None

    def __enter__(self) -> "Wait":
        if self._thread is not None:
            self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        if self._thread is not None:
            self._thread.join()

    def __call__(self, what: Message) -> WorkPart:
        """Begins a part of the work, which ends the part before it."""
        self._part = WorkPart(what)
        return self._part

    def _draw(self) -> None:
        """Until it is over; nothing where that takes less than a second."""
        if self._over.wait(SHOWN_AFTER_S):
            return
        from tqdm import tqdm

        with tqdm(file=self._stream, bar_format="{desc}", leave=False, delay=1e9) as line:
            while not self._over.wait(DRAWN_EVERY_S):
                if self._part is not None:
                    line.set_description_str(self._part.line(time.monotonic()))
            line.clear()

