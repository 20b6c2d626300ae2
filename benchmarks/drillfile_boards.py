"""Makes random boards, writes them in every way of declaring a number format, and judges how they are read.

    python benchmarks/drillfile_boards.py [COUNT] [--seed N]      2,000 boards by default

The writer here shares nothing with drillctl's own. A board is read right, wrong and told (a warning says so),
refused, or silently wrong; every one of the last kind is printed with its file. The tables stand in
docs/DRILL-FILES.md.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from drillctl.generation.drillfile import DrillFile, DrillFileError, decode

Random = random.Random
Place = tuple[float, float]
Hole = tuple[float, float, float]  # x, y, diameter in mm

MM = {"inch": 25.4, "mm": 1.0}
RULE = {"inch": (2, 4), "mm": (3, 3)}
WORD = {"inch": "INCH", "mm": "METRIC"}
CODE = {"inch": "M72", "mm": "M71"}
COMMENT_UNITS = {"inch": ("inch", "Inch", "INCHES"), "mm": ("metric", "MM", "MM")}  # KiCad, Mentor, anybody
KICAD_ZEROS = {
    "leading": "suppress leading zeros",
    "trailing": "suppress trailing zeros",
    "none": "keep zeros",
    None: "decimal",
}
KEPT = {"leading": "TZ", "trailing": "LZ"}
# Digits as CAD programs write them where they may choose, each with its share.
WRITTEN = {
    "inch": {(2, 4): 80, (2, 3): 8, (2, 5): 8, (3, 3): 4},
    "mm": {(3, 3): 75, (4, 2): 10, (3, 2): 5, (4, 4): 10},
}
OTHER = {"inch": [(2, 3), (2, 5), (3, 3)], "mm": [(4, 2), (3, 2), (4, 4)]}
OUTCOMES = ("right", "told", "refused", "silent")
BINS = (0.98, 0.9, 0.7, 0.0)


# -- boards -----------------------------------------------------------------------------------------


def spread(rng: Random, low: float, high: float) -> float:
    """A length between low and high, each factor as likely."""
    return float(low * (high / low) ** rng.random())


def corners(rng: Random) -> list[Hole]:
    """Four mounting holes."""
    step = rng.choice((1.0, 0.5, 2.54, 0.1))
    width, height = (step * round(spread(rng, low, high) / step) for low, high in ((30, 220), (25, 160)))
    x, y = (step * rng.randrange(1, 12) for _ in range(2))
    drill = rng.choice((2.2, 2.7, 3.0, 3.2, 3.5, 4.3))
    return [(x + i * width, y + j * height, drill) for j in (0, 1) for i in (0, 1)]


def few(rng: Random) -> list[Hole]:
    """Two to seven holes on a grid."""
    step, side = rng.choice((0.5, 1.0, 1.27, 2.54)), spread(rng, 20, 160)
    drills = rng.sample((0.6, 0.8, 0.9, 1.0, 1.3, 3.2), 2)
    holes: list[Hole] = []
    for _ in range(300):
        x_mm, y_mm = (step * rng.randrange(1, int(side / step)) for _ in range(2))
        hole = (x_mm, y_mm, rng.choice(drills))
        if all(np.hypot(hole[0] - x, hole[1] - y) > hole[2] + drill for x, y, drill in holes):
            holes.append(hole)
        if len(holes) == 7:
            break
    return holes[: rng.randrange(2, 8)]


def slots(rng: Random) -> list[Hole]:
    """Slots drawn as rows of overlapping hits, with some pads or without any."""
    holes = few(rng) if rng.random() < 0.7 else []
    drill, pitch = rng.choice((0.8, 1.0, 1.3)), rng.choice((0.1, 0.2, 0.25, 0.5))
    for _ in range(rng.randrange(1, 4)):
        x, y = (round(spread(rng, 5, 120), 1) for _ in range(2))
        upright = rng.random() < 0.4
        for hit in range(rng.randrange(2, 24)):
            holes.append((x + pitch * hit * (not upright), y + pitch * hit * upright, drill))
    return holes


def larger(rng: Random) -> list[Hole]:
    """Rows of pins on a grid, vias anywhere, four mounting holes: 20 to 400 holes."""
    step = rng.choice((0.5, 1.0, 1.27, 2.54))
    pitch = 2.54 if step > 1 else rng.choice((2.0, 2.5, 2.54))
    width, height = spread(rng, 35, 200), spread(rng, 30, 150)
    holes = [(x, y, 3.2) for x in (4.0, round(width)) for y in (4.0, round(height))]
    for _ in range(rng.randrange(2, 16)):
        x, y = step * rng.randrange(8, int(width / step)), step * rng.randrange(8, int(height / step))
        rows, pins = rng.choice((1, 2, 2)), rng.randrange(2, 14)
        drill = rng.choice((0.8, 0.9, 1.0))
        holes += [(x + pitch * pin, y + 7.62 * row, drill) for row in range(rows) for pin in range(pins)]
    vias = rng.choice((0, 20, 80))
    holes += [(round(rng.uniform(4, width), 2), round(rng.uniform(4, height), 2), 0.4) for _ in range(vias)]
    return holes


KINDS: dict[str, Callable[[Random], list[Hole]]] = {
    "four corner holes": corners,
    "two to seven holes": few,
    "slots drawn as hits": slots,
    "20 to 400 holes": larger,
}


# -- ways of declaring ------------------------------------------------------------------------------


@dataclass
class Way:
    """How a board is written: units and digits it has, zeros dropped (None: decimal points), and what is said by
    which voice; case names the row of the second table."""

    units: str
    digits: tuple[int, int] | None
    zeros: str | None
    units_by: str
    digits_by: str
    zeros_by: str
    sizes: bool = True  # the tools have diameters
    whole_part: bool = False  # zeros dropped at the end leave the integer places in full: 010 for 10
    modal: bool = False  # an axis that stays is not written again
    case: str = ""


HABITS = {"sizes": 0.93, "whole_part": 0.2, "modal": 0.3}  # shares
UNIT_VOICES = ("word", "word", "word", "code", "coded zeros", "kicad", "mentor", "comment", "side", "nothing")


def choose(rng: Random) -> Way:
    """A way of declaring, every combination that a file can have."""
    units = rng.choice(("inch", "mm"))
    units_by = rng.choice(UNIT_VOICES)
    zeros = rng.choice(("leading", "trailing", "none", None))
    whole = units_by in ("kicad", "mentor")
    digits_by = units_by if whole else rng.choice(("mask", "file format", "nothing", "nothing"))
    if units_by in ("side", "nothing", "comment", "code") and digits_by == "mask":
        digits_by = "side" if units_by == "side" else "file format"
    by_word = units_by in ("word", "coded zeros") and rng.random() < 0.7
    zeros_by = units_by if whole else "word" if by_word else "nothing"
    habits = {name: rng.random() < share for name, share in HABITS.items()}
    way = Way(units, None, zeros, units_by, digits_by, zeros_by, **habits)
    if zeros is not None:
        way.digits = _digits(rng, way)
    way.case = _case(way)
    return way


def choose_broken(rng: Random) -> Way:
    """A unit without digits, and numbers that do not have the unit's default digits: a wrong file."""
    while True:
        way = choose(rng)
        if way.case in ("units alone", "units and zeros"):
            way.digits = rng.choice(OTHER[way.units])
            return way


