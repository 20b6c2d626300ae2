"""Rows of holes as sentences: ``pattern.toml`` says where they are and how they are drilled.

    depth_mm = 40.0          # how far the tool goes in, from where it was set
    approach_mm = 8.0        # how much of that is way in, before the wall
    [gears]
    along = "C"              # large carriage, from hole to hole
    in = "C"                 # tool to the wall
    feed = "2"               # tool through the wall
    out = "C"                # tool back
    [[row]]                  # one or more, one after the other along the drum
    start_mm = 50.0          # the first hole, from where the tool was set
    pitch_mm = 120.0
    count = 8

Rule: lengths are whole tenths of a millimetre, refused by line where they are not. After the last hole the large
carriage returns to where it began. The drum is turned by hand, so a pattern is one line of holes along it.
"""

import re
from pathlib import Path
from typing import Annotated

import msgspec

from drillctl.generation.boiler_drum.gears import LETTERS
from drillctl.generation.boiler_drum.sentence import Sentence, way
from drillctl.generation.boiler_drum.text import MOST_SENTENCES
from drillctl.generation.errors import JobError
from drillctl.language import Message
from drillctl.machine.source import Source

ENDING = ".toml"
ALONG, TOOL = "x", "y"
MOST_MM = 100_000
MOST_ROWS = 1000
BEFORE_VALUE = r"(?<![\w-])[\"']?{key}[\"']?\s*=\s*"  # a key as it is written in a table, in quotes or not
Gear = str | int  # a gear from 0 to 9 may be written without quotes
Count = Annotated[int, msgspec.Meta(ge=1, le=MOST_SENTENCES)]
Millimetres = Annotated[float, msgspec.Meta(ge=-MOST_MM, le=MOST_MM)]
Length = Annotated[float, msgspec.Meta(ge=0, le=MOST_MM)]


class _Gears(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    along: Gear
    into: Gear = msgspec.field(name="in")
    feed: Gear
    out: Gear


class _Row(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    start_mm: Millimetres
    count: Count
    pitch_mm: Millimetres = 0.0


class _File(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    depth_mm: Length
    gears: _Gears
    row: Annotated[list[_Row], msgspec.Meta(min_length=1, max_length=MOST_ROWS)]
    approach_mm: Length = 0.0


def read_pattern(file: Path) -> list[Sentence]:
    """Returns the sentences of a pattern's file. Raises TableError or JobError, with file and line."""
    return pattern_sentences(Source.read(file))


def pattern_sentences(source: Source) -> list[Sentence]:
    """Like ``read_pattern``, from a text."""
    wanted = source.records(_File)
    depth, approach = (_tenths(source, getattr(wanted, key), key) for key in ("depth_mm", "approach_mm"))
    if not 0 <= approach < depth:
        raise source.error(Message("approach_mm must be less than depth_mm: the tool drills nothing"), "depth_mm")
    along, *of_tool = _gears(source, wanted.gears)
    hole = _hole(of_tool, depth, approach)
    sentences: list[Sentence] = []
    here = 0
    for place in _places(source, wanted.row):
        sentences += [*way(ALONG, place - here, along), *hole]
        here = place
        if len(sentences) > MOST_SENTENCES:
            raise JobError(Message("more than {most} sentences", most=MOST_SENTENCES).at(source.file))
    return [*sentences, *way(ALONG, -here, along)]


def _gears(source: Source, gears: _Gears) -> list[int]:
    """Returns the gears 0 to 15 of the way along, in, feed and out. Raises JobError that names each wrong one."""
    written = {key: str(gear) for key, gear in msgspec.to_builtins(gears).items()}
    wrong = [key for key, gear in written.items() if len(gear) != 1 or gear.upper() not in LETTERS]
    if wrong:
        raise JobError(*(_no_gear(source, key, written[key]) for key in wrong))
    return [int(written[key], 16) for key in ("along", "in", "feed", "out")]


def _no_gear(source: Source, key: str, gear: str) -> Message:
    line = source.line_of("gears", key) or 1
    value = re.search(BEFORE_VALUE.format(key=key), source.text.split("\n")[line - 1])
    reason = Message("{gear!r} is no gear; gears are 0 to 9 and A to F, one character", gear=gear)
    return reason.at(source.file, line, value.end() + 1 if value else 1)


def _hole(gears: list[int], depth: int, approach: int) -> list[Sentence]:
    into, feed, out = gears
    return [*way(TOOL, approach, into), *way(TOOL, depth - approach, feed), *way(TOOL, -depth, out)]


def _places(source: Source, rows: list[_Row]) -> list[int]:
    """Returns where the holes are along the drum, in tenths of a millimetre."""
    places: list[int] = []
    for index, row in enumerate(rows):
        start, pitch = (_tenths(source, getattr(row, key), "row", index, key) for key in ("start_mm", "pitch_mm"))
        if row.count > 1 and not pitch:
            raise source.error(Message("pitch_mm is 0: all holes of the row would be one"), "row", index, "pitch_mm")
        places += [start + pitch * number for number in range(row.count)]
        if len(places) > MOST_SENTENCES:
            raise source.error(Message("more than {most} sentences", most=MOST_SENTENCES), "row", index)
    return places


def _tenths(source: Source, length_mm: float, *place: str | int) -> int:
    tenths = round(length_mm * 10)
    if abs(length_mm * 10 - tenths) > 1e-6:  # what a decimal fraction may be off as a float
        raise source.error(Message("{length} mm is no whole number of tenths", length=length_mm), *place)
    return tenths
