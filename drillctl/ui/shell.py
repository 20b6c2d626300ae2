"""What the frame offers to a screen. A screen is made with a Console and a Shell, and knows no more.

Rule: the shell owns the terminal, the menus and the dialogs; a screen owns its own widgets and its own keys.
Implemented by app.py; the tests have a shell of their own.
"""

from collections.abc import Callable, Sequence
from typing import Protocol, runtime_checkable

import urwid

from drillctl.panel.console import MachineView


class Shell(Protocol):
    """Where a screen stands: it can tell, ask, and lead on to another screen and back."""

    def message(self, title: str, lines: Sequence[str]) -> None:
        """A dialog that tells something, until Enter or Esc."""

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        """A dialog of yes and no; ``yes`` is called when that was the answer. No is what Enter and Esc mean."""

    def open(self, screen: urwid.Widget) -> None:
        """Another screen over this one."""

    def back(self) -> None:
        """Closes the screen on top; the first one stays."""

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        """A dialog with a line to type in, ``text`` to begin with; ``accept`` is called with what was typed."""


@runtime_checkable
class Live(Protocol):
    """A screen that shows the machine: it is handed the newest view some twenty times a second."""

    def refresh(self, view: MachineView) -> None:
        """Redraws what changed."""
