"""The lines of frames and rules: light ones, or ASCII where the terminal has no more; ``use`` says which."""

from typing import NamedTuple


class Lines(NamedTuple):
    """The characters of a frame."""

    across: str
    down: str
    top_left: str
    top_right: str
    bottom_left: str
    bottom_right: str


LIGHT = Lines("─", "│", "┌", "┐", "└", "┘")
ASCII = Lines("-", "|", "+", "+", "+", "+")
_used = LIGHT


def use(plain: bool) -> None:
    """Sets the lines of all frames made from now on; ``plain``: ASCII."""
    global _used  # noqa: PLW0603  # the terminal is one, and so is what it can show
    _used = ASCII if plain else LIGHT


def lines() -> Lines:
    """The characters that frames are drawn with now."""
    return _used
