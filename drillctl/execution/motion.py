"""What an axis is about: one value, ``Axis.motion``.

    REST               stands still without forcing
    SETTLING           came to rest in this tick; the forcing wires go off in the next one (docs/SPEC.md, 1.5)
    FOLLOWER_SETTLING  the same for a follower whose leader has paused on its line
    FOLLOWING          steps when its leader steps (line.py); it doesn't count by itself
    MOVING             counts towards its target and may accelerate
    BRAKING            counts towards its target; it has braked, so it accelerates no more before state 0
    HOLDING            counts and brakes down to state 0; the target stays
    STOPPING           the same, but where it comes to rest is its target
"""

from enum import IntEnum


class AxisMotion(IntEnum):
    """What an axis is about. From MOVING on it counts."""

    REST = 0
    SETTLING = 1
    FOLLOWER_SETTLING = 2
    FOLLOWING = 3
    MOVING = 4
    BRAKING = 5
    HOLDING = 6
    STOPPING = 7


# Plain integers: a tick compares them for each axis.
REST, SETTLING, FOLLOWER_SETTLING, FOLLOWING, MOVING, BRAKING, HOLDING, STOPPING = (each.value for each in AxisMotion)
FOLLOWS = frozenset((FOLLOWING, FOLLOWER_SETTLING))  # another axis leads it along a line
SETTLES = frozenset((SETTLING, FOLLOWER_SETTLING))  # its forcing wires are on, and go off in this tick
COOLED = (REST, REST, FOLLOWING, FOLLOWING, MOVING, BRAKING, HOLDING, STOPPING)  # by motion: once the forcing is off
