"""Reports that CAD programs leave beside a drill file: sizes of tools and the number format.

Rule: they only fill gaps; what the drill file says itself is stronger (facts.py). Allegro's nc_param.txt and
ncdrill.log, EAGLE's .dri, Protel's .DRR and .TOL, Ultiboard's .rep and bare tables `T1 0.0300 13`.
`reader` finds them and calls `hear`.
"""

from __future__ import annotations

import errno
from pathlib import Path

from drillctl.files.inputs import read_bytes
from drillctl.language import Message

from .comments import declare, find, patterns
from .errors import Remark
from .facts import Facts, Voice

NAMES = frozenset({"nc_param.txt", "ncdrill.log"})  # one for the whole folder
SUFFIXES = frozenset({".dri", ".drr", ".tol", ".rep", ".rpt"})  # with the drill file's own stem
BYTE_LIMIT = 1_000_000
LINE_LIMIT = 2_000
TOO_LONG = b" " * (BYTE_LIMIT + 1)  # stands for a report that was not read; it is told

# Group names as in comments.py; `tens`, `whole_mask` and `fraction_mask` are counted, not read.
PATTERNS = patterns(
    # Allegro nc_param.txt, repeated in ncdrill.log
    r"^\s*FORMAT\s+(?P<integer>\d)\.(?P<decimal>\d)\s*$",
    r"^\s*INTEGER-PLACES\s+(?P<integer>\d)\s*$",
    r"^\s*DECIMAL-PLACES\s+(?P<decimal>\d)\s*$",
    r"^\s*OUTPUT-UNITS\s+(?P<units>\w+)",
    r"^\s*SUPPRESS-(?P<zeros>LEAD|TRAIL)-ZEROES\s+YES",
    # EAGLE .dri: Units : 1/10000 Inch
    r"^\s*Units\s*:\s*1/1(?P<tens>0+)\s*(?P<units>\w+)",
    # Protel .DRR: T1  31mil (0.7874mm)  [tolerance] [Round]  12 ...
    r"^\s*T(?P<tool>\d+)\s+[\d.]+\s*mil \((?P<size>\d+\.?\d*)(?P<size_units>mm)\)"
    r"(?:\s+\S+mil \(\S+mm\))?(?:\s+[A-Z]+)?\s+(?P<count>\d+)\b",
    # Ultiboard .rep
    r"^\s*Coord format\s*:\s*(?P<whole_mask>N+)(?P<fraction_mask>D+)",
    r"^\s*Units\s*:\s*(?P<units>\w+)\s*$",
    # tool tables: T01 0.0236inch 14 / 2 0.820 mm 47 / T1 0.0300 13
    r"^\s*(?:T(?P<tool>\d+)|(?P<index>\d+))\s+(?P<size>\d*\.\d+|\d+(?=\s*[mi]))"
    r"\s*(?P<size_units>mm|mils?|inch|in)?(?:\s+(?P<count>\d+))?\s*$",
)
ZERO_WORDS = {"LEAD": "leading", "TRAIL": "trailing"}
COUNTED = {"tens": "decimal", "whole_mask": "integer", "fraction_mask": "decimal"}


def beside(path: Path) -> dict[str, bytes]:
    """The reports beside a drill file, by name; of a longer one TOO_LONG."""
    found = {}
    for near in sorted(path.parent.iterdir()):
        if _belongs(near, path) and near.is_file():
            try:
                found[near.name] = read_bytes(near, BYTE_LIMIT, Message("a report"))
            except OSError as error:
                if error.errno != errno.EFBIG:
                    raise
                found[near.name] = TOO_LONG
    return found


def _belongs(near: Path, path: Path) -> bool:
    if near.name == path.name:
        return False
    same_stem = near.stem.lower() == path.stem.lower()
    return near.name.lower() in NAMES or (same_stem and near.suffix.lower() in SUFFIXES)


def hear(name: str, data: bytes, facts: Facts) -> None:
    """Note what one report declares; text that is no such report declares nothing."""
    format_groups: dict[str, str] = {}
    lines = data[:BYTE_LIMIT].decode("latin-1").splitlines()
    if len(data) > BYTE_LIMIT or len(lines) > LINE_LIMIT:
        facts.remarks.append(Remark("side-file-cut", None, name))
    for line in lines[:LINE_LIMIT]:
        groups = find(line, PATTERNS)
        if "size" in groups:
            declare(groups, name, None, Voice.SIDE_FILE, facts)
        else:
            format_groups.update(_counted(groups))
    declare(format_groups, name, None, Voice.SIDE_FILE, facts)


def _counted(groups: dict[str, str]) -> dict[str, str]:
    """Masks and powers of ten as places, Allegro's words as everybody's."""
    places = {COUNTED[name]: str(len(text)) for name, text in groups.items() if name in COUNTED}
    if "tens" in groups:
        places["integer"] = "2"  # EAGLE drops leading zeros, so the whole part's width is only a name
    if "zeros" in groups:
        places["zeros"] = ZERO_WORDS[groups["zeros"].upper()]
    return {**groups, **places}