def _digits(rng: Random, way: Way) -> tuple[int, int]:
    """The digits it is written in: what the unit's rule says, unless others are declared or nothing is."""
    if way.digits_by == "nothing" and way.units_by != "nothing":
        return RULE[way.units]
    shares = WRITTEN[way.units]
    return rng.choices(list(shares), list(shares.values()))[0]


def _case(way: Way) -> str:
    if way.zeros is None:
        return "decimal points" if way.units_by != "nothing" else "decimal points, no units"
    if way.units_by == "nothing":
        return "nothing" if way.digits_by == "nothing" else "digits, no units"
    if way.digits_by != "nothing":
        return "units and digits"
    return "units and zeros" if way.zeros_by == "word" and way.zeros != "none" else "units alone"


# -- the writer -------------------------------------------------------------------------------------


def number(value_mm: float, way: Way) -> tuple[str, float]:
    """The number's text, and the millimetres that it says."""
    value = value_mm / MM[way.units]
    if way.digits is None:
        text = f"{value:.4f}"
        return text.rstrip("0") if way.units == "mm" else text, float(text) * MM[way.units]
    integer, decimal = way.digits
    steps = round(value * 10**decimal)
    text = f"{abs(steps):0{integer + decimal}d}"
    if way.zeros == "leading":
        text = text.lstrip("0") or "0"
    if way.zeros == "trailing":
        kept = integer if way.whole_part else 1
        text = text[:kept] + text[kept:].rstrip("0")
    return ("-" if steps < 0 else "") + text, steps / 10**decimal * MM[way.units]


