"""What a machine's file may say of a fault: its reaction, and whether the position is kept.

Rule: a combination that can't be true of a real machine is refused, and the refusal says why. Faults are known by name
here; codes and the reactions of a machine that says nothing are in kmd/faults.py.
"""

from collections.abc import Mapping, Sequence

from drillctl.language import Message, known_words
from drillctl.machine.model import FaultReaction, HomingStep
from drillctl.machine.shape import MachineFile
from drillctl.machine.source import Source

# The ways in which a homing table can fail.
HOMING = (
    "HOMING_NOT_FOUND", "HOMING_NO_SWITCH", "HOMING_OFF_SWITCH", "HOMING_ON_SWITCH", "HOMING_NO_INDEX",
    "HOMING_EARLY_INDEX",
)  # fmt: skip
_DRIVE = Message("the drive that has tripped does not hold its motor")
_HEAD = Message("the head is not where its steps have put it")
_ENDS = Message("the fault ends the process that would brake")
# Why a fault's reaction can't be chosen.
FIXED: Mapping[str, Message] = {
    "EMERGENCY_STOP": Message("emergency_stop says what the machine does"),
    "PORT_LOST": Message("the port is gone: outputs do not reach the motors any more"),
    "HEARTBEAT_LOST": _ENDS,
    "TICKER_LOST": _ENDS,
    "PORT_SLOW": Message("the port does not put out what it is given"),
}
# Why a position can't be kept after a fault, whatever the reaction.
NOT_KEPT: Mapping[str, Message] = {
    "RANGE": Message("it is the count of steps that has left the range"),
    "DRIVE_ALARM": _DRIVE,
    **dict.fromkeys(HOMING, Message("the position is not known during initialisation")),
    "DRILL_NOT_DOWN": _HEAD,
    "HEAD_NOT_UP": _HEAD,
    "CHANGE_Z_NOT_HOME": _HEAD,
}
# Why a machine can't go home by its sensors after a fault.
NO_RETURN: Mapping[str, Message] = {
    **dict.fromkeys(HOMING, Message("the return to zero has just failed")),
    "HEAD_NOT_UP": Message("the return to zero begins by raising the head"),
    "CHANGE_Z_NOT_HOME": Message("the return to zero begins by raising the head"),
    "SENSOR_CONTRADICTION": Message("the return to zero needs sensors that can be trusted"),
    "DRIVE_ALARM": _DRIVE,
}
ANY = (
    "LIMIT", "SOFT_LIMIT", "HOMING_REQUIRED", "DRILLING_TIME", "INPUT_TIMEOUT", "LINE_MISMATCH", "LINE_TOO_COARSE",
    "BAD_COMMAND", "LATE_TICK", "ONLY_ZERO", "SPINDLE_SPEED", "SPINDLE_LOST",
    "LATE_TICK", "ONLY_ZERO", "CHANGE_FOOT", "CHANGE_NOT_THERE", "CHANGE_HEIGHT", "CHANGE_CHUCK", "TOOL_NOT_LEFT",
    "TOOL_NOT_TAKEN", "NO_CONTACT", "BIT_BROKEN",
)  # fmt: skip
FAULT_NAMES = sorted({*ANY, *FIXED, *NOT_KEPT, *NO_RETURN})


def reactions(source: Source, raw: MachineFile, homing: Sequence[HomingStep]) -> tuple[FaultReaction, ...]:
    """Returns the reactions that a machine's file sets. Raises TableError."""
    for index, row in enumerate(raw.reaction):
        if row.fault not in FAULT_NAMES:
            words = known_words(row.fault, FAULT_NAMES)
            reason = Message("reaction: no fault is named {name!r}; {words}", name=row.fault, words=words)
            raise source.error(reason, "reaction", index, "fault")
        if row.fault in [other.fault for other in raw.reaction[:index]]:
            raise source.error(Message("reaction {name}: a second row", name=row.fault), "reaction", index, "fault")
        if why := _wrong(row.fault, row.do, row.position, homing):
            raise source.error(Message("reaction {name}: {why}", name=row.fault, why=why), "reaction", index)
    return tuple(FaultReaction(row.fault, row.do, row.position == "kept") for row in raw.reaction)


def only_zero_after(source: Source, raw: MachineFile) -> tuple[str, ...]:
    """Returns the faults after which a machine takes only the return to zero. Raises TableError for one that loses the
    position: there is no way back to zero then.
    """
    kept = {row.fault for row in raw.reaction if row.position == "kept"}
    if raw.emergency_stop != "drop":
        kept.add("EMERGENCY_STOP")
    for name in raw.only_zero_after:
        if name not in kept:
            fields = {"name": name, "words": known_words(name, sorted(kept))}
            reason = Message("only_zero_after: no fault {name!r} keeps the position here; {words}", **fields)
            raise source.error(reason, "only_zero_after")
    return tuple(raw.only_zero_after)


def _wrong(fault: str, do: str, position: str, homing: Sequence[HomingStep]) -> Message | None:
    """Returns why a reaction can't be true; None where it can."""
    if fault in FIXED:
        return Message("it can't be chosen: {why}", why=FIXED[fault])
    if do == "return" and fault in NO_RETURN:
        return Message("the machine can't return: {why}", why=NO_RETURN[fault])
    if do == "return" and not any(step.do in ("seek", "fast") for step in homing):
        return Message("the machine can't return: its homing table seeks no sensor")
    if position == "kept" and do == "drop":
        return Message("the position can't be kept: a motor without current can be turned by hand")
    if position == "kept" and fault in NOT_KEPT:
        return Message("the position can't be kept: {why}", why=NOT_KEPT[fault])
    return None
