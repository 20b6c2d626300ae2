"""Where a key stands, in every way that TOML has of writing one; every place of the tree is found, and no other."""

import tomllib
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from typing import Any

import pytest
import tomlkit
from hypothesis import given
from hypothesis import strategies as st

from drillctl.language import Message
from drillctl.machine import TableError, shipped_tables
from drillctl.machine.positions import Place, key_lines
from drillctl.machine.source import Source

TEXT = (
    '''# [comment]
name = "a # no comment"          # tick_hz = 1
description = """
tick_hz = 5
[[axis]]
a quote at the end: \\""""""
"quoted key" = '''
    """
x = 1
"""
    """
a."b.c".d = 1_000
rows = [
  1, # one
  [2, "]"], { k = "}", l = [3] },
]

[[axis]]
name = "x"
range = [-1,
         5]
[axis.motor]
kind = 1979-05-27
[[axis]]
name = 'y'
motor = { kind = "b" }
[[axis.wire]]
bit = 0x2A
[[axis.wire]]
bit = 7
[wiring]
"x.1a" = 0
""".replace("''''''", "'" * 3)
)


@pytest.mark.parametrize(
    ("place", "line"),
    [
        (("name",), 2),
        (("description",), 3),
        (("quoted key",), 7),
        (("a",), 10),
        (("a", "b.c", "d"), 10),
        (("rows", 0), 12),
        (("rows", 1, 1), 13),
        (("rows", 2, "k"), 13),
        (("rows", 2, "l", 0), 13),
        (("axis", 0), 16),
        (("axis", 0, "range", 1), 19),
        (("axis", 0, "motor"), 20),
        (("axis", 0, "motor", "kind"), 21),
        (("axis", 1), 22),
        (("axis", 1, "name"), 23),
        (("axis", 1, "motor", "kind"), 24),
        (("axis", 1, "wire", 0, "bit"), 26),
        (("axis", 1, "wire", 1, "bit"), 28),
        (("wiring", "x.1a"), 30),
    ],
)
def test_every_way_of_writing_a_key_has_its_line(place: Place, line: int) -> None:
    assert key_lines(TEXT)[place] == line


def test_what_stands_in_a_text_is_no_key() -> None:
    lines = key_lines(TEXT)
    assert ("tick_hz",) not in lines and ("x",) not in lines and ("axis", 2) not in lines


def places_of(tree: Any, place: Place = ()) -> Iterator[Place]:
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in items:
        yield (*place, key)
        yield from places_of(value, (*place, key))


KEYS = st.text("ab._- \\\"'#=[]{}\tą", min_size=1, max_size=6)
STRINGS = st.text("ab\n\\\"'#=[]{}, ", max_size=12)
VALUES = st.recursive(
    st.one_of(st.integers(-9, 9), st.floats(-1, 1), st.booleans(), STRINGS, st.just(date(1996, 1, 1))),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(KEYS, inner, max_size=3)),
    max_leaves=8,
)


@given(st.dictionaries(KEYS, VALUES, max_size=4))
def test_the_places_are_those_of_the_tree(tree: dict[str, Any]) -> None:
    text = tomlkit.dumps(tree)
    assert set(key_lines(text)) == set(places_of(tomllib.loads(text)))


@given(st.dictionaries(KEYS, st.one_of(STRINGS, st.integers()), min_size=1, max_size=6), st.data())
def test_a_line_is_that_of_its_key(tree: dict[str, Any], data: st.DataObject) -> None:
    """Written here pair by pair, strings over as many lines as they like."""
    text, wanted = "", {}
    for key, value in tree.items():
        text += data.draw(st.sampled_from(["", "\n", "# key = 1\n", " \t"]))
        wanted[(key,)] = text.count("\n") + 1
        many = isinstance(value, str) and data.draw(st.booleans())
        written = tomlkit.string(value, multiline=True).as_string() if many else tomlkit.item(value).as_string()
        text += f"{tomlkit.key([key]).as_string()} = {written}\n"
    assert tomllib.loads(text) == tree and key_lines(text) == wanted


@pytest.mark.parametrize("file", sorted(shipped_tables().rglob("*.toml")), ids=lambda file: file.stem)
def test_every_key_of_a_shipped_table_is_found(file: Path) -> None:
    text = file.read_text("utf-8")
    assert set(key_lines(text)) == set(places_of(tomllib.loads(text)))


def test_a_key_in_a_long_text_misleads_no_fault(tmp_path: Path) -> None:
    text = 'name = "t"\ndescription = """\ntick_hz = 1\n"""\ntick_hz = "x"\n'
    source = Source(tmp_path / "m.toml", text)
    assert source.line_of("tick_hz") == 5 and source.line_of("nothing") is None
    assert isinstance(source.error(Message("wrong"), "tick_hz"), TableError)
