"""The magazine: places, each with a bit for every spindle, side by side along X.

Rule: places are millimetres from machine zero, as the parameters have them.
"""

from collections.abc import Callable, Mapping

from drillctl.machine import Machine
from drillctl.plant.faults import Faults

NEAR_MM = 0.2  # a chuck as near as this to a bit's place can leave or take it
LEAST_DEPTH_MM = 0.5  # above the change height: from here on a bit is in its place

Bit = tuple[int, int]  # number of the place, number of the spindle


class Magazine:
    """The places of a machine's magazine.

    places   X and Y in mm of the first spindle's bit, by number
    pitches  mm between neighbouring spindles, and between their bits in one place
    plane    the axes that carry the spindles over the places
    missing  by spindle, the number of a place that has no bit for it
    """

    def __init__(self, places: Mapping[int, tuple[float, float]], pitches: tuple[float, float], height_mm: float,
                 plane: tuple[int, int], missing: Mapping[int, int]):  # fmt: skip
        self._places, self._pitches, self._height_mm, self._plane = places, pitches, height_mm, plane
        self._bits: dict[Bit, bool] = {(place, spindle): False for spindle, place in missing.items()}

    def reached(self, height_mm: float) -> bool:
        """Whether a head at this height is in a place."""
        return height_mm >= self._height_mm - LEAST_DEPTH_MM

    def bit_under(self, spindle: int, head: int, place_mm: Callable[[int], float]) -> Bit | None:
        """Returns the place of a bit that a spindle is lowered to, or None where it is over none or too high."""
        if not self.reached(place_mm(head)):
            return None
        x_mm, y_mm = map(place_mm, self._plane)
        spindle_mm, bit_mm = ((spindle - 1) * pitch for pitch in self._pitches)
        for place, (at_x_mm, at_y_mm) in self._places.items():
            off_x_mm = x_mm + spindle_mm - at_x_mm - bit_mm
            if abs(off_x_mm) <= NEAR_MM and abs(y_mm - at_y_mm) <= NEAR_MM:
                return place, spindle
        return None

    def put(self, bit: Bit) -> bool:
        """Takes a bit into its place; False where one stands there already."""
        if self._bits.get(bit, False):
            return False
        self._bits[bit] = True
        return True

    def take(self, bit: Bit) -> bool:
        """Gives a bit away; False where none stands there."""
        there = self._bits.get(bit, True)
        self._bits[bit] = False
        return there


def magazine_of(machine: Machine, known_faults: Faults | None = None) -> Magazine | None:
    """Returns the magazine of a machine with a tool changer, and places and a change height that are set; None for
    another.
    """
    parameters, changer = machine.parameters, machine.tool_changer
    plane = machine.axis_index("x"), machine.axis_index("y")
    if parameters is None or changer is None or plane[0] is None or plane[1] is None:
        return None
    height_mm = parameters.number("system", "change_height_mm")
    places = {
        int(number): (x_mm, y_mm)
        for row in parameters.places
        if (number := row.number("place")) is not None
        and (x_mm := row.number("x_mm")) is not None
        and (y_mm := row.number("y_mm")) is not None
    }
    if height_mm is None or not places:
        return None
    missing = {}
    for spindle, axis in enumerate(machine.drill_axes, start=1):
        place = known_faults.of("missing", machine.axes[axis].name) if known_faults else None
        if place is not None:
            missing[spindle] = int(place)
    pitches = changer.spindle_pitch_mm, changer.magazine_pitch_mm
    return Magazine(places, pitches, height_mm, (plane[0], plane[1]), missing)
