"""The half of a Shell that tells and asks: each of its methods is a box over whatever is on the screen.

Rule: nothing is known here of screens and machine. The base of app.py.
"""

from collections.abc import Callable, Sequence

from drillctl.panel.console import Problems
from drillctl.ui import dialogs
from drillctl.ui.forms import Choice, Field, Form, offer
from drillctl.ui.layers import Layers


class Boxes:
    """Lays its boxes on ``layers``."""

    def __init__(self, layers: Layers):
        self.layers = layers

    def message(self, title: str, lines: Sequence[str]) -> None:
        """See Shell."""
        self.layers.push_dialog(dialogs.message(title, lines, self.layers.pop))

    def ask(self, question: str, yes: Callable[[], None]) -> None:
        """See Shell."""
        self.layers.push_dialog(dialogs.question(question, yes, self.layers.pop))

    def ask_text(self, title: str, prompt: str, text: str, accept: Callable[[str], None]) -> None:
        """See Shell."""
        self.layers.push_dialog(dialogs.entry(title, prompt, text, accept, self.layers.pop))

    def ask_fields(self, title: str, fields: Sequence[Field], accept: Callable[[list[str]], Problems]) -> None:
        """See Shell."""
        self.layers.push_dialog(Form(title, fields, accept, self.layers.pop))

    def choose(self, title: str, lines: Sequence[str], chosen: Callable[[int], object]) -> None:
        """See Shell."""
        self.layers.push_dialog(Choice(title, lines, chosen, self.layers.pop))

    def offer(self, title: str, lines: Sequence[str], ways: Sequence[tuple[str, Callable[[], object]]]) -> None:
        """See Shell."""
        self.layers.push_dialog(offer(title, lines, ways, self.layers.pop))
