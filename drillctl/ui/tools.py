"""The operator changes the tool: asked on the terminal, without ever waiting for the answer.

Rule: says once what to do, and then only looks whether Enter was pressed; the machine is watched meanwhile. Handed to
desk by the verbs.
"""

from collections.abc import Callable
from typing import TextIO


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
