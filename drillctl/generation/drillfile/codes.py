"""The G and M words. Rule: one table; a word owns the coordinates behind it, and takes or refuses them.

Source: the Excellon CNC-7 command set, format 2, as CAD programs use it. `commands` looks every G and M word up here;
docs/DRILL-FILES.md prints the table.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from .errors import Complaint
from .machine import Machine

Axes = Mapping[str, str]
Action = Callable[[Machine, Axes], None]

ROUTER_AXES = "XYAIJ"  # A is the radius of a routed arc, I and J its centre
NEXT_WORDS = "GMTNFS"


class Code(NamedTuple):
    """What a word does. takes: the axes it owns; then: letters that may follow in its line."""

    meaning: str
    action: Action
    takes: str = ""
    then: str = NEXT_WORDS


def _set(**state: bool) -> Action:
    """An action that sets attributes of the machine."""

    def action(machine: Machine, axes: Axes) -> None:
        for name, value in state.items():
            setattr(machine, name, value)

    return action


def _nothing(machine: Machine, axes: Axes) -> None:
    """A setting of machines that moves no hole."""


def _mode(incremental: bool, name: str) -> Action:
    """G90, G91; one that differs from the header's ICI is pointed out."""

    def action(machine: Machine, axes: Axes) -> None:
        if machine.ici is not None and machine.ici != incremental:
            machine.remark("contradictory-mode", name)
        machine.incremental = incremental

    return action


def _rout(*, arc: bool) -> Action:
    """G00 to G03: rout mode, in which the router goes straight or in arcs."""

    def action(machine: Machine, axes: Axes) -> None:
        machine.routing, machine.tool_in_rout, machine.router.arc = True, False, arc
        if axes:
            machine.move(axes)

    return action


def _compensation(*, on: bool) -> Action:
    """G40 to G42: beside its way the router is off it by the radius of its bit."""

    def action(machine: Machine, axes: Axes) -> None:
        machine.router.compensated = on
        _router_only(machine, axes)

    return action


def _retract(machine: Machine, axes: Axes) -> None:
    machine.cut(down=False)
    _router_only(machine, axes)


def _router_only(machine: Machine, axes: Axes) -> None:
    """Coordinates behind a router's word are the router's way; in drill mode they would be of no known meaning."""
    if axes and not machine.routing:
        raise Complaint("misplaced-word", f"coordinates in drill mode: {_written(axes)}")
    if axes:
        machine.remark("rout-move")
        machine.move(axes)


def _zero_set(machine: Machine, axes: Axes) -> None:
    """A zero that moves between holes would shift a part of the board against the rest."""
    zero = {axis: float(number) for axis, number in axes.items()}
    moved = zero != machine.zero and (any(zero.values()) or any(machine.zero.values()))
    if moved and len(machine.rows):
        raise Complaint("zero-moved", _written(axes))
    if moved:
        machine.remark("zero-set-ignored", _written(axes))
    machine.zero = zero


def _stop(machine: Machine, axes: Axes) -> None:
    machine.displaced = machine.displaced or bool(axes)


def _pause(machine: Machine, axes: Axes) -> None:
    _stop(machine, axes)
    machine.stopped = True
    machine.tools.next_announced()


def _pattern_copy(machine: Machine, axes: Axes) -> None:
    """M02 with a distance repeats the pattern; bare it ends the copies, or the program where there is no pattern."""
    if axes:
        machine.repeat_pattern(1, axes)
    elif machine.rows.in_pattern:
        machine.rows.end_copies()
    else:
        machine.stopped = True


def _scaling(machine: Machine, axes: Axes) -> None:
    machine.remark("scaling-ignored")


def _written(axes: Axes) -> str:
    return "".join(axis + number for axis, number in axes.items())


