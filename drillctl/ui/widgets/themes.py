"""Themes: a table of roles, and for each theme a table of colours. Rule: a widget names a role, never a colour.

Three colours have a meaning: ``good`` (ready, going), ``warning`` (needs the operator), ``danger`` (fault). Colour is
never the only sign: what is lit, done or wrong is told by a character or a word as well, so ``mono`` loses nothing.
A colour has two forms: the name of one of the 16 of every terminal, and what terminals of 256 and more get instead.
"""

from collections.abc import Mapping
from typing import Literal, NamedTuple

Depth = Literal[1, 16, 256, 16777216]
# As urwid wants it: name (None: of what has no role), the 16 colours, monochrome, many colours.
Entry = tuple[str | None, str, str, str, str, str]
Colours = Mapping[str, tuple[str, str]]


class Role(NamedTuple):
    """The colours of a role, by their names in a theme, and the settings that stand for them without colours."""

    foreground: str
    background: str
    mono: str


ROLES: Mapping[str, Role] = {
    "body": Role("text", "ground", "default"),
    "title": Role("strong", "ground", "bold"),
    "border": Role("line", "ground", "default"),
    "accent": Role("accent", "ground", "bold"),
    "menu": Role("on_bar", "bar", "standout"),
    "menu_hot": Role("hot", "bar", "standout,underline"),
    "key": Role("on_key", "key", "standout"),
    "lit": Role("accent", "ground", "bold,standout"),
    "dark": Role("faint", "ground", "default"),
    "good": Role("good", "ground", "bold"),
    "warning": Role("warning", "ground", "bold"),
    "danger": Role("on_danger", "danger", "bold,standout"),
    "focus": Role("on_key", "key", "standout"),
    "field": Role("on_field", "field", "underline"),
}
ATTRIBUTES = tuple(ROLES)

THEMES: Mapping[str, Colours] = {
    "blue": {  # of the program of 1996
        "ground": ("dark blue", "#00008a"), "text": ("light gray", "#d0d0d8"), "strong": ("white", "#ffffff"),
        "line": ("dark cyan", "#5f87d7"), "faint": ("dark cyan", "#6f9fd7"), "accent": ("yellow", "#ffd75f"),
        "bar": ("light gray", "#c6c6c6"), "on_bar": ("black", "#000000"), "hot": ("dark red", "#af0000"),
        "key": ("dark cyan", "#00afaf"), "on_key": ("black", "#000000"),
        "good": ("light green", "#5fff87"), "warning": ("yellow", "#ffaf5f"),
        "danger": ("dark red", "#af0000"), "on_danger": ("white", "#ffffff"),
        "field": ("black", "#000040"), "on_field": ("white", "#ffffff"),
    },
    "dark": {
        "ground": ("black", "#121212"), "text": ("light gray", "#c6c6c6"), "strong": ("white", "#eeeeee"),
        "line": ("dark gray", "#4e4e4e"), "faint": ("dark gray", "#808080"), "accent": ("light cyan", "#5fd7ff"),
        "bar": ("dark cyan", "#303030"), "on_bar": ("black", "#e4e4e4"), "hot": ("white", "#5fd7ff"),
        "key": ("dark cyan", "#005f87"), "on_key": ("white", "#ffffff"),
        "good": ("light green", "#87d75f"), "warning": ("yellow", "#ffaf00"),
        "danger": ("dark red", "#af0000"), "on_danger": ("white", "#ffffff"),
        "field": ("dark blue", "#262626"), "on_field": ("white", "#ffffff"),
    },
    "light": {
        "ground": ("white", "#ffffff"), "text": ("black", "#262626"), "strong": ("dark blue", "#00005f"),
        "line": ("dark gray", "#9e9e9e"), "faint": ("dark gray", "#767676"), "accent": ("dark blue", "#005faf"),
        "bar": ("dark blue", "#005f87"), "on_bar": ("white", "#ffffff"), "hot": ("yellow", "#ffd75f"),
        "key": ("dark cyan", "#005f87"), "on_key": ("white", "#ffffff"),
        "good": ("dark green", "#005f00"), "warning": ("dark magenta", "#875f00"),
        "danger": ("dark red", "#af0000"), "on_danger": ("white", "#ffffff"),
        "field": ("light gray", "#dadada"), "on_field": ("black", "#000000"),
    },
    "contrast": {
        "ground": ("black", "#000000"), "text": ("white", "#ffffff"), "strong": ("white", "#ffffff"),
        "line": ("white", "#ffffff"), "faint": ("light gray", "#d0d0d0"), "accent": ("yellow", "#ffff00"),
        "bar": ("light gray", "#ffffff"), "on_bar": ("black", "#000000"), "hot": ("dark blue", "#0000af"),
        "key": ("light gray", "#ffff00"), "on_key": ("black", "#000000"),
        "good": ("light green", "#00ff00"), "warning": ("yellow", "#ffff00"),
        "danger": ("dark red", "#d70000"), "on_danger": ("white", "#ffffff"),
        "field": ("dark blue", "#00005f"), "on_field": ("white", "#ffffff"),
    },
    "mono": {},  # the settings of the roles alone
}  # fmt: skip
DEFAULT_THEME, MONO = "blue", "mono"


def palette(theme: str) -> list[Entry]:
    """The entries of a theme; ``mono`` has the settings of a terminal without colours as its foreground. What has no
    role looks like ``body``: mapping every widget to it would cost a third of a frame (benchmarks/screen.py).
    """
    entries = [_entry(name, role, THEMES[theme]) for name, role in ROLES.items()]
    return [_entry(None, ROLES["body"], THEMES[theme]), *entries]


PAPER, INK = "#1b1f24", "#d5dae1"  # of a picture in a theme without colours


def shades(theme: str, role: object) -> tuple[str, str]:
    """Letters and ground of a role in a theme as ``#rrggbb``; those of ``body`` for what is no role."""
    wanted = ROLES.get(str(role), ROLES["body"])
    if colours := THEMES[theme]:
        return colours[wanted.foreground][1], colours[wanted.background][1]
    return (PAPER, INK) if "standout" in wanted.mono else (INK, PAPER)


def depth_of(environment: Mapping[str, str]) -> Depth:
    """How many colours the terminal has, by COLORTERM and TERM; 1 where NO_COLOR is set to anything."""
    terminal = environment.get("TERM", "")
    if environment.get("NO_COLOR") or terminal in ("dumb", "vt100", "vt102", "vt220"):
        return 1
    if environment.get("COLORTERM", "").lower() in ("truecolor", "24bit") or terminal.endswith("-direct"):
        return 16777216
    return 256 if "256color" in terminal else 16


def _entry(name: str | None, role: Role, colours: Colours) -> Entry:
    if not colours:
        return name, role.mono, "default", role.mono, role.mono, "default"
    (basic, many), (ground, many_ground) = colours[role.foreground], colours[role.background]
    return name, basic, ground, role.mono, many, many_ground
