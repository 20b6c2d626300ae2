"""A job on its way: a bar with the time left on a terminal, a plain line now and then in a pipe.

Rule: writes to one stream, never to standard output. Called by the run verb for every Progress.
"""

import time
from types import TracebackType
from typing import TYPE_CHECKING, NoReturn, TextIO

from drillctl.panel import Progress

if TYPE_CHECKING:
    from tqdm import tqdm

PLAIN_EVERY_S = 10.0
DRAWN_EVERY_S = 0.1
BAR = "drilling {bar} {n_fmt}/{total_fmt}{postfix}"


class ProgressView:
    """Shows Progress records as they come. Use as a context manager, so that the bar is closed on every way out."""

    def __init__(self, stream: TextIO):
        self._stream = stream
        self._on_terminal = stream.isatty()
        self._bar: tqdm[NoReturn] | None = None
        self._due_s = 0.0 if self._on_terminal else time.monotonic() + PLAIN_EVERY_S

    def __enter__(self) -> "ProgressView":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.clear()
            self._bar.close()

    def show(self, progress: Progress) -> None:
        """The newest record; drawn as often as a person can read it."""
        now_s = time.monotonic()
        if now_s < self._due_s:
            return
        self._due_s = now_s + (DRAWN_EVERY_S if self._on_terminal else PLAIN_EVERY_S)
        if self._on_terminal:
            self._draw(progress)
        else:
            print(_line(progress), file=self._stream, flush=True)

    def _draw(self, progress: Progress) -> None:
        from tqdm import tqdm

        bar = self._bar or tqdm(file=self._stream, bar_format=BAR, leave=False, total=progress.holes_total, delay=1e9)
        bar.n = progress.holes_done
        bar.set_postfix_str(_left(progress), refresh=False)
        bar.refresh()
        self._bar = bar


def clock(seconds: float) -> str:
    """``1:02:03`` or ``2:03``."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def _left(progress: Progress) -> str:
    tool = f"tool {progress.tool}, " if progress.tool else ""
    left = "" if progress.seconds_left is None else f", {clock(progress.seconds_left)} left"
    held = "held (Space goes on), " if progress.held else ""
    return f"{held}{tool}machine time {clock(progress.machine_seconds)}{left}"


def _line(progress: Progress) -> str:
    return f"drilling: {progress.holes_done} of {progress.holes_total} holes, {_left(progress)}"
