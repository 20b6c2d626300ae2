"""Widgets with words in them. Rule: whatever they are given, a terminal only prints: what it would obey is escaped.

Every text on the screen is one of these, or is drawn by lines.py, which escapes too; tests/ui/test_hidden_characters.py
holds that no screen makes urwid's own. Used by the frame, the dialogs and all screens.
"""

from typing import Any, TypeVar

import urwid

from drillctl.language import LINES, masked, visible

KEPT = LINES.replace("\t", "")  # urwid gives a tab no columns
Markup = TypeVar("Markup")


def shown(markup: Markup) -> Markup:
    """urwid's markup, the text in it escaped: a string, a pair of attribute and markup, or a list of markup."""
    found: Any = markup
    if isinstance(found, str):
        return visible(found, KEPT)  # type: ignore[return-value]  # a str for a str
    if isinstance(found, tuple):
        return (found[0], shown(found[1]))  # type: ignore[return-value]
    return [shown(part) for part in found]  # type: ignore[return-value]


class Text(urwid.Text):
    """Text to be read."""

    def set_text(self, markup: Any) -> None:
        """Escaped."""
        super().set_text(shown(markup))


class Icon(urwid.SelectableIcon):
    """A line of a list, with the cursor at its beginning."""

    def set_text(self, markup: Any) -> None:
        """Escaped."""
        super().set_text(shown(markup))


class Edit(urwid.Edit):
    """A field: shows one mark for each character that is not printed, and keeps the text as it is."""

    def get_text(self) -> Any:
        """Caption and text as they are drawn, and their attributes."""
        text, attributes = super().get_text()
        return masked(str(text)), attributes


class Button(urwid.Button):
    """A button that calls something when it is pressed."""

    def __init__(self, label: str, pressed: Any):
        super().__init__(visible(label), pressed)


class Box(urwid.LineBox[urwid.Widget]):
    """A frame around a widget."""

    def __init__(self, inside: urwid.Widget, title: str = ""):
        super().__init__(inside, title=visible(title), title_attr="title")

    def set_title(self, text: Any) -> None:
        """Another one."""
        super().set_title(shown(text))
