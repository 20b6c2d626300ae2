"""Holes for registration pins: a board of two sides that is turned over on its pins lies where it lay.

Rule: pins are holes of the drill file like all others, with a tool of their own behind the file's, and symmetrical to
both middle lines of the board, so that turning it over about either puts them on each other. ``placing.py`` mirrors a
board with pins about that middle. The side that is not mirrored drills them; the mirrored one finds them drilled.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drillctl.generation.placing import PlacingError
from drillctl.language import Message
from drillctl.viewmodel.job_options import PinsOf

if TYPE_CHECKING:
    from drillctl.generation.drillfile import DrillFile

LEAST_DIAMETER_MM, MOST_DIAMETER_MM = 0.1, 50.0
# Where the pins are, seen from the middle, in half widths and half heights of the board with its margin.
PLACES = {
    "corners": ((-1, -1), (1, -1), (-1, 1), (1, 1)),
    "left-right": ((-1, 0), (1, 0)),
    "top-bottom": ((0, -1), (0, 1)),
}
Floats = NDArray[np.float64]


class Pinned(NamedTuple):
    """A drill file with pins, and the number of their tool."""

    drill_file: "DrillFile"
    tool: int


def with_pins(drill_file: "DrillFile", pins: PinsOf) -> Pinned:
    """Adds the pins to a file, behind its holes. Raises PlacingError for pins that cut into holes, or that nobody
    has.
    """
    from drillctl.generation.drillfile import Tool

    _check(drill_file, pins)
    places = pin_places(drill_file, pins)
    number = 1 + max((tool.number for tool in drill_file.tools), default=0)
    index = np.full(len(places), len(drill_file.tools), drill_file.hole_tool.dtype)
    pinned = replace(
        drill_file,
        tools=(*drill_file.tools, Tool(number, pins.diameter_mm)),
        hole_xy_mm=np.concatenate([drill_file.hole_xy_mm, places]),
        hole_tool=np.concatenate([drill_file.hole_tool, index]),
        hole_line=np.concatenate([drill_file.hole_line, np.zeros(len(places), drill_file.hole_line.dtype)]),
    )
    return Pinned(pinned, number)


def pin_places(drill_file: "DrillFile", pins: PinsOf) -> Floats:
    """(pins, 2): where the pins are, in mm of the file: so far outside the extent of holes and slots, which is all that
    a drill file tells of a board's outline.
    """
    x0, y0, x1, y1 = drill_file.bbox_mm or (0.0, 0.0, 0.0, 0.0)
    half = np.array([x1 - x0, y1 - y0]) / 2 + pins.margin_mm
    places: Floats = np.array([x0 + x1, y0 + y1]) / 2 + np.array(PLACES[pins.where]) * half
    return places


def _check(drill_file: "DrillFile", pins: PinsOf) -> None:
    if not LEAST_DIAMETER_MM <= pins.diameter_mm <= MOST_DIAMETER_MM:
        raise PlacingError(
            Message(
                "pins of {diameter:g} mm; from {least:g} to {most:g} mm are possible",
                diameter=pins.diameter_mm,
                least=LEAST_DIAMETER_MM,
                most=MOST_DIAMETER_MM,
            )
        )
    largest_mm = max((tool.diameter_mm or 0.0 for tool in drill_file.tools), default=0.0)
    least_mm = (pins.diameter_mm + largest_mm) / 2
    if not pins.margin_mm >= least_mm:
        raise PlacingError(
            Message(
                "pins of {diameter:g} mm need a margin of {least:g} mm or more: half of a pin and of the largest drill",
                diameter=pins.diameter_mm,
                least=least_mm,
            )
        )