def comments(way: Way) -> Iterator[str]:
    """What comments declare."""
    kicad, mentor, anybody = COMMENT_UNITS[way.units]
    digits = "-:-" if way.digits is None else "{}:{}".format(*way.digits)
    if way.units_by == "kicad":
        yield f"; FORMAT={{{digits}/ absolute / {kicad} / {KICAD_ZEROS[way.zeros]}}}"
    if way.units_by == "mentor" and way.digits:
        yield f"; Format  : {digits.replace(':', '.')} / Absolute / {mentor} / {(way.zeros or '').title()}"
    elif way.units_by in ("comment", "mentor"):
        yield f"; Units: {anybody}"
    if way.digits_by == "file format" and way.digits:
        yield f";FILE_FORMAT={digits}"


def declaration(way: Way) -> Iterator[str]:
    """The unit's line of the header."""
    kept = f",{KEPT[way.zeros]}" if way.zeros in KEPT and way.zeros_by == "word" else ""
    mask = ",{}.{}".format(*("0" * places for places in way.digits)) if way.digits and way.digits_by == "mask" else ""
    if way.units_by == "word":
        yield WORD[way.units] + kept + mask
    if way.units_by in ("code", "coded zeros"):
        yield CODE[way.units] + kept + mask


def reports(way: Way) -> dict[str, bytes]:
    """The report beside the file."""
    if way.units_by != "side":
        return {}
    lines = [f"OUTPUT-UNITS {'ENGLISH' if way.units == 'inch' else 'METRIC'}"]
    if way.digits_by == "side" and way.digits:
        lines.append("FORMAT {}.{}".format(*way.digits))
    return {"nc_param.txt": "\n".join(lines).encode()}


def diameter(drill_mm: float, way: Way) -> str:
    places = 4 if way.units == "inch" else 3
    return f"{drill_mm / MM[way.units]:.{places}f}"


def coordinates(xy: tuple[str, str], last: tuple[str, str], way: Way) -> str:
    """A hole's line."""
    kept = [not (way.modal and text == before) for text, before in zip(xy, last, strict=True)]
    return "".join(axis + text for axis, text, write in zip("XY", xy, kept, strict=True) if write) or f"X{xy[0]}"


def compose(holes: list[Hole], way: Way) -> tuple[bytes, list[Place]]:
    """The file, and the places it says (mm)."""
    drills = sorted({hole[2] for hole in holes})
    lines = ["M48", *comments(way), *declaration(way)]
    lines += [f"T{tool}" + (f"C{diameter(drill, way)}" if way.sizes else "") for tool, drill in enumerate(drills, 1)]
    lines.append("%")
    places: list[Place] = []
    for tool, drill in enumerate(drills, 1):
        lines.append(f"T{tool}")
        last: tuple[str, str] = ("", "")
        for x_mm, y_mm, _ in (hole for hole in holes if hole[2] == drill):
            (x, x_said), (y, y_said) = number(x_mm, way), number(y_mm, way)
            lines.append(coordinates((x, y), last, way))
            places.append((x_said, y_said))
            last = x, y
    return "\n".join([*lines, "M30", ""]).encode(), places


