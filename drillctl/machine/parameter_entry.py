"""One value of a parameter: what it may be, read from a file or from what was typed, and how it is shown.

Rule: bounds and choices are those of parameter_table.py; a refusal names the parameter, the value and the bound.
"""

import math
import re

from drillctl.language import Message
from drillctl.machine.parameter_table import Parameter, Value

UNSET = "unset"
LONGEST_SHOWN = 60  # characters of a value in its refusal
_WHOLE = re.compile(r"[+-]?[0-9]{1,18}")
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_SWITCH = {"true": True, "false": False}


def checked(row: Parameter, value: object) -> Value | None:
    """Returns a value of a file as the parameter's, None for ``"unset"``. Raises ValueError, with the reason as a
    Message, for what it can't be.
    """
    if value == UNSET:
        return None
    if row.kind == "switch":
        if not isinstance(value, bool):
            raise _refused(row, value, Message("it is true or false"))
        return value
    if row.kind == "choice":
        if isinstance(value, bool) or value not in row.choices:
            raise _refused(row, value, Message("it is one of {choices}", choices=", ".join(map(str, row.choices))))
        return type(row.choices[0])(value)
    return _number(row, value)


def parsed(row: Parameter, typed: str) -> Value | None:
    """Returns what was typed as the parameter's value, None for ``unset`` and for nothing. Raises ValueError, with the
    reason as a Message, where it can't be that.
    """
    text = typed.strip()
    if text.lower() in ("", UNSET):
        return None
    return checked(row, _typed_value(row, text))


def shown(value: Value | None) -> str:
    """Returns a value as it is typed: ``unset``, ``true``, a number with at most 12 digits and no exponent, a word."""
    if value is None:
        return UNSET
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def range_of(row: Parameter) -> str:
    """Returns what a parameter may be: ``1 .. 60000 mm/min``, ``true, false`` or the choices."""
    if row.low is None or row.high is None:
        choices = row.choices if row.kind == "choice" else _SWITCH
        return ", ".join(map(str, choices))
    return f"{row.low:.12g} .. {row.high:.12g} {row.unit}".rstrip()


def _typed_value(row: Parameter, text: str) -> object:
    if row.kind == "switch":
        return _SWITCH.get(text.lower(), text)
    if row.kind == "choice":
        return next((choice for choice in row.choices if str(choice) == text.upper()), text)
    if _WHOLE.fullmatch(text):
        return int(text)
    return float(text) if _DECIMAL.fullmatch(text) else text


def _number(row: Parameter, value: object) -> Value:
    assert row.low is not None
    assert row.high is not None
    finite = isinstance(value, int) or (isinstance(value, float) and math.isfinite(value))  # an int may pass any float
    if isinstance(value, bool) or not isinstance(value, int | float) or not finite:
        wanted = Message("a whole number is wanted") if row.kind == "whole" else Message("a number is wanted")
        raise _refused(row, value, wanted)
    if row.kind == "whole" and not isinstance(value, int):
        raise _refused(row, value, Message("a whole number is wanted"))
    if value < row.low:
        raise _refused(row, value, Message("the least is {bound}", bound=f"{row.low:.12g} {row.unit}".rstrip()))
    if value > row.high:
        raise _refused(row, value, Message("the greatest is {bound}", bound=f"{row.high:.12g} {row.unit}".rstrip()))
    return value if row.kind == "whole" else float(value)


def _refused(row: Parameter, value: object, why: Message) -> ValueError:
    given = (shown(value) if isinstance(value, Value) else repr(value))[:LONGEST_SHOWN]
    return ValueError(Message("{name} can't be {value}: {why}", name=row.name, value=given, why=why))
