"""What each command means. Rule: tables from word to action; an unknown word is refused, never skipped.

Source: the Excellon CNC-7 command set as CAD programs use it. `program` calls `execute` for every line
that is not part of a plain run of coordinates.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from .errors import Refusal
from .facts import Fact, Voice
from .lexer import KEYWORD, Word, split_words, take_axes, take_end
from .machine import Machine
from .tools import NUMBER_LIMIT, Entry

Action = Callable[[Machine, list[Word]], None]

# LZ and TZ name the zeros that are kept (CNC-7 manual), the opposite of Gerber.
SUPPRESSED = {"LZ": "trailing", "TZ": "leading"}
DIGITS_MASK = re.compile(r"(0+)\.(0+)|(\d)[.:](\d)")


def execute(machine: Machine, command: str) -> None:
    """Run one command line (capitals, no comment). Refusal says what is wrong with it."""
    name = KEYWORD.match(command)
    if name and name[0] in KEYWORDS:
        KEYWORDS[name[0]](machine, command)
        return
    if name and name[0] in UNSUPPORTED:
        raise Refusal("unsupported-command", UNSUPPORTED[name[0]])
    words = split_words(command)
    while words:
        LETTERS.get(words[0].letter, _unknown)(machine, words)
    machine.recognised = True


# -- keywords: a name and arguments behind commas -------------------------------------------------


def _units(units: str, machine: Machine, command: str) -> None:
    machine.recognised = True
    machine.set_units(units, command)
    for argument in re.split(r"[,\s]+", command)[1:]:
        if argument in SUPPRESSED:
            fact = Fact(SUPPRESSED[argument], Voice.HEADER, machine.line, command)
            machine.facts.declare_zeros(fact)
        elif mask := DIGITS_MASK.fullmatch(argument):
            places = (len(mask[1]), len(mask[2])) if mask[1] else (int(mask[3]), int(mask[4]))
            machine.facts.declare_digits(Fact(places, Voice.HEADER, machine.line, command))


def _incremental_input(machine: Machine, command: str) -> None:
    machine.incremental = command.replace(" ", "").endswith(",ON")


def _rewind(machine: Machine, command: str) -> None:
    machine.recognised = True
    machine.end_header()


def _ignore(machine: Machine, command: str) -> None:
    """Settings of machines (tool wear, spindle, tape format) that move no hole."""


MACHINE_SETTINGS = (
    "AFS", "ATC", "BLKD", "CCW", "CP", "DETECT", "DN", "DTMDIST", "EXDA", "FMAT", "FSB", "HPCK", "NCSL", "OM", "OSTOP",
    "OTCLMP", "PCKPARAM", "PF", "PPR", "PVS", "R", "RSB", "SBK", "SG", "SIXM", "TCST", "UP", "VER", "Z", "ZA", "ZC",
    "ZS", "M45", "M47", "/",
)  # fmt: skip
KEYWORDS: dict[str, Callable[[Machine, str], None]] = {
    "INCH": partial(_units, "inch"),
    "METRIC": partial(_units, "mm"),
    "ICI": _incremental_input,
    "%": _rewind,
    **dict.fromkeys(MACHINE_SETTINGS, _ignore),
}
UNSUPPORTED = {
    "M97": "M97 drilled text", "M98": "M98 drilled text", "M99": "M99 subroutine",
    "G32": "G32 routed circle", "G33": "G33 routed circle", "G87": "G87 routed slot",
    "G81": "G81 drill pack", "G82": "G82 drill pack", "G83": "G83 drill pack", "G84": "G84 drilled circle",
    "M70": "M70 swapped axes", "M80": "M80 mirrored X", "M90": "M90 mirrored Y",
}  # fmt: skip


# -- letters --------------------------------------------------------------------------------------


def _unknown(machine: Machine, words: list[Word]) -> None:
    raise Refusal("unknown-command", str(words[0]))


def _sequence_number(machine: Machine, words: list[Word]) -> None:
    """N, and the F and S (feed, speed) of machines that set them between holes."""
    words.pop(0)


def _code(machine: Machine, words: list[Word]) -> None:
    """G or M: the action takes the words it needs, later ones stay for the loop."""
    word = words.pop(0)
    name = f"{word.letter}{word.number:0>2}"
    if name in UNSUPPORTED:
        raise Refusal("unsupported-command", UNSUPPORTED[name])
    if name not in CODES:
        raise Refusal("unknown-command", str(word))
    CODES[name](machine, words)


def _coordinates(machine: Machine, words: list[Word]) -> None:
    axes = take_axes(words)
    if words and words[0] == ("G", "85"):
        words.pop(0)
        machine.slot(axes, take_end(words))
        return
    if machine.routing and not machine.cutting:
        machine.remark("rout-move")
    machine.move(axes)


def _tool(machine: Machine, words: list[Word]) -> None:
    """T with C defines (in the body it also selects); without C it selects, in a header it announces."""
    number = _tool_number(machine, words.pop(0).number)
    entry = Entry(number, None, machine.mm, machine.line)
    while words and words[0].letter in "CFSHBZ":
        word = words.pop(0)
        if word.letter == "C":
            entry.diameter, entry.places = _diameter(word), len(word.number.partition(".")[2])
    announced = machine.in_header and not machine.tools.known(number)
    if entry.diameter is not None or announced:
        machine.tools.define(entry, replace=machine.headers > 1 or not machine.in_header)
    if not machine.in_header or (entry.diameter is None and not announced):
        machine.tools.select(number, machine.line)


def _tool_number(machine: Machine, digits: str) -> int:
    """T0101 is tool 1 with offset 1, unless a tool 101 exists."""
    if not digits.isdigit() or int(digits) > NUMBER_LIMIT:
        raise Refusal("bad-tool-number", f"T{digits}")
    number = int(digits)
    if len(digits) == 4 and not machine.tools.known(number):
        return int(digits[:2])
    return number


def _diameter(word: Word) -> float:
    if not word.number or word.number.startswith("-"):
        raise Refusal("bad-diameter", str(word))
    return float(word.number)


def _repeat(machine: Machine, words: list[Word]) -> None:
    """R5X1.0 repeats the hole, R5M02X1.0 the pattern."""
    digits = words.pop(0).number
    if not digits.isdigit() or int(digits) < 1:
        raise Refusal("bad-repeat-count", f"R{digits}")
    pattern = bool(words) and words[0] == ("M", "02")
    if pattern:
        words.pop(0)
    axes = take_axes(words, "XY")
    if not axes:
        raise Refusal("repeat-without-offset", f"R{digits}")
    (machine.repeat_pattern if pattern else machine.repeat)(int(digits), axes)


LETTERS: dict[str, Action] = {
    **dict.fromkeys("GM", _code),
    **dict.fromkeys("XY", _coordinates),
    **dict.fromkeys("NFS", _sequence_number),
    "T": _tool,
    "R": _repeat,
}


# -- G and M codes --------------------------------------------------------------------------------


def _pattern_copy(machine: Machine, words: list[Word]) -> None:
    """M02 with a distance repeats the pattern; bare it ends pattern or program."""
    axes = take_axes(words, "XY")
    if axes:
        machine.repeat_pattern(1, axes)
    else:
        machine.rows.close_pattern()
        machine.stopped = True


def _rout(machine: Machine, words: list[Word]) -> None:
    """G00 to G03: from here to G05 coordinates are the router's way."""
    machine.routing = True
    axes = take_axes(words)
    if axes:
        machine.move(axes)


