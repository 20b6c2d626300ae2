"""Every parameter that a machine can have: group, name, unit, bounds, meaning and effect, one row each.

Rule: data alone. parameter_file.py checks files by these rows, the screen's dialogs and ``drillctl parameters`` are
made of them. Names, groups and meanings: "Research on Open Drilling Machine CNC System Software", section 3; the
bounds are this program's own.
"""

from collections.abc import Mapping
from typing import NamedTuple

from drillctl.language.words import N_

Value = bool | int | float | str

AXIS, SYSTEM, MAGAZINE, MACHINING, TOOL, COORDINATES = (
    "axis", "system", "magazine", "machining", "tool", "coordinates",
)  # fmt: skip
# The headings of the groups, in the order in which they are shown.
GROUPS: Mapping[str, str] = {
    AXIS: N_("axis parameters"),
    SYSTEM: N_("system parameters"),
    MAGAZINE: N_("places of the magazine"),
    MACHINING: N_("machining parameters"),
    TOOL: N_("tool parameters"),
    COORDINATES: N_("coordinates"),
}
LISTS: Mapping[str, str] = {MAGAZINE: "place", TOOL: "number"}  # groups of numbered rows, and the key of the number
OPTIONAL = frozenset({COORDINATES})  # the paper: all but the coordinates must be entered before machining


class Parameter(NamedTuple):
    """One parameter. ``kind`` is ``number``, ``whole``, ``switch`` (true, false) or ``choice``; ``low`` and ``high``
    are both allowed, in ``unit``; None where the kind has no bounds.
    """

    group: str
    name: str
    unit: str
    low: float | None
    high: float | None
    kind: str
    meaning: str
    effect: str
    choices: tuple[Value, ...] = ()


FASTEST_MM_MIN = 60_000
LONGEST_MM = 2_000
_TRAVEL = (-LONGEST_MM, LONGEST_MM)
_SPEED = (1, FASTEST_MM_MIN)

