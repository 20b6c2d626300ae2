"""A job on its way: a bar with the time left, on a terminal alone.

Rule: writes to one stream, never to standard output, and nothing where that is no terminal.
"""

import time
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, NoReturn, TextIO

from msgspec.structs import replace

from drillctl.language.number_text import clock
from drillctl.viewmodel.records import Progress

if TYPE_CHECKING:
    from tqdm import tqdm

DRAWN_EVERY_S = 0.1
BAR = "drilling {bar} {n_fmt}/{total_fmt}{postfix}"


class ProgressView:
    """Shows Progress records as they come. Use as a context manager, so that the bar is closed on every way out.

    ``by_clock``: a second of the machine is a second of the person. Of a free run the time left is foreseen from how
    fast it has been so far.
    """

    def __init__(self, stream: TextIO, by_clock: bool = True):
        self._stream, self._by_clock = stream, by_clock
        self._first: tuple[float, Progress] | None = None  # when it came, and what it said
        self._on_terminal = stream.isatty()
        self._bar: tqdm[NoReturn] | None = None
        self._due_s = 0.0

    def __enter__(self) -> "ProgressView":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.clear()
            self._bar.close()

    def show(self, progress: Progress) -> None:
        """Draws the newest record, at most as often as a person can read it."""
        if not self._on_terminal:
            return
        now_s = time.monotonic()
        self._first = self._first or (now_s, progress)
        if now_s < self._due_s:
            return
        self._due_s = now_s + DRAWN_EVERY_S
        self._draw(replace(progress, seconds_left=self._wait_s(progress, now_s)))

    def _wait_s(self, progress: Progress, now_s: float) -> float | None:
        """How many seconds the person will still wait; None if it can't be said."""
        if self._by_clock or self._first is None:
            return progress.seconds_left
        began_s, first = self._first
        done, left = progress.machine_seconds - first.machine_seconds, progress.seconds_left
        if left is None:  # not foreseen: by the holes
            done, left = progress.holes_done - first.holes_done, progress.holes_total - progress.holes_done
        return (now_s - began_s) * left / done if done > 0 else None

    def _draw(self, progress: Progress) -> None:
        from tqdm import tqdm

        bar = self._bar or tqdm(file=self._stream, bar_format=BAR, leave=False, total=progress.holes_total, delay=1e9)
        bar.n = progress.holes_done
        bar.set_postfix_str(_left(progress), refresh=False)
        bar.refresh()
        self._bar = bar


def _left(progress: Progress) -> str:
    tool = f"tool {progress.tool}, " if progress.tool else ""
    left = "" if progress.seconds_left is None else f", {clock(progress.seconds_left)} left"
    held = "held (Space goes on), " if progress.held else ""
    return f"{held}{tool}machine time {clock(progress.machine_seconds)}{left}"


class ToolPrompt:
    """Calls of it are questions: whether this tool is in the spindle now.

    entered  whether Enter was pressed since it was last asked
    """

    def __init__(self, entered: Callable[[], bool], screen: TextIO):
        self._entered, self._screen = entered, screen
        self._asked: int | None = None

    def __call__(self, tool: int, diameter_mm: float | None) -> bool:
        """True once Enter was pressed after the question; what was pressed before it is no answer."""
        entered = self._entered()
        if self._asked == tool:
            self._asked = None if entered else tool
            return entered
        self._asked = tool
        size = "" if diameter_mm is None else f" ({diameter_mm:.3f} mm)"
        print(f"\ntool T{tool}{size}: insert it, then press Enter", file=self._screen, flush=True)
        return False
