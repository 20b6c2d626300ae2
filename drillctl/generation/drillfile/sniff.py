"""What is this file at all? Rule: look at the head only, before a single line is parsed.

A table of signatures, tried in order; the intake asks, so that pictures, archives and other machines'
programs are refused in no time and by name.
"""

from __future__ import annotations

import re

from .errors import Complaint

HEAD_BYTES = 65_536

MAGIC: tuple[tuple[str, bytes], ...] = (
    ("archive", b"PK\x03\x04"),
    ("archive", b"PK\x05\x06"),
    ("archive", b"\x1f\x8b"),
    ("archive", b"BZh"),
    ("archive", b"\xfd7zXZ"),
    ("archive", b"7z\xbc\xaf\x27\x1c"),
    ("archive", b"Rar!"),
    ("archive", b"\x28\xb5\x2f\xfd"),
    ("not-text", b"\x89PNG"),
    ("not-text", b"\xff\xd8\xff"),
    ("not-text", b"GIF8"),
    ("not-text", b"%PDF"),
    ("not-text", b"\x7fELF"),
    ("not-text", b"BM"),
)
TAR_MAGIC_AT = 257  # POSIX ustar header

# Bytes no text line holds; 0x1A (DOS end of file) and the tape's 0x00 and 0x7F leader are cut before.
CONTROLS = bytes({*range(0x20), 0x7F} - set(b"\t\n\v\f\r"))

# Every pattern begins at a line's start, so comments are passed over; what runs over line ends gives nothing back
# (`*+`), else thousands of empty lines take hours. Excellon has no Z, no spindle, no asterisks.
LANGUAGES: tuple[tuple[str, re.Pattern[str]], ...] = (
    ("sieb-meyer-not-drill", re.compile(r"\A\s*%%\d{3,4}\b")),
    # a table of sizes: T01 0.024
    (
        "tool-report-not-drill",
        re.compile(r"\A(?:[ \t\r\f\v]*+(?:;.*+)?\n)*+[ \t]*T\d+[ \t]+\d*\.?\d+ ?(?:mm|in|inch|mils?)?\s", re.I),
    ),
    ("tool-report-not-drill", re.compile(r"^[^;\n]*(?:NC ?Drill File Report|Hole Size +.*Hole Count)", re.I | re.M)),
    ("not-a-drill-file", re.compile(r"\A\s*+0[^\S\n]*+\n\s*+(?:SECTION|HEADER)\b")),
    ("hpgl-not-drill", re.compile(r"\A\s*(?:\x1b\S*)?(?:IN|DF|PG|SP\d|PU|PD|PA)(?:\s*;|-?\d)")),
    (
        "gerber-not-drill",
        re.compile(r"^%(?:FS|MO|AD|AM|LP|TF)|^G04\b.*\*|^[GXYDIJM][GXYDIJM\d+-]*\*\s*$", re.M),
    ),
    (
        "gcode-not-drill",
        re.compile(r"^(?:N\d+ ?)?(?:G2[01]\b|M0?[345]\b|[GXY][-+.\dGXY ]*Z ?[-+.\d])", re.M),
    ),
)


def check_bytes(head: bytes) -> None:
    """Refuse archives, pictures and other binary files by their first bytes."""
    for code, magic in MAGIC:
        if head.startswith(magic):
            raise Complaint(code)
    if head[TAR_MAGIC_AT : TAR_MAGIC_AT + 5] == b"ustar":
        raise Complaint("archive")


def check_controls(data: bytes) -> None:
    """Refuse text with control bytes in it."""
    if len(data.translate(None, CONTROLS)) != len(data):
        raise Complaint("not-text", "control bytes")


def check_language(head: str) -> None:
    """Refuse the programs and reports of other machines by what their lines look like."""
    for code, pattern in LANGUAGES:
        if found := pattern.search(head):
            raise Complaint(code, found[0])