STOP_PLACE = "its X and Y are where the table stops, no hole"
OWN_HOLE = NEXT_WORDS + "XYR"
CODES: dict[str, Code] = {
    "G00": Code("rout mode: coordinates are the router's way until G05", _rout(arc=False), ROUTER_AXES),
    "G01": Code("the router's straight way", _rout(arc=False), ROUTER_AXES),
    "G02": Code("the router's arc, clockwise", _rout(arc=True), ROUTER_AXES),
    "G03": Code("the router's arc, counter-clockwise", _rout(arc=True), ROUTER_AXES),
    "G04": Code("dwell; its X is a time", _nothing, "X"),
    "G05": Code(
        "drill mode; coordinates in its line are a hole",
        _set(routing=False, cutting=False, tool_in_rout=False),
        then=OWN_HOLE,
    ),
    "G07": Code("speeds may change; passed over", _nothing),
    "G40": Code(
        "compensation off; in rout mode coordinates are the router's way", _compensation(on=False), ROUTER_AXES
    ),
    "G41": Code("compensation left; as G40", _compensation(on=True), ROUTER_AXES),
    "G42": Code("compensation right; as G40", _compensation(on=True), ROUTER_AXES),
    "G54": Code("passed over before a tool", _nothing, then="T"),
    "G85": Code("slot from the place before it to its own", lambda machine, axes: machine.slot({}, axes), "XY"),
    "G90": Code("absolute; coordinates in its line are a hole", _mode(False, "G90"), then=OWN_HOLE),
    "G91": Code("incremental; coordinates in its line are a hole", _mode(True, "G91"), then=OWN_HOLE),
    "G92": Code("zero set; not applied, with a warning; refused between holes", _zero_set, "XY"),
    "G93": Code("zero set; as G92", _zero_set, "XY"),
    "M00": Code(f"stop or end of the program; {STOP_PLACE}", _pause, "XY"),
    "M01": Code("end of the pattern; without one a stop", lambda machine, axes: machine.rows.end_pattern()),
    "M02": Code("with X or Y: the pattern again, so much further; bare: end of the copies, or of the program",
                _pattern_copy, "XY"),
    "M06": Code(f"optional stop; {STOP_PLACE}", _stop, "XY"),
    "M08": Code("end of step and repeat", lambda machine, axes: machine.rows.close_pattern()),
    "M09": Code(f"stop for inspection; {STOP_PLACE}", _stop, "XY"),
    "M14": Code("router down under depth control: a cut begins", lambda machine, axes: machine.cut(down=True)),
    "M15": Code("router down: a cut begins", lambda machine, axes: machine.cut(down=True)),
    "M16": Code("router up; X and Y behind it are the router's way", _retract, ROUTER_AXES),
    "M17": Code("router up; as M16", _retract, ROUTER_AXES),
    "M18": Code("tool tip check; passed over", _nothing),
    "M25": Code("beginning of a pattern", lambda machine, axes: machine.rows.begin_pattern()),
    "M30": Code(f"end of the program; {STOP_PLACE}", _set(ended=True), "XY"),
    "M48": Code("beginning of the header", lambda machine, axes: machine.begin_header()),
    "M60": Code("scaling of the machine on; not applied, with a warning", _scaling),
    "M61": Code("scaling of the machine off; passed over", _nothing),
    "M62": Code("pecks on; passed over (--peck)", _nothing),
    "M63": Code("pecks off; passed over", _nothing),
    "M71": Code("metric", lambda machine, axes: machine.set_units("mm", "M71")),
    "M72": Code("inch", lambda machine, axes: machine.set_units("inch", "M72")),
    "M95": Code("end of the header", lambda machine, axes: machine.end_header()),
}  # fmt: skip
# Known, and refused by name: they make holes or cuts that this program does not.
UNSUPPORTED = {
    "G32": "G32 routed circle", "G33": "G33 routed circle", "G34": "G34 vision tool", "G35": "G35 vision offset",
    "G36": "G36 vision translation", "G37": "G37 vision off", "G38": "G38 vision hole", "G39": "G39 vision calibration",
    "G45": "G45 vision offset", "G46": "G46 vision translation", "G47": "G47 vision off", "G48": "G48 vision hole",
    "G81": "G81 drill pack", "G82": "G82 drill pack", "G83": "G83 drill pack", "G84": "G84 drilled circle",
    "G87": "G87 routed slot", "M19": "M19 drilled map code", "M50": "M50 vision pattern", "M51": "M51 vision pattern",
    "M52": "M52 vision pattern", "M70": "M70 swapped axes", "M80": "M80 mirrored X", "M90": "M90 mirrored Y",
    "M96": "M96 spindle group", "M97": "M97 drilled text", "M98": "M98 drilled text", "M99": "M99 stored pattern",
}  # fmt: skip
# What the words of format 1 (FMAT,1) are called in format 2. M24, M26 and M27 mean the same in both.
ALWAYS_FORMAT_ONE = {"M24": "M01", "M26": "M02", "M27": "M08"}
FORMAT_ONE = {
    "G81": "G05", "M00": "M09", "M01": "M06", "M02": "M00", "M21": "M80", "M22": "M90", "M23": "M70", "M70": "M72",
}  # fmt: skip


def name_of(letter: str, number: str, *, format_one: bool) -> str:
    """'G05' for G5, in the names of format 2. Complaint 'unknown-command' for a letter alone."""
    if not number:
        raise Complaint("unknown-command", letter)
    name = f"{letter}{number:0>2}"
    return ALWAYS_FORMAT_ONE.get(name) or (FORMAT_ONE.get(name, name) if format_one else name)


def look_up(name: str) -> Code:
    """The table's entry. Complaint for a word that is known and not drilled, or not known."""
    if name in UNSUPPORTED:
        raise Complaint("unsupported-command", UNSUPPORTED[name])
    if name not in CODES:
        raise Complaint("unknown-command", name)
    return CODES[name]
