"""What each line does. Rule: tables from word to action; an unknown word is refused, never skipped.

`program` calls `execute` for every line that is not part of a plain run of coordinates. Names with commas are in
keywords.py, G and M words in codes.py, the T word in toolwords.py.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from .codes import ROUTER_AXES, UNSUPPORTED, look_up, name_of
from .errors import Complaint
from .keywords import KEYWORDS
from .lexer import KEYWORD, Word, split_words, take_axes, take_end
from .machine import Machine
from .toolwords import tool

Letter = Callable[[Machine, list[Word]], None]

TOOL_LINKS = re.compile(r"\d+(?:/\d+)+")  # 1/5/6: tools of one size that follow each other on a tool changer
NAME = re.compile(r"[A-WZ][A-Z_]+")
ROUTER_WORDS = {"M14", "M15", "M16", "M17"}


def execute(machine: Machine, command: str) -> None:
    """Run one command line (capitals, no comment). Complaint says what is wrong with it."""
    if command.startswith("/") and len(command) > 1:
        if machine.delete_blocks:
            machine.remark("block-deleted", command)
            return
        machine.remark("block-not-deleted", command)
        command = command[1:]
    name = KEYWORD.match(command)
    if name and name[0] in KEYWORDS:
        KEYWORDS[name[0]](machine, command)
    elif name and name[0] in UNSUPPORTED:
        raise Complaint("unsupported-command", UNSUPPORTED[name[0]])
    elif unknown := NAME.match(command):
        raise Complaint("unknown-command", unknown[0])
    elif not TOOL_LINKS.fullmatch(command):
        _run(machine, split_words(command))


def _run(machine: Machine, words: list[Word]) -> None:
    while words:
        LETTERS.get(words[0].letter, _unknown)(machine, words)
    machine.recognised = True


def _unknown(machine: Machine, words: list[Word]) -> None:
    raise Complaint("unknown-command", str(words[0]))


def _passed_over(machine: Machine, words: list[Word]) -> None:
    """N (block number), and the F and S (feed, speed) of machines that set them between holes."""
    word = words.pop(0)
    if not word.number:
        raise Complaint("unknown-command", word.letter)


def _code(machine: Machine, words: list[Word]) -> None:
    """G or M: it takes the axes it owns; what else follows must be allowed to."""
    name = name_of(*words.pop(0), format_one=machine.format_one)
    code = look_up(name)
    axes = take_end(words) if name == "G85" else take_axes(words, code.takes)
    if words and words[0].letter not in code.then:
        raise Complaint("misplaced-word", f"{words[0]} behind {name}")
    code.action(machine, axes)


def _coordinates(machine: Machine, words: list[Word]) -> None:
    """A hole, a slot or the router's way; nothing but a slot's end, a speed or the router's words may follow."""
    axes = take_axes(words, ROUTER_AXES if machine.routing else "XY")
    slot = bool(words) and words[0] == ("G", "85")
    if slot:
        words.pop(0)
    end = take_end(words) if slot else {}
    name = _next_code(machine, words)
    if words and words[0].letter not in "FS" and not (machine.routing and name in ROUTER_WORDS):
        raise Complaint("misplaced-word", f"{words[0]} behind coordinates")
    if slot:
        machine.slot(axes, end)
    else:
        machine.move_or_drill(axes)


def _next_code(machine: Machine, words: list[Word]) -> str:
    """The name of the G or M word that comes next, '' for none. Complaint for one that is not drilled or not known."""
    if not words or words[0].letter not in "GM":
        return ""
    name = name_of(*words[0], format_one=machine.format_one)
    look_up(name)
    return name


def _repeat(machine: Machine, words: list[Word]) -> None:
    """R5X1.0 repeats the hole, R5M02X1.0 the pattern (M26 in format 1)."""
    digits = words.pop(0).number
    if not digits.isdigit() or int(digits) < 1:
        raise Complaint("bad-repeat-count", f"R{digits}")
    pattern = bool(words) and words[0] in (("M", "02"), ("M", "2"), ("M", "26"))
    if pattern:
        words.pop(0)
    axes = take_axes(words, "XY")
    if not axes:
        raise Complaint("repeat-without-offset", f"R{digits}")
    if words:
        _next_code(machine, words)
        raise Complaint("misplaced-word", f"{words[0]} behind R")
    (machine.repeat_pattern if pattern else machine.repeat)(int(digits), axes)


def _stored_pattern(machine: Machine, words: list[Word]) -> None:
    raise Complaint("unsupported-command", "P repeat of a stored pattern")


LETTERS: dict[str, Letter] = {
    **dict.fromkeys("GM", _code),
    **dict.fromkeys("XY", _coordinates),
    **dict.fromkeys("NFS", _passed_over),
    "P": _stored_pattern,
    "R": _repeat,
    "T": tool,
}
