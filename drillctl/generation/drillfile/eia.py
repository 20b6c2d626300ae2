"""EIA RS-244 tape code, the other alphabet of punched tape. Rule: odd parity in every row.

Protel writes each drill file twice, as ASCII `.TXT` and in this code as `.DRL`; digits and the letters
of drill programs were checked against such a pair (427 coordinate lines equal), the other letters follow
the code's own order: tracks 1 to 4 count, 6 and 7 choose the group, 5 makes the parity odd.
The intake decodes with it, the writer encodes.
"""

from __future__ import annotations

from .errors import Complaint

CODE = {
    "0": 0x20, "1": 0x01, "2": 0x02, "3": 0x13, "4": 0x04, "5": 0x15, "6": 0x16, "7": 0x07, "8": 0x08, "9": 0x19,
    "A": 0x61, "B": 0x62, "C": 0x73, "D": 0x64, "E": 0x75, "F": 0x76, "G": 0x67, "H": 0x68, "I": 0x79,
    "J": 0x51, "K": 0x52, "L": 0x43, "M": 0x54, "N": 0x45, "O": 0x46, "P": 0x57, "Q": 0x58, "R": 0x49,
    "S": 0x32, "T": 0x23, "U": 0x34, "V": 0x25, "W": 0x26, "X": 0x37, "Y": 0x38, "Z": 0x29,
    ".": 0x6B, "%": 0x0B, "-": 0x40, "+": 0x70, ",": 0x3B, "/": 0x31, " ": 0x10, "\n": 0x80,
}  # fmt: skip
LEADER, RUBOUT = 0x00, 0x7F  # blank tape, and a row punched over to delete it

_ENCODE = str.maketrans({letter: chr(row) for letter, row in CODE.items()})
_DECODE = bytes.maketrans(bytes(CODE.values()), "".join(CODE).encode("ascii"))
_KNOWN = bytes([*CODE.values(), LEADER, RUBOUT])


def is_eia(data: bytes) -> bool:
    """Whether every row is a known one and lines end as EIA lines do (ASCII has no byte 0x80)."""
    return CODE["\n"] in data and not data.translate(None, _KNOWN)


def decode(data: bytes) -> bytes:
    """The tape as ASCII, blank rows and rubouts left out. Complaint 'not-text' for a row that is none of the code's."""
    if unknown := data.translate(None, _KNOWN):
        raise Complaint("not-text", f"tape row {unknown[0]:#04x}")
    return data.translate(_DECODE, bytes([LEADER, RUBOUT]))


def encode(text: str) -> bytes:
    """The text as tape rows; Complaint 'not-text' for a character the code has no row for."""
    upper = text.upper()
    if missing := set(upper) - set(CODE):
        raise Complaint("not-text", "".join(sorted(missing)))
    return upper.translate(_ENCODE).encode("latin-1")