def _zero_set(machine: Machine, words: list[Word]) -> None:
    """G92, G93: where the machine's zero is; says nothing about distances between holes."""
    axes = take_axes(words)
    if any(float(number) for number in axes.values()):
        machine.remark("zero-set-ignored", str(axes))


def _skip_axes(machine: Machine, words: list[Word]) -> None:
    take_axes(words)


def _set(**state: bool) -> Action:
    """An action that sets attributes of the machine."""

    def action(machine: Machine, words: list[Word]) -> None:
        for name, value in state.items():
            setattr(machine, name, value)

    return action


def _do(method: str, *arguments: str, **options: bool) -> Action:
    """An action that calls a method of the machine, whatever words follow."""
    return lambda machine, words: getattr(machine, method)(*arguments, **options)


CODES: dict[str, Action] = {
    "M48": _do("begin_header"),
    "M95": _do("end_header"),
    "M71": _do("set_units", "mm", "M71"),
    "M72": _do("set_units", "inch", "M72"),
    "G90": _set(incremental=False),
    "G91": _set(incremental=True),
    "G05": _set(routing=False, cutting=False),
    **dict.fromkeys(("G00", "G01", "G02", "G03"), _rout),
    "M15": _do("cut", down=True),
    **dict.fromkeys(("M16", "M17"), _do("cut", down=False)),
    "G85": lambda machine, words: machine.slot({}, take_end(words)),
    "M25": lambda machine, words: machine.rows.begin_pattern(),
    "M01": lambda machine, words: machine.rows.end_pattern(),
    "M02": _pattern_copy,
    "M08": lambda machine, words: machine.rows.close_pattern(),
    **dict.fromkeys(("G92", "G93"), _zero_set),
    "G04": _skip_axes,
    "M00": _set(stopped=True),
    "M30": _set(ended=True),
    **dict.fromkeys(("G40", "G41", "G42", "M06", "M09", "M14", "M18"), _set()),
}
