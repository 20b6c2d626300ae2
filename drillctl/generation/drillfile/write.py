"""Writes a clean drill file. Rule: what `decode` reads back is the same board, to the format's resolution.

Excellon with a header that declares everything; or the header-less body of OrCAD and PADS, which declares
nothing; either as ASCII or as EIA tape code.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from . import eia
from .model import MM_PER_UNIT, DrillFile, Floats, FormatChoice, Tool
from .recognise import parse_option

KEYWORD = {"inch": "INCH", "mm": "METRIC"}
KEPT = {"leading": ",TZ", "trailing": ",LZ", "none": "", None: ""}  # LZ and TZ name the zeros that stay
DECIMAL_PLACES = 6  # with a point: 1 nm, or 25 nm in inch


def write(drill_file: DrillFile, fmt: str = "mm,decimal", *, header: bool = True, tape_code: bool = False) -> bytes:
    """The file's bytes. fmt as in `read`: 'inch,2:4,leading', 'mm,decimal'...

    header False leaves out every declaration; tape_code punches EIA RS-244. ValueError when a coordinate
    has more places than the format, Complaint 'bad-format' for an fmt that can't be read.
    """
    choice = parse_option(fmt)
    numbers = _distinct_numbers(drill_file.tools)
    lines = [*(_header(drill_file.tools, numbers, choice) if header else ["%"])]
    lines += _body(drill_file, numbers, choice, define=not header)
    text = "\n".join([*lines, "M30", ""])
    return eia.encode(text) if tape_code else text.encode("ascii")


def _distinct_numbers(tools: tuple[Tool, ...]) -> list[int]:
    """The tools' own numbers, or 1, 2, 3... where two tools share one."""
    own = [tool.number for tool in tools]
    return own if len(set(own)) == len(own) else list(range(1, len(own) + 1))


def _header(tools: tuple[Tool, ...], numbers: list[int], choice: FormatChoice) -> Iterator[str]:
    mask = ",{}.{}".format(*("0" * places for places in choice.digits)) if choice.digits else ""
    yield "M48"
    yield KEYWORD[choice.units] + KEPT[choice.zeros] + mask
    for tool, number in zip(tools, numbers, strict=True):
        yield _definition(tool, number, choice)
    yield "%"


def _definition(tool: Tool, number: int, choice: FormatChoice) -> str:
    if tool.diameter_mm is None:
        return f"T{number:02d}"
    return f"T{number:02d}C{_point(tool.diameter_mm / MM_PER_UNIT[choice.units])}"


def _body(drill_file: DrillFile, numbers: list[int], choice: FormatChoice, *, define: bool) -> Iterator[str]:
    """Holes and slots in file order, with a T line where the tool changes; define: at its first use, with C."""
    selected, defined = -1, set[int]()
    for tool, sentence in _sentences(drill_file, choice):
        if tool != selected:
            if define and tool not in defined:
                yield _definition(drill_file.tools[tool], numbers[tool], choice)
            else:
                yield f"T{numbers[tool]:02d}"
            selected = tool
            defined.add(tool)
        yield sentence


def _sentences(drill_file: DrillFile, choice: FormatChoice) -> Iterator[tuple[int, str]]:
    """Tool and coordinate line of each hole and slot; a slot comes before the hole whose index it has."""
    slots = iter(zip(drill_file.slot_at.tolist(), drill_file.slot_tool.tolist(), drill_file.slot_mm, strict=True))
    slot = next(slots, None)
    for index, tool in enumerate([*drill_file.hole_tool.tolist(), None]):
        while slot and slot[0] == index:
            yield slot[1], f"{_place(slot[2][:2], choice)}G85{_place(slot[2][2:], choice)}"
            slot = next(slots, None)
        if tool is not None:
            yield tool, _place(drill_file.hole_xy_mm[index], choice)


def _place(xy_mm: Floats, choice: FormatChoice) -> str:
    x, y = (xy_mm / MM_PER_UNIT[choice.units]).tolist()
    return f"X{number(x, choice)}Y{number(y, choice)}"


def number(value: float, choice: FormatChoice) -> str:
    """A coordinate in file units as the format writes it. ValueError when it does not fit."""
    if choice.digits is None:
        return _point(value)
    integer, decimal = choice.digits
    digits = str(int(np.rint(abs(value) * 10**decimal))).zfill(integer + decimal)
    if len(digits) > integer + decimal:
        raise ValueError(f"{value} has more than {integer} places before the point")
    shown = {"leading": digits.lstrip("0"), "trailing": digits.rstrip("0")}.get(choice.zeros or "", digits)
    return ("-" if value < 0 and digits.strip("0") else "") + (shown or "0")


def _point(value: float) -> str:
    """With a decimal point and no idle zeros, but at least one place: 12.7, 5.0."""
    text = f"{value:.{DECIMAL_PLACES}f}".rstrip("0")
    return text + "0" if text.endswith(".") else text
