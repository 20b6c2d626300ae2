"""Fault codes: what the machine does on each, and whether its position is still known. Texts: viewmodel/fault_texts.py.

Rule: a code keeps its number. docs/FAULTS.md is made from this table. The reactions are our reading of the paper's
section 3: "in chosen emergency states" the head returns to X=0, Y=0. A machine's file may set others, within what
machine/reactions.py allows; ``reactions_of`` has what a machine does.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import IntEnum


class Reaction(IntEnum):
    """What execution does when a fault is raised."""

    STOP = 0  # brake down the ramp
    DROP = 1  # the safe image in this tick
    STOP_AND_RETURN = 2  # brake, head up, then home by the sensors, while the position is known; else stop
    MACHINE = 3  # what the machine's file says an emergency stop does: drop, hold or brake
    HOLD = 4  # no more pulses from this tick on, the current stays


class Fault(IntEnum):
    """Fault codes; 0 is no fault."""

    NONE = 0
    LIMIT = 1
    RANGE = 2
    SOFT_LIMIT = 3
    HOMING_REQUIRED = 4
    HOMING_NOT_FOUND = 5
    DRILL_NOT_DOWN = 6
    HEAD_NOT_UP = 7
    DRILLING_TIME = 8
    SENSOR_CONTRADICTION = 9
    INPUT_TIMEOUT = 10
    LINE_MISMATCH = 11
    BAD_COMMAND = 12
    EMERGENCY_STOP = 13
    LATE_TICK = 14
    PORT_LOST = 15
    HEARTBEAT_LOST = 16
    TICKER_LOST = 17
    PORT_SLOW = 18
    ONLY_ZERO = 19
    SPINDLE_SPEED = 40
    SPINDLE_LOST = 41
    HOMING_NO_SWITCH = 50
    HOMING_OFF_SWITCH = 51
    HOMING_ON_SWITCH = 52
    HOMING_NO_INDEX = 53
    HOMING_EARLY_INDEX = 54
    DRIVE_ALARM = 55
    NO_CONTACT = 56
    BIT_BROKEN = 57
    CHANGE_Z_NOT_HOME = 60
    CHANGE_FOOT = 61
    CHANGE_NOT_THERE = 62
    CHANGE_HEIGHT = 63
    CHANGE_CHUCK = 64
    TOOL_NOT_LEFT = 65
    TOOL_NOT_TAKEN = 66
    LINE_TOO_COARSE = 70


@dataclass(frozen=True, slots=True)
class FaultSpec:
    """One fault: its reaction, and whether a position that was known stays known."""

    fault: Fault
    reaction: Reaction
    position_kept: bool


_ALL = (
    FaultSpec(Fault.LIMIT, Reaction.STOP, False),
    FaultSpec(Fault.RANGE, Reaction.STOP_AND_RETURN, False),
    FaultSpec(Fault.SOFT_LIMIT, Reaction.STOP, True),
    FaultSpec(Fault.HOMING_REQUIRED, Reaction.STOP, True),
    FaultSpec(Fault.HOMING_NOT_FOUND, Reaction.STOP, False),
    FaultSpec(Fault.DRILL_NOT_DOWN, Reaction.STOP_AND_RETURN, False),
    FaultSpec(Fault.HEAD_NOT_UP, Reaction.STOP, False),
    FaultSpec(Fault.DRILLING_TIME, Reaction.STOP_AND_RETURN, True),
    FaultSpec(Fault.SENSOR_CONTRADICTION, Reaction.DROP, False),
    FaultSpec(Fault.INPUT_TIMEOUT, Reaction.STOP, True),
    FaultSpec(Fault.LINE_MISMATCH, Reaction.STOP, True),
    FaultSpec(Fault.BAD_COMMAND, Reaction.STOP, True),
    FaultSpec(Fault.EMERGENCY_STOP, Reaction.MACHINE, False),
    FaultSpec(Fault.LATE_TICK, Reaction.STOP, True),
    FaultSpec(Fault.PORT_LOST, Reaction.DROP, False),
    FaultSpec(Fault.HEARTBEAT_LOST, Reaction.DROP, False),
    FaultSpec(Fault.TICKER_LOST, Reaction.DROP, False),
    FaultSpec(Fault.PORT_SLOW, Reaction.DROP, False),
    FaultSpec(Fault.ONLY_ZERO, Reaction.STOP, True),
    FaultSpec(Fault.SPINDLE_SPEED, Reaction.STOP, True),
    FaultSpec(Fault.SPINDLE_LOST, Reaction.STOP, True),
    FaultSpec(Fault.HOMING_NO_SWITCH, Reaction.STOP, False),
    FaultSpec(Fault.HOMING_OFF_SWITCH, Reaction.STOP, False),
    FaultSpec(Fault.HOMING_ON_SWITCH, Reaction.STOP, False),
    FaultSpec(Fault.HOMING_NO_INDEX, Reaction.STOP, False),
    FaultSpec(Fault.HOMING_EARLY_INDEX, Reaction.STOP, False),
    FaultSpec(Fault.DRIVE_ALARM, Reaction.STOP, False),
    FaultSpec(Fault.NO_CONTACT, Reaction.STOP_AND_RETURN, True),
    FaultSpec(Fault.BIT_BROKEN, Reaction.STOP_AND_RETURN, True),
    FaultSpec(Fault.CHANGE_Z_NOT_HOME, Reaction.STOP, False),
    FaultSpec(Fault.CHANGE_FOOT, Reaction.STOP, True),
    FaultSpec(Fault.CHANGE_NOT_THERE, Reaction.STOP, True),
    FaultSpec(Fault.CHANGE_HEIGHT, Reaction.STOP, True),
    FaultSpec(Fault.CHANGE_CHUCK, Reaction.STOP, True),
    FaultSpec(Fault.TOOL_NOT_LEFT, Reaction.STOP, True),
    FaultSpec(Fault.TOOL_NOT_TAKEN, Reaction.STOP, True),
    FaultSpec(Fault.LINE_TOO_COARSE, Reaction.STOP, True),
)

FAULTS: Mapping[int, FaultSpec] = {spec.fault: spec for spec in _ALL}

# What a machine's file calls a reaction.
_DOES: Mapping[str, Reaction] = {
    "brake": Reaction.STOP,
    "drop": Reaction.DROP,
    "return": Reaction.STOP_AND_RETURN,
    "hold": Reaction.HOLD,
}


def reactions_of(emergency_stop: str, chosen: Iterable[tuple[str, str, bool]]) -> Mapping[int, FaultSpec]:
    """Returns what a machine does on each fault, by code: as FAULTS has it, but for those that its file has ``chosen``
    (name, what it does, position kept) and for the emergency stop ("drop", "hold", "brake"). Where the current is held,
    a position that is kept is kept from states 0 and 1 only.
    """
    stop = Fault.EMERGENCY_STOP
    made: dict[int, FaultSpec] = dict(FAULTS)
    made[stop] = FaultSpec(stop, _DOES[emergency_stop], position_kept=emergency_stop != "drop")
    for name, does, kept in chosen:
        made[Fault[name]] = replace(FAULTS[Fault[name]], reaction=_DOES[does], position_kept=kept)
    return made
