"""Colours by meaning: a theme gives every attribute a look. Rule: a widget names an attribute, never a colour.

Colour is never the only sign: what is lit, done or wrong is told by a character or a word as well, so ``mono`` loses
nothing.
"""

from collections.abc import Mapping

# Attribute names that screens may use.
ATTRIBUTES = (
    "body", "title", "menu", "menu_hot", "key", "lit", "dark", "good", "warning", "danger", "focus", "field",
)  # fmt: skip

Entry = tuple[str, str, str, str]  # as urwid wants it: name, foreground, background, monochrome

MONO: Mapping[str, str] = {
    "body": "default",
    "title": "bold",
    "menu": "standout",
    "menu_hot": "standout,underline",
    "key": "standout",
    "lit": "bold,standout",
    "dark": "default",
    "good": "bold",
    "warning": "bold",
    "danger": "bold,standout",
    "focus": "standout",
    "field": "underline",
}

COLOURS: Mapping[str, Mapping[str, tuple[str, str]]] = {
    "colour": {
        "body": ("light gray", "dark blue"),
        "title": ("white", "dark blue"),
        "menu": ("black", "light gray"),
        "menu_hot": ("dark red", "light gray"),
        "key": ("black", "dark cyan"),
        "lit": ("yellow", "dark blue"),
        "dark": ("dark cyan", "dark blue"),
        "good": ("light green", "dark blue"),
        "warning": ("yellow", "dark blue"),
        "danger": ("white", "dark red"),
        "focus": ("black", "dark cyan"),
        "field": ("white", "black"),
    },
    "light": {
        "body": ("black", "white"),
        "title": ("dark blue", "white"),
        "menu": ("white", "dark blue"),
        "menu_hot": ("yellow", "dark blue"),
        "key": ("white", "dark cyan"),
        "lit": ("dark red", "white"),
        "dark": ("dark gray", "white"),
        "good": ("dark green", "white"),
        "warning": ("dark magenta", "white"),
        "danger": ("white", "dark red"),
        "focus": ("white", "dark blue"),
        "field": ("black", "light gray"),
    },
    "mono": dict.fromkeys(ATTRIBUTES, ("default", "default")),
}
THEMES = tuple(COLOURS)


def palette(theme: str) -> list[Entry]:
    """The entries of a theme; ``mono`` has the settings of a terminal without colours as its foreground."""
    colours = COLOURS[theme]
    if theme == "mono":
        return [(name, MONO[name], "default", MONO[name]) for name in ATTRIBUTES]
    return [(name, *colours[name], MONO[name]) for name in ATTRIBUTES]
