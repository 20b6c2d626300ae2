"""Lines that are a name with arguments behind commas: INCH,LZ and the settings of machines.

Rule: a setting that moves no hole is passed over; one whose argument is not understood is refused. `commands` asks
`KEYWORDS` first.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from .errors import Complaint
from .facts import Fact, Voice
from .machine import Machine

Keyword = Callable[[Machine, str], None]

# LZ and TZ name the zeros that are kept (CNC-7 manual), the opposite of Gerber.
SUPPRESSED = {"LZ": "trailing", "TZ": "leading"}
DIGITS_MASK = re.compile(r"(0+)\.(0+)|(\d)[.:](\d)")
SWITCHES = {"ON": True, "OFF": False}


def _units(units: str, machine: Machine, command: str) -> None:
    machine.recognised = True
    machine.set_units(units, command)
    for argument in _arguments(command):
        if argument in SUPPRESSED:
            fact = Fact(SUPPRESSED[argument], Voice.HEADER, machine.line, command)
            machine.facts.declare_zeros(fact)
        elif mask := DIGITS_MASK.fullmatch(argument):
            places = (len(mask[1]), len(mask[2])) if mask[1] else (int(mask[3]), int(mask[4]))
            machine.facts.declare_digits(Fact(places, Voice.HEADER, machine.line, command), units)
        else:
            raise Complaint("bad-setting", command)


def _arguments(command: str) -> list[str]:
    return [argument for argument in re.split(r"[,\s]+", command)[1:] if argument]


def _switch(command: str) -> bool:
    """The state behind the comma. Complaint 'bad-setting' for anything but ON and OFF."""
    arguments = _arguments(command)
    if len(arguments) != 1 or arguments[0] not in SWITCHES:
        raise Complaint("bad-setting", command)
    return SWITCHES[arguments[0]]


def _incremental_input(machine: Machine, command: str) -> None:
    machine.incremental = machine.ici = _switch(command)


def _block_delete(machine: Machine, command: str) -> None:
    machine.delete_blocks = _switch(command)


def _format(machine: Machine, command: str) -> None:
    if _arguments(command) not in (["1"], ["2"]):
        raise Complaint("bad-setting", command)
    machine.format_one = _arguments(command) == ["1"]


def _axis_version(machine: Machine, command: str) -> None:
    """Version 1 is the one whose X and Y every CAD program means; others turn or mirror the table."""
    if _arguments(command) != ["1"]:
        machine.remark("axis-version", command)


def _percent(machine: Machine, command: str) -> None:
    """% ends a header or begins a tape; in the body it begins a pattern, as M25 does."""
    machine.recognised = True
    if machine.in_header:
        machine.end_header()
    elif command == "%" and (machine.headers or len(machine.rows)):
        machine.rows.begin_pattern(must_end=False)


def _ignore(machine: Machine, command: str) -> None:
    """Settings of machines (tool wear, spindle, tape format) that move no hole."""


MACHINE_SETTINGS = (
    "AFS", "ATC", "CCW", "CP", "DETECT", "DN", "DTMDIST", "EXDA", "FSB", "HPCK", "NCSL", "OM", "OSTOP", "OTCLMP",
    "PCKPARAM", "PF", "PPR", "PVS", "R", "RSB", "RTR", "SBK", "SG", "SIXM", "TCST", "UP", "Z", "ZA", "ZC", "ZS", "/",
)  # fmt: skip
KEYWORDS: dict[str, Keyword] = {
    "INCH": partial(_units, "inch"),
    "METRIC": partial(_units, "mm"),
    "M72": partial(_units, "inch"),  # with arguments; bare ones are codes.py's
    "M71": partial(_units, "mm"),
    "ICI": _incremental_input,
    "BLKD": _block_delete,
    "FMAT": _format,
    "VER": _axis_version,
    "%": _percent,
    **dict.fromkeys((*MACHINE_SETTINGS, "M47"), _ignore),
}
