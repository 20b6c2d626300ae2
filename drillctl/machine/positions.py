"""Finds the line of every key of a TOML text, which tomllib does not tell.

Rule: the text is valid TOML (tomllib has read it), so only its structure is followed here: headers, keys, inline tables
and arrays; strings and comments are passed over.
"""

import re
from collections.abc import Callable, Iterator

from drillctl.files.inputs import toml_of

Place = tuple[str | int, ...]  # of a value in a file, such as ("axis", 0, "range", 1)
ItemWalk = Callable[[int], Iterator[tuple[Place, int]]]

_BLANK = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_STRING = re.compile(  # multi-line ones first: each ends with the last of at most five quotes
    r'"""(?:\\[\s\S]|(?!""")[\s\S])*"""(?:"{0,2})'
    r"|'''(?:(?!''')[\s\S])*'''(?:'{0,2})"
    r'|"(?:\\.|[^"\\\n])*"'
    r"|'[^'\n]*'"
)
_PLAIN = re.compile(r"[^,\]}\n#]*")  # a number, a date or a truth value


def key_lines(text: str) -> dict[Place, int]:
    """Returns the line, from 1, of every key, array element and table header, by its place in the tree that tomllib
    reads.

    A table that several headers open has the line of the first of them.
    """
    found: dict[Place, int] = {}
    for place, at in _Walk(text).statements():
        found.setdefault(place, text.count("\n", 0, at) + 1)
    return found


class _Walk:
    """One pass over a text; ``at`` is the next character."""

    def __init__(self, text: str):
        self._text, self._at = text, 0
        self._rows: dict[Place, int] = {}  # how many rows each array of tables has so far

    def statements(self) -> Iterator[tuple[Place, int]]:
        """Yields places with the offset at which each is written, in the order of the text."""
        table: Place = ()
        self._skip_blank()
        while self._at < len(self._text):
            start = self._at
            if self._passed("[["):
                table = self._new_row(self._keys())
                self._at += len("]]")
                yield from _with_outer(table, start)
            elif self._passed("["):
                table = self._resolved(self._keys())
                self._at += len("]")
                yield from _with_outer(table, start)
            else:
                yield from self._pair(table)
            self._skip_blank()

    def _pair(self, table: Place) -> Iterator[tuple[Place, int]]:
        """Reads ``key = value``, the key dotted or not."""
        start = self._at
        place = (*table, *self._keys())
        self._at += len("=")
        yield from ((place[:length], start) for length in range(len(table) + 1, len(place) + 1))
        yield from self._value(place)

    def _value(self, place: Place) -> Iterator[tuple[Place, int]]:
        self._skip_blank()
        if self._passed("{"):
            yield from self._items("}", lambda _: self._pair(place))
        elif self._passed("["):
            yield from self._items("]", lambda number: self._element((*place, number)))
        else:
            found = _STRING.match(self._text, self._at) or _PLAIN.match(self._text, self._at)
            assert found is not None
            self._at = found.end()

    def _element(self, place: Place) -> Iterator[tuple[Place, int]]:
        yield place, self._at
        yield from self._value(place)

    def _items(self, end: str, item: ItemWalk) -> Iterator[tuple[Place, int]]:
        """Reads what is between brackets, separated by commas; a comma may end it."""
        number = 0
        self._skip_blank()
        while not self._passed(end):
            yield from item(number)
            number += 1
            self._skip_blank()
            self._passed(",")
            self._skip_blank()

    def _keys(self) -> Place:
        """Reads a key, dotted or not; the next character is then ``=`` or ``]``."""
        keys = [self._key()]
        while self._passed("."):
            keys.append(self._key())
        return tuple(keys)

    def _key(self) -> str:
        self._skip_blank()
        found = _STRING.match(self._text, self._at) or _BARE.match(self._text, self._at)
        assert found is not None
        self._at = found.end()
        self._skip_blank()
        written = found[0]
        return str(toml_of(f"key = {written}")["key"]) if written[0] in "\"'" else written

    def _resolved(self, keys: Place) -> Place:
        """Returns a header's place: within an array of tables it means the last row so far."""
        place: Place = ()
        for key in keys:
            place = (*place, key)
            if place in self._rows:
                place = (*place, self._rows[place] - 1)
        return place

    def _new_row(self, keys: Place) -> Place:
        array = (*self._resolved(keys[:-1]), keys[-1])
        self._rows[array] = self._rows.get(array, 0) + 1
        return (*array, self._rows[array] - 1)

    def _passed(self, mark: str) -> bool:
        """Returns whether ``mark`` comes next, and passes it if so."""
        if not self._text.startswith(mark, self._at):
            return False
        self._at += len(mark)
        return True

    def _skip_blank(self) -> None:
        found = _BLANK.match(self._text, self._at)
        assert found is not None
        self._at = found.end()


def _with_outer(table: Place, start: int) -> Iterator[tuple[Place, int]]:
    """Yields the table and those around it, which its header opens too."""
    return ((table[:length], start) for length in range(1, len(table) + 1))
