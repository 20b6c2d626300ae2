"""Changes single values of a table in its text and keeps comments and layout. Pure functions: text in, text out.

Rule: only whether the place exists is checked here. What the result means is checked by the readers: an editor calls
Library.check_source before it saves.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Integer, Table

from drillctl.language import Message, message_of
from drillctl.machine.errors import TableError
from drillctl.machine.positions import Place
from drillctl.machine.source import Value

UNSAVED = "table"  # what errors call a text that has no file yet


def set_value(text: str, place: Place, value: Value) -> str:
    """Sets the value at a place such as ``("axis", 0, "range", 1)``. Raises TableError where there is no such place.

    A key that is not written yet is added to its table, and so is a table of the first level.
    """
    document = opened(text)
    if isinstance(place[0], str) and len(place) > 1 and place[0] not in document:
        document[place[0]] = tomlkit.table()
    inner = _inside(document, place[:-1])
    if isinstance(place[-1], int) and not 0 <= place[-1] < len(inner):
        raise _missing(place)
    inner[place[-1]] = _as_written(inner, place[-1], value)
    return tomlkit.dumps(document)


def set_pattern(text: str, wire: str, pattern: str) -> str:
    """Sets the pattern of a phase table's wire. Raises TableError where there is no such wire."""
    return set_value(text, ("wire", _row_of(text, "wire", "name", wire), "pattern"), pattern)


def set_reverse(text: str, patterns: Mapping[str, str]) -> str:
    """Sets the patterns of motion backwards, by wire; an empty mapping removes the ``[[reverse]]`` rows."""
    document = opened(text)
    rows = document.get("reverse", ())
    if list(patterns) == [row["name"] for row in rows]:
        for row in rows:
            row["pattern"] = patterns[row["name"]]
        return tomlkit.dumps(document)
    if document.pop("reverse", None) is not None:
        document = opened(tomlkit.dumps(document).rstrip() + "\n")  # without the empty line that stood above
    if patterns:
        document["reverse"] = _reverse_rows(patterns)
    return tomlkit.dumps(document)


def set_state_row(text: str, state: int, field: str, value: int) -> str:
    """Sets ``accelerate``, ``brake`` or ``interval`` of a ramp's state. Raises TableError where
    there is no such state.
    """
    return set_value(text, ("state", _row_of(text, "state", "state", state), field), value)


def _reverse_rows(patterns: Mapping[str, str]) -> AoT:
    rows = tomlkit.aot()
    for name, pattern in patterns.items():
        rows.append(tomlkit.item({"name": name, "pattern": pattern}))
    rows[0].trivia.indent = "\n"  # an empty line above, as between the rows
    return rows


def opened(text: str) -> tomlkit.TOMLDocument:
    """Parses a text so that it can be changed. Raises TableError for what is not TOML."""
    try:
        return tomlkit.parse(text)
    except TOMLKitError as error:
        raise TableError(
            UNSAVED, Message("not TOML: {reason}", reason=message_of(error)), getattr(error, "line", None)
        ) from error


def _inside(document: Any, place: Place) -> Any:
    for part in place:
        try:
            document = document[part]
        except (KeyError, IndexError, TypeError) as error:
            raise _missing(place) from error
    if not isinstance(document, dict | list):
        raise _missing(place)
    return document


def _missing(place: Place) -> TableError:
    return TableError(UNSAVED, Message("there is no {name} in it", name=".".join(map(str, place))))


def _as_written(inner: Any, key: str | int, value: Value) -> Any:
    """Returns the value in the notation of the one it replaces: an address in hexadecimal stays so."""
    old = inner.get(key) if isinstance(inner, dict) else None
    if isinstance(old, Integer) and old.as_string().lower().startswith("0x") and isinstance(value, int) and value >= 0:
        return tomlkit.value(f"0x{value:X}")
    return value


def _row_of(text: str, rows: str, key: str, wanted: str | int) -> int:
    for index, row in enumerate(opened(text).get(rows, ())):
        if row.get(key) == wanted:
            return index
    raise TableError(UNSAVED, Message("no [[{rows}]] has {key} {wanted}", rows=rows, key=key, wanted=wanted))


def with_states(text: str, state: int, accelerate: int, brake: int, interval: int) -> str:
    """Adds a row for this state above the others, and its mirror image below. Raises TableError for a text that is not
    TOML.
    """
    document = opened(text)
    rows = document["state"]
    assert isinstance(rows, AoT)
    below, above = (_row(sign * state, sign * accelerate, sign * brake, interval) for sign in (-1, 1))
    below.add(tomlkit.nl())  # empty lines stand between the rows
    above.trivia.indent = "\n"
    rows.insert(0, below)
    rows.append(above)
    return tomlkit.dumps(document)


def _row(state: int, accelerate: int, brake: int, interval: int) -> Table:
    row = tomlkit.table()
    row.update({"state": state, "accelerate": accelerate, "brake": brake, "interval": interval})
    return row


def with_rows(text: str, rows: Iterable[tuple[int, int, int, int]]) -> str:
    """Writes a computed ramp's rows out in place of its figures. Raises TableError for a text that is not TOML."""
    document = opened(text)
    document.pop("computed", None)
    written = (_row_text(*row) for row in rows)
    return tomlkit.dumps(document).rstrip() + "\n" + "".join(written)


def _row_text(state: int, accelerate: int, brake: int, interval: int) -> str:
    return f"\n[[state]]\nstate = {state}\naccelerate = {accelerate}\nbrake = {brake}\ninterval = {interval}\n"


def without_states(text: str, state: int) -> str:
    """Removes the rows of this state and of its mirror image. Raises TableError for a text that is not TOML."""
    document = opened(text)
    rows = document["state"]
    for index in reversed(range(len(rows))):
        if abs(rows[index]["state"]) == state:
            del rows[index]
    return tomlkit.dumps(document).rstrip() + "\n"  # without the empty line that stood above the last row
