"""Lists of values as an operator writes them: ``440,500,580`` and ``440:640:20``, both ends included, exact in
decimals.
"""

from collections.abc import Iterator
from decimal import Decimal, InvalidOperation

from drillctl.lab.errors import LabError
from drillctl.language import Message

MOST_VALUES = 10_000


def numbers(text: str, what: str, least: float, most: float) -> tuple[float, ...]:
    """Returns all values of a list, in their order. Raises LabError, which names ``what``."""
    try:
        found = [value for part in text.split(",") for value in _spelled(part)]
    except (InvalidOperation, ValueError) as error:
        reason = "is no list of numbers: say 440,500 or FROM:TO:STEP"
        raise LabError(Message("{what} {text!r} {reason}", what=what, text=text[:60], reason=reason)) from error
    if bad := [value for value in found if not least <= value <= most]:
        raise LabError(
            Message("{what} {bad} is outside {least:g} to {most:g}", what=what, bad=bad[0], least=least, most=most)
        )
    if len(found) > len(set(found)):
        raise LabError(Message("{what} {text!r} has a value twice", what=what, text=text[:60]))
    return tuple(map(float, found))


def whole_numbers(text: str, what: str, least: int, most: int) -> tuple[int, ...]:
    """Like ``numbers``, where each must be a whole number."""
    found = numbers(text, what, least, most)
    if bad := [value for value in found if value != int(value)]:
        raise LabError(Message("{what} {bad:g} is no whole number", what=what, bad=bad[0]))
    return tuple(map(int, found))


def _spelled(part: str) -> Iterator[Decimal]:
    """Yields one number, or those of a range. Raises ValueError, InvalidOperation."""
    ends = [Decimal(word) for word in part.split(":")]
    if not all(end.is_finite() for end in ends) or len(ends) not in (1, 3):
        raise ValueError(part)
    if len(ends) == 1:
        yield ends[0]
        return
    first, last, step = ends
    if step <= 0 or not 0 <= (last - first) / step < MOST_VALUES:
        raise ValueError(part)
    yield from (first + step * count for count in range(int((last - first) / step) + 1))
