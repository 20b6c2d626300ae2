"""What was chosen on the screen and holds for the next start too: the theme, in the user's configuration folder.

Rule: no screen fails for this file. One that is missing, damaged or names no theme reads as the default, and one that
can't be written is left unwritten.
"""

from collections.abc import Mapping
from pathlib import Path

from drillctl.files.inputs import read_bytes, toml_of
from drillctl.files.outputs import write_text
from drillctl.language import Message
from drillctl.ui.widgets.themes import DEFAULT_THEME, MONO, THEMES

LARGEST_FILE_BYTES = 4096


def file() -> Path:
    """Where the choice is kept."""
    from platformdirs import user_config_path

    return user_config_path("drillctl", appauthor=False) / "screen.toml"


def chosen_theme(environment: Mapping[str, str]) -> str:
    """The theme chosen last; ``mono`` where NO_COLOR is set."""
    if environment.get("NO_COLOR"):
        return MONO
    try:
        theme = toml_of(read_bytes(file(), LARGEST_FILE_BYTES, Message("the screen's settings")).decode()).get("theme")
    except (OSError, ValueError, RecursionError):  # ValueError: no TOML, or no UTF-8
        return DEFAULT_THEME
    return theme if isinstance(theme, str) and theme in THEMES else DEFAULT_THEME


def keep_theme(theme: str) -> tuple[str, ...]:
    """Keeps a theme for the next start; returns the reason where that fails."""
    return write_text(file(), f'theme = "{theme}"\n')
