"""The operator changes the tool: asked on the terminal, without ever waiting for the answer.

Rule: says once what to do, and then only looks for a moment whether Enter was pressed; the machine is watched
meanwhile. Handed to desk by the verbs.
"""

import select
import sys
from typing import TextIO

MOMENT_S = 0.05  # well below the silence that the ticker bears


class ToolPrompt:
    """Calls of it are questions: whether this tool is in the spindle now."""

    def __init__(self, keyboard: TextIO, screen: TextIO):
        self._keyboard, self._screen = keyboard, screen
        self._asked: int | None = None

    def __call__(self, tool: int, diameter_mm: float | None) -> bool:
        """True once Enter was pressed after the question."""
        if self._asked != tool:
            self._asked = tool
            size = "" if diameter_mm is None else f" ({diameter_mm:.3f} mm)"
            print(f"\ntool T{tool}{size}: insert it, then press Enter", file=self._screen, flush=True)
        ready, _, _ = select.select([self._keyboard], [], [], MOMENT_S)
        if not ready:
            return False
        self._asked = None
        return self._keyboard.readline() != ""


def on_terminal() -> ToolPrompt | None:
    """A prompt on this terminal; None where nobody sits at one."""
    return ToolPrompt(sys.stdin, sys.stderr) if sys.stdin.isatty() else None
