"""Text as a terminal may have it: characters that it would obey, or not show, become escapes: ``\x1b``, ``\u202e``.

Rule: applied once, at the last place before a stream or a canvas, so that no caller has to know where a text came from.
A name that is no UTF-8 has its odd bytes as ``\xff``.
"""

import json
import re

LINES = "\n\t"  # kept on a stream: they move within the text and overwrite nothing
DELETE = "\x7f"
# Printable to Python, and yet no column wide, or a blank that is no space: Default_Ignorable_Code_Point of Unicode's
# DerivedCoreProperties.txt, as far as str.isprintable() lets them pass (marks and letters; the rest are of class Cf).
_IGNORABLE = re.compile(
    "[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u2065\u3164\ufe00-\ufe0f\uffa0\U000e0100-\U000e01ef]"
)
_MASKS = {chr(code): chr(0x2400 + code) for code in range(0x20)} | {DELETE: "\u2421", "\t": " "}  # Control Pictures
_ODD_BYTES = range(0xDC80, 0xDD00)  # how os.fsdecode writes a byte of a name that is no UTF-8 (PEP 383)


def visible(text: str, keep: str = "") -> str:
    """Returns the text with every character escaped that doesn't print by itself; those in ``keep`` are left as they
    are.

    Escaped are all controls (ESC, BEL, C1, DEL, line ends), the marks that turn the direction of writing, whatever has
    no width, blanks other than the space, and lone surrogates. A backslash of the text itself stays.
    """
    if text.isascii() and text.isprintable():  # most texts, and a screen has hundreds in each frame
        return text
    bare = text.translate(dict.fromkeys(map(ord, keep)))
    if bare.isprintable() and not _IGNORABLE.search(bare):
        return text
    return "".join(char if char in keep or _is_shown(char) else _escaped(char) for char in text)


def one_line(text: str) -> str:
    """Like ``visible``, with line ends and tabs escaped too: a name in a sentence can't begin a line of its own."""
    return visible(text)


def masked(text: str) -> str:
    """Returns the text with one character for each that ``visible`` escapes, except line ends: for a field with a
    cursor in it.

    A tab is a space, any other control its picture, as U+241B for ESC; the rest are U+FFFD.
    """
    return "".join(char if char == "\n" or _is_shown(char) else _MASKS.get(char, "\ufffd") for char in text)


def json_text(value: object, indent: int | None = None) -> str:
    """Returns JSON in plain ASCII without a control character; DEL, which JSON allows, is escaped as well."""
    return json.dumps(value, indent=indent).replace(DELETE, "\\u007f")


def _is_shown(char: str) -> bool:
    return char.isprintable() and not _IGNORABLE.match(char)


def _escaped(char: str) -> str:
    code = ord(char)
    if code in _ODD_BYTES:
        return f"\\x{code - 0xDC00:02x}"
    return char.encode("unicode_escape").decode("ascii")
