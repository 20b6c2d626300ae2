"""Text on its way to a terminal: only what is printed gets through as it is."""

import json
import sys
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drillctl.language import LINES, json_text, masked, one_line, visible

ANYTHING = st.text(st.characters(codec=None))
# Bidi controls (UAX 9), what has no width (Default_Ignorable_Code_Point), line ends and C1 (ECMA-48), by hand.
OBEYED = [
    *"\x00\x07\x08\x0b\x0c\x0e\x1b\x7f\x85\x90\x9b\x9d\xad", *"\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e",
    *"\u2066\u2067\u2068\u2069\u200b\u200c\u200d\u2060\ufeff\u034f\u115f\u3164\uffa0\ufe0f\u180e\u2028\u2029\ufff9",
    "\U000e0001", "\U000e0100", "\udcff", "\ud800",
]  # fmt: skip


@pytest.mark.parametrize("char", OBEYED, ids=lambda char: f"{ord(char):x}")
def test_is_escaped(char: str) -> None:
    shown = visible(f"a{char}b", LINES)
    assert shown.isascii() and shown.isprintable() and shown[0] == "a" and shown[-1] == "b"
    assert shown[1] == "\\" and char not in shown
    assert masked(f"a{char}b").isprintable() and len(masked(f"a{char}b")) == 3


@pytest.mark.parametrize("text", ["", "C:\\x1b.drl", "żółć łódź", "\u2801\u28ff│", "部品.drl", "e\u0301", "🙂"])
def test_printed_text_stays(text: str) -> None:
    assert visible(text) == text == masked(text)


def test_how_it_is_written() -> None:
    assert visible("\x1b[31m\u202e\udcfe\x9b\U000e0001") == r"\x1b[31m\u202e\xfe\x9b\U000e0001"
    assert visible("a\tb\nc\rd", LINES) == "a\tb\nc\\rd"
    assert one_line("a\tb\nc") == r"a\tb\nc"
    assert masked("a\x1b\tb\nc\u202e") == "a\u241b b\nc\ufffd"


@given(ANYTHING)
def test_whatever_comes_only_prints(text: str) -> None:
    for shown in (visible(text), one_line(text), masked(text).replace("\n", "")):
        assert shown.isprintable()
        shown.encode("utf-8")
        assert not any(unicodedata.category(char) in ("Cc", "Cf", "Cs", "Zl", "Zp") for char in shown)
    assert len(masked(text)) == len(text)


@given(st.dictionaries(ANYTHING, ANYTHING))
def test_json_stays_json_and_prints(value: dict[str, str]) -> None:
    text = json_text(value)
    assert json.loads(text) == value
    assert text.isascii() and visible(text) == text
    assert visible(json_text(value, 2), LINES) == json_text(value, 2)


def test_no_character_of_unicode_that_moves_the_cursor_is_left() -> None:
    for code in range(sys.maxunicode + 1):
        char = chr(code)
        if unicodedata.category(char) in ("Cc", "Cf", "Cs", "Zl", "Zp"):
            assert visible(char) != char
