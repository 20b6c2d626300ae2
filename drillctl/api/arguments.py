"""What a caller gives, made plain before it is used: numpy's numbers and arrays, paths of any kind.

Rule: what can't be meant is refused by the name of the argument, with what is expected; it is never guessed.
"""

import os
from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from drillctl.language import Message, Refusal

NUMBERS = (int, float, np.integer, np.floating)
Whole = SupportsIndex  # as type checkers see a number of Python or of numpy
Wholes = Sequence[int] | NDArray[np.integer[Any]]
Reals = Sequence[float] | NDArray[np.integer[Any]] | NDArray[np.floating[Any]]


def path_of(given: object, what: str = "file") -> Path:
    """Returns a path. Raises Refused for what is no name of a file."""
    if not isinstance(given, str | bytes | os.PathLike):
        raise unexpected(what, "a path", given)
    name = os.fsdecode(given)
    if not name or "\0" in name:
        raise Refusal(Message("no name that a file can have").at(what))
    return Path(name)


def whole(given: object, what: str, least: int, most: int) -> int:
    """Returns a whole number within bounds; 500.0 is one. Raises Refused."""
    found = number(given, what, least, most)
    if found != int(found):
        raise unexpected(what, "a whole number", given)
    return int(found)


def number(given: object, what: str, least: float, most: float) -> float:
    """Returns a number within bounds. Raises Refused."""
    if not isinstance(given, NUMBERS) or isinstance(given, bool):
        raise unexpected(what, "a number", given)
    if not least <= given <= most:
        raise Refusal(Message("{what} {value}: {least} to {most}", what=what, value=given, least=least, most=most))
    return given if isinstance(given, int) else float(given)


def several(given: object, what: str) -> tuple[Any, ...]:
    """Returns the values of a list, tuple, range or array, one or more. Raises Refused."""
    if isinstance(given, str | bytes | Mapping) or not isinstance(given, Iterable):
        raise unexpected(what, "a list", given)
    found = tuple(plain(each) for each in given)
    if not found:
        raise Refusal(Message("the list is empty").at(what))
    return found


def named(given: object, what: str) -> Mapping[str, Any]:
    """Returns a mapping by names. Raises Refused."""
    if not isinstance(given, Mapping):
        raise unexpected(what, "a dict", given)
    if other := [key for key in given if not isinstance(key, str)]:
        raise unexpected(what, "names", other[0])
    return given


def decimals(value: float) -> str:
    """Returns a number's shortest exact text without an exponent: 1e-07 as 0.0000001."""
    return f"{Decimal(repr(value)):f}"


def plain(value: Any) -> Any:
    """Returns a value as Python's own numbers, texts and tuples."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    return tuple(map(plain, value)) if isinstance(value, list | tuple | set | frozenset | range) else value


def unexpected(what: str, wanted: str, given: object) -> Refusal:
    """Returns the refusal of a value of another kind."""
    return Refusal(Message("expected {wanted}, got {found}", wanted=wanted, found=type(given).__name__).at(what))