PARAMETERS = (
    Parameter(AXIS, "installed", "", None, None, "switch",
              N_("whether the machine has this axis"),
              N_("an axis that is not installed is left out of all work, and its other parameters need not be set")),
    Parameter(AXIS, "enabled", "", None, None, "switch",
              N_("whether the axis takes part in the work"),
              N_("a spindle that is not enabled stays up while the others drill; X and Y must be enabled")),
    Parameter(AXIS, "home_direction", "", None, None, "choice",
              N_("in which direction the axis looks for its origin switch: 1, -1, or 0 for an axis without one"),
              N_("it must agree with the homing table; a machine file in which it does not is refused"), (1, -1, 0)),
    Parameter(AXIS, "backlash_mm", "mm", 0, 10, "number",
              N_("how far the drive turns before the carriage follows, when the direction changes"),
              N_("holes are come to from below where it is more than 0")),
    Parameter(AXIS, "greatest_speed_mm_min", "mm/min", *_SPEED, "number",
              N_("the greatest speed of the axis"),
              N_("the highest state of the axis's ramp; one that the tick rate can't give is refused")),
    Parameter(AXIS, "acceleration_mm_min2", "mm/min²", 3_600, 360_000_000, "number",
              N_("the greatest acceleration of the axis; 3,600,000 mm/min² are 1 m/s²"),
              N_("how many steps the axis's ramp has up to the greatest speed")),
    Parameter(AXIS, "pulse_equivalent_mm", "mm", 0.0001, 1, "number",
              N_("the travel of one pulse, before the electronic gear"),
              N_("with the gear, how many pulses a millimetre has")),
    Parameter(AXIS, "gear_numerator", "", 1, 65_535, "whole",
              N_("the numerator of the electronic gear"),
              N_("pulses are multiplied by numerator / denominator, as an exact fraction")),
    Parameter(AXIS, "gear_denominator", "", 1, 65_535, "whole",
              N_("the denominator of the electronic gear"),
              N_("pulses are multiplied by numerator / denominator, as an exact fraction")),
    Parameter(AXIS, "feedback_direction", "", None, None, "choice",
              N_("the sign of the encoder's counts when the axis moves in positive direction"),
              N_("entered and kept; simulated encoders count forwards whatever it says"), (1, -1)),
    Parameter(AXIS, "s_share", "", 0, 1, "number",
              N_("the share of the ramp's time in which the acceleration grows or fades (S curve)"),
              N_("0 is a ramp of constant acceleration, 1 one whose acceleration changes all the time")),
    Parameter(AXIS, "homing_speed_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed towards the origin switch"),
              N_("the fast part of homing has this speed")),
    Parameter(AXIS, "homing_detection_mm", "mm", 0.001, LONGEST_MM, "number",
              N_("the most way back from the origin switch in which the encoder's index is looked for"),
              N_("homing fails where the index does not come within it")),
    Parameter(AXIS, "homing_offset_mm", "mm", -100, 100, "number",
              N_("the way that the axis goes on after the encoder's index"),
              N_("machine zero lies this far from the index")),
    Parameter(AXIS, "depth_detection_descent_mm", "mm", 0, 200, "number",
              N_("the most way down of a spindle that looks for the board's surface"),
              N_("a bit that touches nothing in it is missed; 0: this spindle does not look. X and Y have none (0)")),
    Parameter(SYSTEM, "interpolation_accuracy_mm", "mm", 0.0001, 1, "number",
              N_("the greatest distance from the line of a linked move"),
              N_("a line that the pulse equivalents can't keep within it is refused")),
    Parameter(SYSTEM, "position_detection_cycle_ms", "ms", 10, 10_000, "whole",
              N_("how often the monitor looks at positions and signals"),
              N_("the figures and signals of the machine's screen are renewed in this cycle")),
    Parameter(SYSTEM, "parking_x_mm", "mm", *_TRAVEL, "number",
              N_("X of the parking place, from machine zero"),
              N_("where the table goes for a tool change, after a job, and with the button Park")),
    Parameter(SYSTEM, "parking_y_mm", "mm", *_TRAVEL, "number",
              N_("Y of the parking place, from machine zero"),
              N_("where the table goes for a tool change, after a job, and with the button Park")),
    Parameter(SYSTEM, "change_height_mm", "mm", 0, 200, "number",
              N_("how far down the spindles go at a place of the magazine"),
              N_("the height at which chucks open and close in a tool change")),
    Parameter(SYSTEM, "depth_detection_depth_mm", "mm", 0.01, 200, "number",
              N_("how deep below the surface that was found a hole is drilled"),
              N_("the bottom dead centre of each spindle whose board was found; else it is `down` of [drill]")),
    Parameter(SYSTEM, "depth_detection_speed_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed of a spindle that looks for the board's surface"),
              N_("each new bit goes down over its first hole with it; one that the tick rate can't give is refused")),
    Parameter(MAGAZINE, "place", "", 1, 999, "whole",
              N_("the number of a place of the magazine"),
              N_("tools name the place by it")),
    Parameter(MAGAZINE, "x_mm", "mm", *_TRAVEL, "number",
              N_("X of the place, from machine zero"),
              N_("where the table goes to leave or take the tool of this place")),
    Parameter(MAGAZINE, "y_mm", "mm", *_TRAVEL, "number",
              N_("Y of the place, from machine zero"),
              N_("where the table goes to leave or take the tool of this place")),
    Parameter(MACHINING, "feed_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed down of a drilling spindle"),
              N_("the feed of tools that set none of their own")),
    Parameter(MACHINING, "lift_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed up of a spindle after the hole"),
              N_("the lifting speed of tools that set none of their own")),
    Parameter(MACHINING, "working_stroke_mm", "mm", 0.01, 200, "number",
              N_("how far the spindles lift between two holes, from the bottom dead centre"),
              N_("a longer stroke clears higher clamps, a shorter one drills more holes a minute")),
    Parameter(MACHINING, "spindle_rev_min", "rev/min", 1, 65_535, "whole",
              N_("the speed of rotation of the spindles"),
              N_("the rev/min of tools that set none of their own")),
    Parameter(MACHINING, "tool_change", "", None, None, "choice",
              N_("who changes the tools"),
              N_("MANUAL parks and asks for each tool; AUTOMATIC takes them from the magazine"),
              ("MANUAL", "AUTOMATIC")),
    Parameter(MACHINING, "breakage_range_mm", "mm", 0, 10, "number",
              N_("how much deeper than before a bit may touch"),
              N_("a bit that touches deeper, or not at the end of a stroke, is broken: the job ends (BIT_BROKEN)")),
    Parameter(TOOL, "number", "", 1, 9_999, "whole",
              N_("the tool's code, T1 and so on in a drill file"),
              N_("the holes of this code are drilled with this tool's speeds")),
    Parameter(TOOL, "kind", "", None, None, "choice",
              N_("what the tool is"),
              N_("only a DRILL is taken for holes"), ("DRILL", "ROUTER")),
    Parameter(TOOL, "diameter_mm", "mm", 0.01, 25, "number",
              N_("the diameter of the bit"),
              N_("tools of the same diameter stand in for each other when a life is used up")),
    Parameter(TOOL, "lift_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed up after each hole"),
              N_("in place of the machining parameter of this name")),
    Parameter(TOOL, "feed_mm_min", "mm/min", *_SPEED, "number",
              N_("the speed down in each hole"),
              N_("in place of the machining parameter of this name")),
    Parameter(TOOL, "offset_mm", "mm", 0, 1, "number",
              N_("the deviation of the diameter that is allowed"),
              N_("how much the diameter in the drill file may differ from the tool's")),
    Parameter(TOOL, "spindle_rev_min", "rev/min", 1, 65_535, "whole",
              N_("the speed of rotation with this tool"),
              N_("in place of the machining parameter of this name")),
    Parameter(TOOL, "life_hits", "", 1, 10_000_000, "whole",
              N_("how many holes a new bit drills"),
              N_("what is left is counted down from it")),
    Parameter(TOOL, "hits_left", "", 0, 10_000_000, "whole",
              N_("how many holes the bit is still good for"),
              N_("a bit at 0 is not used: another of the same diameter is taken, or the machine asks")),
    Parameter(TOOL, "magazine_place", "", 0, 999, "whole",
              N_("the place of the magazine where the tool is kept; 0: none"),
              N_("where an automatic change takes the tool from and leaves it")),
    Parameter(COORDINATES, "absolute_x_mm", "mm", *_TRAVEL, "number",
              N_("X of the origin of absolute coordinates, from machine zero"),
              N_("the screen shows absolute coordinates from there; unset: machine zero")),
    Parameter(COORDINATES, "absolute_y_mm", "mm", *_TRAVEL, "number",
              N_("Y of the origin of absolute coordinates, from machine zero"),
              N_("the screen shows absolute coordinates from there; unset: machine zero")),
    Parameter(COORDINATES, "relative_x_mm", "mm", *_TRAVEL, "number",
              N_("X of the origin of relative coordinates, from the origin of absolute ones"),
              N_("the screen shows relative coordinates from there; unset: the working base")),
    Parameter(COORDINATES, "relative_y_mm", "mm", *_TRAVEL, "number",
              N_("Y of the origin of relative coordinates, from the origin of absolute ones"),
              N_("the screen shows relative coordinates from there; unset: the working base")),
)  # fmt: skip


def of_group(group: str) -> tuple[Parameter, ...]:
    """Returns the parameters of a group, in the order of the table."""
    return tuple(row for row in PARAMETERS if row.group == group)


def parameter(group: str, name: str) -> Parameter:
    """Returns a parameter. Raises KeyError for one that there is not."""
    return _BY_NAME[group, name]


_BY_NAME = {(row.group, row.name): row for row in PARAMETERS}