# -- judging ----------------------------------------------------------------------------------------


@dataclass
class Verdict:
    """How one board was read; confidence None where it was refused."""

    kind: str
    way: Way
    outcome: str
    confidence: float | None
    text: bytes
    said: str


def judge(rng: Random, choose_way: Callable[[Random], Way]) -> Verdict:
    """One random board, written, read and judged."""
    kind = rng.choice(list(KINDS))
    way = choose_way(rng)
    text, places = compose(KINDS[kind](rng), way)
    try:
        found = decode(text, name="board.drl", side_files=reports(way))
    except DrillFileError as error:
        return Verdict(kind, way, "refused", None, text, str(error))
    return Verdict(kind, way, outcome(found, places), found.confidence, text, f"{found.format}: {found.reason}")


def outcome(found: DrillFile, places: list[Place]) -> str:
    """right, told or silent."""
    if found.hole_xy_mm.shape == (len(places), 2) and np.allclose(found.hole_xy_mm, places, rtol=0, atol=1e-3):
        return "right"
    return "told" if found.warnings else "silent"


def campaign(count: int, seed: int, choose_way: Callable[[Random], Way] = choose) -> list[Verdict]:
    """Verdicts on count boards; the same seed gives the same boards."""
    rng = random.Random(seed)
    return [judge(rng, choose_way) for _ in range(count)]


# -- tables -----------------------------------------------------------------------------------------


def table(name: str, verdicts: Iterable[Verdict], row: Callable[[Verdict], str]) -> Iterator[str]:
    """A Markdown table of outcomes by row."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for verdict in verdicts:
        for each in (row(verdict), "all"):
            counts[each][verdict.outcome] += 1
    yield f"| {name} | boards | right | wrong, told | refused | silently wrong |"
    yield "|---|---|---|---|---|---|"
    for each in [*sorted(set(counts) - {"all"}), "all"]:
        total = counts[each].total()
        figures = [f"{counts[each]['right'] / total:.1%}", *(str(counts[each][outcome]) for outcome in OUTCOMES[1:])]
        yield f"| {each} | {total} | {' | '.join(figures)} |"


def calibration(verdicts: Iterable[Verdict]) -> Iterator[str]:
    """A Markdown table: how often a confidence is right."""
    read = [verdict for verdict in verdicts if verdict.confidence is not None]
    yield "| confidence said | boards | said on average | right |"
    yield "|---|---|---|---|"
    above = 2.0
    for least in BINS:
        some = [verdict for verdict in read if least <= (verdict.confidence or 0) < above]
        if some:
            said = sum(verdict.confidence or 0 for verdict in some) / len(some)
            right = sum(verdict.outcome == "right" for verdict in some) / len(some)
            yield f"| {least:.0%} and more | {len(some)} | {said:.1%} | {right:.1%} |"
        above = least


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int, nargs="?", default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--show", choices=OUTCOMES, nargs="*", default=["silent"], help="outcomes printed in full")
    arguments = parser.parse_args()
    verdicts = campaign(arguments.count, arguments.seed)
    broken = campaign(max(1, arguments.count // 5), arguments.seed, choose_broken)
    for verdict in [*verdicts, *broken]:
        if verdict.outcome in arguments.show:
            print(verdict.outcome, verdict.kind, verdict.way, verdict.said, verdict.text.decode()[:600], sep="\n")
    print(f"{arguments.count} boards, seed {arguments.seed}", "", sep="\n")
    print(*table("kind", verdicts, lambda verdict: verdict.kind), "", sep="\n")
    print(*table("declared", verdicts, lambda verdict: verdict.way.case), "", sep="\n")
    print(*calibration(verdicts), "", sep="\n")
    print(*table("unit declared, its rule broken", broken, lambda verdict: verdict.kind), sep="\n")


if __name__ == "__main__":
    main()
