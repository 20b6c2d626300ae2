"""Cause and remedy of every fault, looked up by code; docs/FAULTS.md is made from this and kmd/faults. And what verbs
and screens say in the same words.

Rule: a fault without a cause and a remedy does not exist (a test holds that).
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from drillctl.kmd import Fault
from drillctl.language import Message
from drillctl.viewmodel.records import FaultReport


class FaultWords(NamedTuple):
    """Why it happened, and what the operator does."""

    cause: str
    remedy: str


FAULT_WORDS: Mapping[Fault, FaultWords] = {
    Fault.LIMIT: FaultWords(
        Message("a limit sensor answered while its axis was moving towards it, outside initialisation"),
        Message("look for lost steps or a board laid too far out, then initialise again"),
    ),
    Fault.RANGE: FaultWords(
        Message("the tracked position left the configured work range"),
        Message("check the work range, the scale and the limit sensors in the machine's file, then initialise again"),
    ),
    Fault.SOFT_LIMIT: FaultWords(
        Message(
            "a command's target lies where its axis can't be sent: outside its range, at a limit sensor, or farther "
            "than its travel is long; the command moved nothing"
        ),
        Message(
            "correct the command or the working base; before initialisation all moves together must fit into the travel"
        ),
    ),
    Fault.HOMING_REQUIRED: FaultWords(
        Message("a move to a place was asked for while the position was not known; that command moved nothing"),
        Message("initialise first (KMD_INICJALIZACJA)"),
    ),
    Fault.HOMING_NOT_FOUND: FaultWords(
        Message(
            "initialisation, or the return after a fault, did not find a limit sensor or did not get clear of it"
        ),
        Message("check the sensor, its wiring and its polarity, and that the carriage moves freely"),
    ),
    Fault.DRILL_NOT_DOWN: FaultWords(
        Message(
            "the head came to rest without its lower sensor answering: at the end of its range (Zmax passed), or the "
            "sensor had answered for a moment only"
        ),
        Message("look for a blunt drill, a jammed head or a dirty lower sensor"),
    ),
    Fault.HEAD_NOT_UP: FaultWords(
        Message("the head came to rest without its upper sensor answering"),
        Message("free the head, check the upper sensor, then initialise again"),
    ),
    Fault.DRILLING_TIME: FaultWords(
        Message("lowering the head took longer than the configured drilling time"),
        Message("change a blunt drill, or raise longest_drilling_s in the machine's file"),
    ),
    Fault.SENSOR_CONTRADICTION: FaultWords(
        Message("the sensors at both ends of one axis answered at once"),
        Message("check sensors and cable: one of them is stuck, dirty or shorted"),
    ),
    Fault.INPUT_TIMEOUT: FaultWords(
        Message("an awaited input did not come in its time"),
        Message("check what should have switched it, or give KMD_CZEKAJ_WE more ticks"),
    ),
    Fault.LINE_MISMATCH: FaultWords(
        Message("axes with different columns_per_step can't be linked in one line; the command moved nothing"),
        Message("move them one after the other, or give them the same columns_per_step"),
    ),
    Fault.LINE_TOO_COARSE: FaultWords(
        Message("the pulse equivalents can't keep a line within interpolation_accuracy_mm; the command moved nothing"),
        Message("enter a greater interpolation_accuracy_mm, or smaller pulse equivalents; or move the axes one by one"),
    ),
    Fault.BAD_COMMAND: FaultWords(
        Message("a command that this machine can't carry out came down the queue"),
        Message("check the queue against docs/KMD.md and the machine's outputs"),
    ),
    Fault.EMERGENCY_STOP: FaultWords(
        Message("emergency stop; where the outputs were dropped, a raised head may sink"),
        Message("clear the danger, acknowledge, and initialise where the position was lost"),
    ),
    Fault.LATE_TICK: FaultWords(
        Message(
            "the ticks stood still for more than a quarter of a second: the computer was busy elsewhere, or suspended"
        ),
        Message(
            "grant real-time scheduling or free the computer (drillctl latency), acknowledge; initialise where lost"
        ),
    ),
    Fault.PORT_LOST: FaultWords(
        Message(
            "the port is gone, or its board was reset; what its outputs are now can't be known, nor made safe by "
            "software"
        ),
        Message("cut the motors' supply, check cable, card and the card's own supply, then start anew and initialise"),
    ),
    Fault.HEARTBEAT_LOST: FaultWords(
        Message("the program that fills the queue ended or hung; the outputs were switched off"),
        Message("see why it ended or hung, then initialise; a job with a journal can be resumed"),
    ),
    Fault.TICKER_LOST: FaultWords(
        Message(
            "the process that runs the ticks ended or stood still; the outputs were made safe where the port still "
            "answers"
        ),
        Message("see why it ended, then initialise; a job with a journal can be resumed"),
    ),
    Fault.PORT_SLOW: FaultWords(
        Message("the port takes outputs more slowly than the ticks make them; the motors may have missed some"),
        Message(
            "lower tick_hz or use a faster line, and see that nothing else talks to the port; then initialise again"
        ),
    ),
    Fault.ONLY_ZERO: FaultWords(
        Message("a command came that is not the return to zero, the only one allowed after a limit or emergency stop"),
        Message("acknowledge, and return to zero (KMD_POWROT) before anything else"),
    ),
    Fault.SPINDLE_SPEED: FaultWords(
        Message("the spindle did not come to its speed, or to a standstill, in the time that it is given"),
        Message("look at the converter's display and limits, and at [spindle] in the machine's file"),
    ),
    Fault.SPINDLE_LOST: FaultWords(
        Message("the spindle has lost the speed that it had reached"),
        Message("look at the converter's display, the bits and the feed; raise the heads before it turns again"),
    ),
    Fault.HOMING_NO_SWITCH: FaultWords(
        Message("initialisation went the whole range and a tenth more, and the origin switch did not answer"),
        Message("check the switch, its wiring and its polarity, and that the carriage moves freely"),
    ),
    Fault.HOMING_OFF_SWITCH: FaultWords(
        Message("during initialisation an axis did not come to rest on its origin switch"),
        Message("look for a switch that bounces, or a cam shorter than the braking way, then initialise again"),
    ),
    Fault.HOMING_ON_SWITCH: FaultWords(
        Message("the origin switch was still on after the most way back that its homing row allows"),
        Message("check whether the switch is stuck, or raise the limit of the row in the machine's file"),
    ),
    Fault.HOMING_NO_INDEX: FaultWords(
        Message("the encoder's index did not come within the most way that its homing row allows"),
        Message("check the encoder's cable; the limit of the row must be longer than a turn of the encoder"),
    ),
    Fault.HOMING_EARLY_INDEX: FaultWords(
        Message("the encoder's index was on already where the axis had just left its origin switch"),
        Message("check whether the index is stuck; move the switch by half a turn, so that the index comes later"),
    ),
    Fault.NO_CONTACT: FaultWords(
        Message(
            "a head went down as far as its depth detection goes and its bit touched nothing, or its contact was on "
            "above the board"
        ),
        Message("see whether the bit is there and whole, a board lies below it, and the contact goes on and off"),
    ),
    Fault.BIT_BROKEN: FaultWords(
        Message(
            "a bit touched the board deeper than before by more than the breakage range, or not at all in a stroke down"
        ),
        Message("look at the last holes and put a new bit in; the tool is noted as used up until that is said"),
    ),
    Fault.DRIVE_ALARM: FaultWords(
        Message("the drive of an axis has tripped: its motor fell too far behind its pulses"),
        Message("lower speed or acceleration, look for a jammed guide; switch the drive on anew, and initialise"),
    ),
    Fault.CHANGE_Z_NOT_HOME: FaultWords(
        Message("in a tool change a spindle did not reach its upper sensor, or not in the time of the step"),
        Message("free the spindle and its chuck, check the upper sensor, then initialise and resume the job"),
    ),
    Fault.CHANGE_FOOT: FaultWords(
        Message("in a tool change the presser foot did not answer in the time of the step"),
        Message("check the presser foot and its air, then resume the job"),
    ),
    Fault.CHANGE_NOT_THERE: FaultWords(
        Message("in a tool change X or Y did not reach the magazine or the parking place in the time of the step"),
        Message("see that nothing blocks the table, or give the step more time (limit_s), then resume the job"),
    ),
    Fault.CHANGE_HEIGHT: FaultWords(
        Message("in a tool change a spindle did not reach the change height in the time of the step"),
        Message("look at the magazine under the spindles, or give the step more time (limit_s), then resume the job"),
    ),
    Fault.CHANGE_CHUCK: FaultWords(
        Message("in a tool change a chuck did not open or close in the time of the step"),
        Message("check the chuck and its air, look which tools are where, set the magazine record, then resume"),
    ),
    Fault.TOOL_NOT_LEFT: FaultWords(
        Message("after the chuck had opened over the magazine the tool sensor still saw a tool in it"),
        Message("take the tool out by hand, set the magazine record, then resume the job"),
    ),
    Fault.TOOL_NOT_TAKEN: FaultWords(
        Message("after the chuck had closed over the magazine the tool sensor saw no tool in it"),
        Message("look whether the place has a tool, or it fell; set the magazine record, then resume the job"),
    ),
}


def fault_report(code: int, kept: bool, axes: Sequence[str] = ()) -> FaultReport:
    """A fault code in words, with the position kept or lost, and the names of the axes that it is about."""
    fault = Fault(code)
    words = FAULT_WORDS[fault]
    return FaultReport(code, fault.name, words.cause, words.remedy, "kept" if kept else "lost", tuple(axes))


def local_tables(files: Sequence[str]) -> Message:
    """That these tables, which nobody named and which are not the shipped ones, are in use: for a verb and a screen."""
    return Message("local tables are in use, not the shipped ones: {files}", files=", ".join(files))


def axes_blamed(mask: int, names: Sequence[str]) -> list[str]:
    """The names of the axes in the mask ``fault_axes`` of a status record."""
    return [name for index, name in enumerate(names) if mask >> index & 1]
