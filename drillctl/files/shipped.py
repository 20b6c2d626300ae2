"""Where the files are that come with the program: beside its modules in an installed wheel, else in the checkout."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent.parent


def shipped(name: str, in_checkout: str) -> Path:
    """Returns the folder ``name`` of the installed package, or ``in_checkout`` of the checkout around it."""
    inside = _PACKAGE / name
    return inside if inside.is_dir() else _PACKAGE.parent / in_checkout
