"""A job on its way: a bar with the time left on a terminal, a plain line now and then in a pipe.

Rule: writes to one stream, never to standard output. Called by the run verb for every Progress.
"""

import time
from types import TracebackType
from typing import TextIO

from tqdm import tqdm

from drillctl.panel import Progress

PLAIN_EVERY_S = 10.0
BAR = "{desc} {bar} {n_fmt}/{total_fmt}{postfix}"


class ProgressView:
    """Shows Progress records as they come. Use as a context manager, so that the bar is closed on every way out."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self._bar = tqdm(file=stream, bar_format=BAR, leave=False, desc="drilling") if stream.isatty() else None
        self._next_plain_s = time.monotonic() + PLAIN_EVERY_S

    def __enter__(self) -> "ProgressView":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.close()

    def show(self, progress: Progress) -> None:
        """The newest record; drawn as often as a person can read it."""
        if self._bar is not None:
            self._bar.total = progress.holes_total
            self._bar.set_postfix_str(_left(progress), refresh=False)
            self._bar.update(progress.holes_done - self._bar.n)
        elif time.monotonic() >= self._next_plain_s:
            self._next_plain_s = time.monotonic() + PLAIN_EVERY_S
            print(_line(progress), file=self._stream, flush=True)


def clock(seconds: float) -> str:
    """``1:02:03`` or ``2:03``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def _left(progress: Progress) -> str:
    tool = f"tool {progress.tool}, " if progress.tool else ""
    left = "" if progress.seconds_left is None else f", {clock(progress.seconds_left)} left"
    return f"{tool}machine time {clock(progress.machine_seconds)}{left}"


def _line(progress: Progress) -> str:
    return f"drilling: {progress.holes_done} of {progress.holes_total} holes, {_left(progress)}"
