"""Dialogs with more to answer: several fields, one of several lines, one of several ways on.

Rule: as in dialogs.py, but for a form's OK: its answers are looked at first, and while anything is wrong with them the
box stays open and says so. Made by app.py.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import urwid

from drillctl.language.sentences import told
from drillctl.language.words import _
from drillctl.ui.widgets.dialogs import Act, Dialog, Part, nothing
from drillctl.ui.widgets.lines import Size
from drillctl.ui.widgets.pick import Pick
from drillctl.ui.widgets.texts import Edit, Text

PROBLEM_ROWS = 3


class Field(NamedTuple):
    """A line to be filled in: what is asked, and what stands there to begin with."""

    label: str
    text: str


class FieldsDialog(Dialog):
    """``accept`` gets what was typed, in the order of the fields, and answers with what is wrong with it."""

    def __init__(self, title: str, fields: Sequence[Field], accept: Callable[[list[str]], Sequence[str]], closing: Act):
        widest = max(len(field.label) for field in fields)
        self._edits = [Edit(("body", f"{field.label:{widest}} "), field.text) for field in fields]
        self._accept = accept
        self._told = Text("\n" * (PROBLEM_ROWS - 1))
        boxes: list[Part] = [urwid.AttrMap(edit, "field", "focus") for edit in self._edits]
        super().__init__(title, [*boxes, self._told], [(_("OK"), self.submit), (_("Cancel"), nothing)], closing)

    def keypress(self, size: Size, key: str) -> str | None:
        """Tab goes on as the arrow does."""
        return super().keypress(size, "down" if key == "tab" else key)

    def submit(self) -> None:
        """Closes once everything is accepted."""
        if problems := self._accept([edit.edit_text for edit in self._edits]):
            self._told.set_text(("danger", "\n".join(map(told, problems[:PROBLEM_ROWS]))))
        else:
            self._closing()

    def _closed_by(self, act: Act) -> Act:
        return act if act == self.submit else super()._closed_by(act)


class Choice(Dialog):
    """``chosen`` is called with the number, from 0, of the line that was picked: with Enter, a click, or its digit."""

    def __init__(self, title: str, lines: Sequence[str], chosen: Callable[[int], object], closing: Act):
        self._acts = [self._closed_by(_call(chosen, index)) for index in range(len(lines))]
        marked = [f"{index} {line}" if index < 10 else f"  {line}" for index, line in enumerate(lines, start=1)]
        picks = [Pick(line, act) for line, act in zip(marked, self._acts, strict=True)]
        rows: list[Part] = [urwid.AttrMap(pick, "body", "focus") for pick in picks]
        super().__init__(title, rows, [(_("Cancel"), nothing)], closing)

    def keypress(self, size: Size, key: str) -> str | None:
        """A digit picks its line at once."""
        if key.isdecimal() and 1 <= int(key) <= len(self._acts):
            self._acts[int(key) - 1]()
            return None
        return super().keypress(size, key)


def offer(title: str, lines: Sequence[str], ways: Sequence[tuple[str, Act]], closing: Act) -> Dialog:
    """Several ways on, a button each; the first, which Enter means, and Esc do nothing."""
    return Dialog(title, [Text(line) for line in lines], [(_("Not now"), nothing), *ways], closing)


def _call(chosen: Callable[[int], object], index: int) -> Act:
    return lambda: chosen(index)
